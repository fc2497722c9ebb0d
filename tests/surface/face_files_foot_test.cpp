// The faces of a set of STEP files that hold one shape each under many parameterizations, some of them with sides along
// which a derivative vanishes, or that are one point: feet and normals must be the original's, but for what the files
// differ by (faces.tsv says how much).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "occ_adapter/read_cad.h"
#include "support/differences.h"
#include "surface/project.h"
#include "surface/shape.h"

namespace geovor {
namespace {

using testing::uniform;

std::filesystem::path faces_folder() {
  const char* named = std::getenv("GEOVOR_SHARED");
  return (named ? std::filesystem::path(named) : std::filesystem::path(GEOVOR_SOURCE_DIR) / ".." / "shared") / "faces";
}

/// By name: how far the points of the file lie from those meant, as measured by who made it.
std::map<std::string, double> file_errors() {
  std::map<std::string, double> errors;
  std::ifstream table(faces_folder() / "faces.tsv");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream columns(line);
    std::string name;
    double made = 0.0, read_back = 0.0;
    if (columns >> name >> made >> read_back) errors[name] = made + read_back;
  }
  return errors;
}

UvBox parameter_box(const CadFace& face) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  UvBox box{{kInf, -kInf}, {kInf, -kInf}};
  for (const TrimLoop& loop : face.loops) {
    for (const Coedge& c : loop.coedges) {
      for (int i = 0; i <= 16; ++i) {
        const auto C = c.pcurve->position(c.range.lo + i * c.range.length() / 16.0);
        box.u = {std::min(box.u.lo, C.x()), std::max(box.u.hi, C.x())};
        box.v = {std::min(box.v.lo, C.y()), std::max(box.v.hi, C.y())};
      }
    }
  }
  return box;
}

CadModel face_file(const std::string& name) { return read_cad((faces_folder() / (name + ".step")).string()); }

/// A place of the face, in turn on each of the sides, at a corner, very near to a side, and inside.
Uv some_place(std::mt19937& random, const UvBox& box, int i) {
  double u = uniform(random, 0, 1), v = uniform(random, 0, 1);
  const double little = std::pow(10.0, -uniform(random, 1, 12));
  if (i % 8 == 1 || i % 24 == 0) u = 0;
  if (i % 8 == 2) u = 1;
  if (i % 8 == 3 || i % 24 == 0) v = 0;
  if (i % 8 == 4) v = 1;
  if (i % 8 == 5) u = little;
  if (i % 8 == 6) v = 1 - little;
  return {box.u.lo + u * box.u.length(), box.v.lo + v * box.v.length()};
}

class FootFiles : public ::testing::TestWithParam<const char*> {
 protected:
  static constexpr double kReach = 0.12;  // of the points in each coordinate; faces are 5 to 10 large
  void SetUp() override {
    if (std::filesystem::exists(faces_folder() / "faces.tsv")) return;
    const char* ci = std::getenv("CI");
    if (ci && std::string(ci) == "true")
      FAIL() << faces_folder() << " is missing; set GEOVOR_SHARED to the folder of shared data";
    GTEST_SKIP() << faces_folder() << " is missing; set GEOVOR_SHARED to the folder of shared data";
  }
};

std::string family(const std::string& name) { return name.substr(0, name.find('_')); }

// Where the whole domain is the face, feet beyond its border are compared, too: with those on a surface of the family
// that ends there.
bool ends_at_face(const std::string& name) {
  const std::string f = family(name);
  return name.find("shear") == std::string::npos && (f == "ff" || f == "pl" || f == "cyl" || f == "sph" || f == "tor");
}
std::string bounded(const std::string& name) {
  const std::string f = family(name);
  return f == "ff" ? "ff_orig" : f == "pl" ? "pl_bilin" : f + "_nurbs";
}

bool on_border(Uv p, const Surface& s) {
  const UvBox domain = s.domain();
  return (!s.u_period() && (p.u <= domain.u.lo || p.u >= domain.u.hi)) ||
         (!s.v_period() && (p.v <= domain.v.lo || p.v >= domain.v.hi));
}

