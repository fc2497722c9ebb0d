// A thousand random problems, each held against laws that every diagram obeys and against brute force.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "brep/face_area.h"
#include "cell_labels.h"
#include "diagram_laws.h"
#include "support/splines.h"
#include "voronoi/certificate.h"
#include "voronoi/diagram_builder.h"
#include "voronoi/sites.h"

namespace geovor::testing {
namespace {

// Each shard is a ctest case of its own. GEOVOR_PROBLEM=seed runs one problem alone.
constexpr int kShards = 40;
constexpr int kProblems = 1000;
constexpr int kFewestSites = 2;
constexpr int kMostSites = 200;
constexpr int kLabels = 40;  ///< points of a problem that are held against brute force

struct Problem {
  std::string name;
  TestFace face;
  int euler = 1;  ///< Euler's number of the face
  std::vector<Uv> sites;
};

Problem random_face(Uniform& random, int kind) {
  const UvBox square = {{-2.0, 2.0}, {-2.0, 2.0}};
  // Paths around bumps near the border run beyond it; brute force must find them too.
  const UvBox beyond = {{-4.0, 4.0}, {-4.0, 4.0}};
  const auto bumps = [&](int count, double height, double width) {
    std::vector<GaussianBumps::Bump> list;
    for (int i = 0; i < count; ++i) list.push_back({random.in(square), height * (0.5 + random()), width});
    return TestFace(std::make_shared<GaussianBumps>(list, beyond)).rectangle(square);
  };
  switch (kind) {
    case 0:
      return {"wave", whole(std::make_shared<WaveSurface>(square)), 1, {}};
    case 1:
      return {"paraboloid", whole(std::make_shared<Paraboloid>(kSquare)), 1, {}};
    case 2:
      return {"monkey saddle", whole(std::make_shared<MonkeySaddle>(UvBox{{-0.7, 0.7}, {-0.7, 0.7}})), 1, {}};
    case 3:
      return {"low bumps", bumps(3, 0.5, 0.5), 1, {}};
    case 4:
      return {"high bumps", bumps(2, 1.5, 0.4), 1, {}};
    case 5:
      return {"sphere", whole(std::make_shared<Sphere>(Frame{}, 1.0)), 2, {}};
    case 6:
      return {"torus", whole(std::make_shared<Torus>(Frame{}, 3.0, 1.0)), 0, {}};
    case 7:
      return {"tube", TestFace(std::make_shared<Cylinder>(Frame{}, 1.0)).ring({{0.0, 2.0 * kPi}, {0.0, 3.0}}), 0, {}};
    case 8: {
      const auto spline = random_spline(3, 3, 3, false, static_cast<unsigned>(1000.0 * random())).surface();
      return {"B-spline", whole(std::make_shared<BSplineSurface>(spline)), 1, {}};
    }
    default: {
      Problem p{"plate with a hole", plane_square(), 0, {}};
      p.face.polygon({{-0.3, -0.2}, {-0.3, 0.3}, {0.2, 0.3}, {0.2, -0.2}});
      return p;
    }
  }
}

Uv clamped(const UvBox& box, Uv p) { return box.clamp(p); }

/// Places on circles about a few centres, so that many sites are equally far from one point (on a plane).
Uv on_a_circle(Uniform& random, const UvBox& box, int i) {
  const Uv centre = {box.u.lo + (0.3 + 0.4 * (i % 2)) * box.u.length(), box.v.middle()};
  const double t = 2.0 * kPi * std::floor(12.0 * random()) / 12.0, r = 0.2 * std::min(box.u.length(), box.v.length());
  return {centre.u + r * std::cos(t), centre.v + r * std::sin(t)};
}

Uv in_a_cluster(Uniform& random, const UvBox& box, Uv centre) {
  const double r = 0.03 * random(), t = 2.0 * kPi * random();
  return {centre.u + r * box.u.length() * std::cos(t), centre.v + r * box.v.length() * std::sin(t)};
}

/// On the side v = lo or u = lo of the rectangle: the border, a seam or a pole, as the face has it.
Uv on_a_side(Uniform& random, const UvBox& box, int i) {
  if (i % 3 == 0) return random.in(box);
  Uv p = random.in(box);
  (i % 3 == 1 ? p.u : p.v) = i % 3 == 1 ? box.u.lo : box.v.lo;
  return p;
}

const char* const kPatterns[] = {"uniform", "clustered", "cocircular", "lattice", "on sides and poles"};

std::vector<Uv> random_places(Uniform& random, const UvBox& box, int pattern, int count) {
  std::vector<Uv> centres, places;
  for (int i = 0; i < 3; ++i) centres.push_back(random.in(box));
  const int rows = std::max(2, static_cast<int>(std::sqrt(count)));
  for (int i = 0; i < count; ++i) {
    switch (pattern) {
      case 1:
        places.push_back(in_a_cluster(random, box, centres[i % 3]));
        break;
      case 2:
        places.push_back(on_a_circle(random, box, i));
        break;
      case 3:
        places.push_back(
            {box.u.lo + (i % rows + 0.5) / rows * box.u.length(), box.v.lo + (i / rows + 0.5) / rows * box.v.length()});
        break;
      case 4:
        places.push_back(on_a_side(random, box, i));
        break;
      default:
        places.push_back(random.in(box));
    }
    places.back() = clamped(box, places.back());
  }
  return places;
}

/// Those of the places that lie in the face and not too near to one before them.
std::vector<Uv> usable(const FaceDomain& domain, const std::vector<Uv>& places) {
  constexpr double kApart = 1e-4;
  std::vector<Uv> sites;
  for (const Uv p : places) {
    const Xyz x = domain.surface().position(p);
    const bool apart = std::all_of(sites.begin(), sites.end(),
                                   [&](Uv q) { return (domain.surface().position(q) - x).norm() > kApart; });
    if (apart && domain.contains(p)) sites.push_back(p);
  }
  return sites;
}

Problem random_problem(int seed) {
  Uniform random(static_cast<unsigned>(seed));
  const int kind = seed % 10, pattern = seed / 10 % 5;
  Problem p = random_face(random, kind);
  // Few sites more often than many: each is a problem of its own, and many cost more.
  const double spread = std::log(static_cast<double>(kMostSites) / kFewestSites), share = random();
  const int count = static_cast<int>(kFewestSites * std::exp(spread * share * share));
  const FaceDomain domain = p.face.domain();
  p.sites = usable(domain, random_places(random, domain.box(), pattern, count));
  p.name += ", " + std::to_string(p.sites.size()) + " sites " + kPatterns[pattern];
  return p;
}

/// The first law that the diagram breaks, in words. The points for the labels have a seed of their own: they must not
/// be the sites.
std::string broken_law(const Problem& p, int seed) {
  const FaceDomain domain = p.face.domain();
  VoronoiOptions options;
  options.measure = false;  // the certificate measures
  const VoronoiDiagram d = build_diagram(domain, p.sites, options);
  for (const DiagramWarning& w : d.warnings)
    if (w.kind == "unresolved") return "unresolved: " + w.text;
  if (const std::string fault = broken_topology(d); !fault.empty()) return fault;
  const Certificate c = certify(domain, d, face_area(p.face.model, p.face.model.faces[0]));
  if (!c.holds()) return c.result;
  if (const int number = euler_number(domain, d); number != p.euler) return "Euler number " + std::to_string(number);
  const DistanceFinder finder(domain.surface());
  const LabelCheck labels = compare_with_brute_force(domain, d, shortest_by(finder), kLabels, kProblems + seed);
  if (labels.wrong > 0) return std::to_string(labels.wrong) + " labels, first " + labels.first_wrong;
  if (labels.undecided > kLabels / 10) return std::to_string(labels.undecided) + " labels undecided";
  return "";
}

void expect_no_broken_law(int seed) {
  const Problem p = random_problem(seed);
  if (p.sites.size() < static_cast<std::size_t>(kFewestSites)) return;
  std::string broken;
  try {
    broken = broken_law(p, seed);
  } catch (const std::exception& e) {
    broken = std::string("exception: ") + e.what();
  }
  EXPECT_EQ(broken, "") << "problem " << seed << ": " << p.name;
}

class RandomProblems : public ::testing::TestWithParam<int> {};

TEST_P(RandomProblems, ObeyTheLaws) {
  const char* alone = std::getenv("GEOVOR_PROBLEM");
  for (int seed = GetParam(); seed < kProblems; seed += kShards) {
    if (alone == nullptr || std::atoi(alone) == seed) expect_no_broken_law(seed);
  }
}

INSTANTIATE_TEST_SUITE_P(Shards, RandomProblems, ::testing::Range(0, kShards));

}  // namespace
}  // namespace geovor::testing