TEST_P(FootFiles, HaveTheFeetNormalsAndCurvaturesOfTheOriginal) {
  const std::string name = GetParam(), original = family(name) + "_orig";
  const bool whole = ends_at_face(name);
  const std::string bound = whole ? bounded(name) : original;
  const CadModel model = face_file(name), first = face_file(original), other = face_file(bound);
  auto errors = file_errors();
  const double apart = errors.at(name) + errors.at(original) + errors.at(bound);
  const Surface &a = *first.faces[0].surface, &b = *model.faces[0].surface, &c = *other.faces[0].surface;
  const UvBox box = parameter_box(model.faces[0]), a_box = parameter_box(first.faces[0]);
  const UvBox b_domain = whole ? box : b.domain(), c_box = whole ? parameter_box(other.faces[0]) : c.domain();
  const ShapeField ours(a, a_box), theirs(b, box);
  const double size = 10.0, foot_bar = 1e-12 * size + 4.0 * apart;
  // A normal feels the slope of what the files differ by, near a knot or a side over a tenth of the size and less.
  const double normal_bar = 1e-10 + 100.0 * apart;
  std::mt19937 random(1);
  int feet = 0, normals = 0;
  for (int i = 0; i < 240; ++i) {
    const Uv guess = some_place(random, box, i);
    const Xyz place = b.position(guess);
    const Xyz off(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    const Projection on = project(a, place, a.domain());
    if (on.distance < 4.0 * apart + 1e-14 * size) {  // elsewhere the domain is more than the face
      const SurfaceJet j = a.jet(on.uv), k = b.jet(guess);
      const auto truth = ours.at(on.uv, j), shape = theirs.at(guess, k);
      ASSERT_TRUE(truth && shape) << i;
      ++normals;
      const double sign = truth->n.dot(shape->n) < 0.0 ? -1.0 : 1.0;
      EXPECT_LT((truth->n - sign * shape->n).norm(), normal_bar) << i;
      EXPECT_NEAR(truth->largest_curvature(), shape->largest_curvature(), 1e-6 * (0.1 + truth->largest_curvature()))
          << i;
    }
    const Xyz x = place + (i % 5 == 0 ? 1e-7 : kReach) * off;
    const Projection foot = project_near(b, x, guess, b_domain), true_foot = project(c, x, c_box);
    EXPECT_TRUE(foot.converged) << i;
    if (!whole && on_border(foot.uv, b)) continue;
    EXPECT_TRUE(true_foot.converged) << i;
    ++feet;
    EXPECT_LT((foot.foot - true_foot.foot).norm(), foot_bar) << i << " from " << guess.u << " " << guess.v;
  }
  EXPECT_GE(feet, whole ? 240 : 100);
  EXPECT_GE(normals, 200);
}

INSTANTIATE_TEST_SUITE_P(Faces, FootFiles,
                         ::testing::Values("ff_deg5knots", "ff_swap", "ff_revu", "ff_swaprev", "ff_moeb4", "ff_moeb16",
                                           "ff_moeb64", "ff_pow3u", "ff_pow3uv", "ff_smooth", "pl_bilin", "pl_shear1",
                                           "pl_shear5", "pl_shear20", "pl_skew1", "pl_skew2", "pl_skew4", "pl_moeb4",
                                           "pl_moeb16", "pl_moeb64", "pl_pow3u", "pl_pow3uv", "pl_smooth", "cyl_nurbs",
                                           "cyl_moeb4", "cyl_moeb16", "cyl_moeb64", "cyl_pow3u", "cyl_pow3uv",
                                           "cyl_smooth", "sph_nurbs", "sph_moeb4", "sph_moeb16", "sph_moeb64",
                                           "sph_pow3u", "sph_pow3uv", "sph_smooth", "tor_nurbs", "tor_moeb4",
                                           "tor_moeb16", "tor_moeb64", "tor_pow3u", "tor_pow3uv", "tor_smooth",
                                           "oct_nurbs", "oct_axisx", "oct_axisout", "oct_axisin", "fsph_nurbs",
                                           "fsph_seam37", "fsph_tilt", "ftor_nurbs", "ftor_seam37", "ftor_nurbsv100"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace geovor
