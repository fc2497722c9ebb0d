#include "pipeline/mesh_model.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iomanip>
#include <iterator>
#include <limits>
#include <mutex>
#include <numeric>
#include <set>
#include <sstream>

#include "base/error.h"
#include "brep/face_area.h"
#include "delaunay/border.h"
#include "delaunay/face_mesh.h"
#include "mesh/mesh_checks.h"

namespace geovor {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void require(bool holds, const std::string& message) {
  if (!holds) throw Error(ErrorCode::Usage, message);
}

// A part of a million triangles has a diagonal of about 700 sizes. Far beyond that the unit is mistaken.
constexpr double kMostSizesAcross = 1e4;

void require_face(int number, const CadModel& model) {
  require(number >= 1 && number <= static_cast<int>(model.faces.size()), "there is no Face" + std::to_string(number) +
                                                                             "; the file has Face1 to Face" +
                                                                             std::to_string(model.faces.size()));
}

// The largest distance between the ends and middles of a face's edges.
double extent(const CadModel& model, const CadFace& face) {
  Xyz lower = Xyz::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  for (const TrimLoop& loop : face.loops) {
    for (const Coedge& c : loop.coedges) {
      const CadEdge& e = model.edges[c.edge];
      if (e.degenerate()) continue;
      for (double t : {e.range.lo, e.range.middle(), e.range.hi}) {
        lower = lower.cwiseMin(e.curve->position(t));
        upper = upper.cwiseMax(e.curve->position(t));
      }
    }
  }
  return std::max(0.0, (upper - lower).maxCoeff());
}

void validate(const std::vector<FaceRule>& rules, const CadModel& model) {
  std::set<int> seen;
  for (const FaceRule& rule : rules) {
    require_face(rule.face, model);
    const std::string face = "Face" + std::to_string(rule.face);
    require(seen.insert(rule.face).second, face + " has two rules; leave one of them out");
    for (const std::optional<double>& value : {rule.size, rule.deflection, rule.angle}) {
      require(!value || (*value > 0.0 && std::isfinite(*value)), "a rule of " + face + " is not a number above 0");
    }
    require(!rule.size || extent(model, model.faces[rule.face - 1]) <= kMostSizesAcross * *rule.size,
            "the size of " + face + " is less than 1/10000 of its extent; give a larger one (the lengths here are in " +
                model.unit + ")");
  }
}

void validate(const MeshOptions& o, const CadModel& model) {
  require(o.size > 0.0 && std::isfinite(o.size), "the size must be a positive length; give --size a number above 0");
  require(model.diagonal() <= kMostSizesAcross * o.size,
          "the size is less than 1/10000 of the model's diagonal; give a larger --size (the lengths here are in " +
              model.unit + ")");
  require(o.min_size >= 0.0 && o.min_size <= o.size, "the smallest size must lie between 0 and the size");
  require(o.deflection > 0.0, "the deflection must be a positive length");
  require(o.angle > 0.0, "the angle must be positive");
  require(o.gradation > 0.0, "the gradation must be positive");
  for (int n : o.faces) require_face(n, model);
  validate(o.face_rules, model);
}

// One rule a face.
std::vector<SizeRule> rules_of(const MeshOptions& o, const CadModel& model) {
  const SizeRule general{o.size, smallest_size(o, model), o.deflection, o.angle, o.gradation};
  std::vector<SizeRule> rules(model.faces.size(), general);
  for (const FaceRule& own : o.face_rules) {
    MeshOptions as_own = o;
    as_own.size = own.size.value_or(o.size);
    rules[own.face - 1] = {as_own.size, smallest_size(as_own, model), own.deflection.value_or(o.deflection),
                           own.angle.value_or(o.angle), o.gradation};
  }
  return rules;
}

void run_each(const MeshOptions& o, int n, const std::function<void(int)>& body) {
  if (o.for_each) return o.for_each(n, body);
  for (int i = 0; i < n; ++i) body(i);
}

std::vector<int> selected(const MeshOptions& o, const CadModel& model) {
  std::set<int> chosen;
  for (int n : o.faces) chosen.insert(n - 1);
  if (o.faces.empty()) {
    for (size_t f = 0; f < model.faces.size(); ++f) chosen.insert(static_cast<int>(f));
  }
  return {chosen.begin(), chosen.end()};
}

// The face's edges whose border points stand in the way of a triangulation.
std::set<int> edges_to_refine(const CadFace& face, const BorderPoints& border) {
  std::set<int> edges;
  if (!face.surface) return edges;
  const std::vector<int> bad = points_to_refine(face, border);
  const std::set<int> at(bad.begin(), bad.end());
  for (const TrimLoop& loop : face.loops) {
    for (const Coedge& c : loop.coedges) {
      const auto& points = border.edges[c.edge].points;
      if (std::any_of(points.begin(), points.end(), [&at](int p) { return at.count(p) > 0; })) edges.insert(c.edge);
    }
  }
  return edges;
}

struct Border {
  BorderPoints points;
  std::vector<SharpCorner> corners;
};

// Border points that keep every face's border polygon simple: where it crosses itself its edges get twice as many
// points.
Border place_border(const CadModel& model, const std::vector<int>& faces, const std::vector<SizeRule>& rules,
                    const MeshOptions& options) {
  constexpr int kMostHalvings = 4;
  const auto for_each = [&options](int n, const std::function<void(int)>& body) { run_each(options, n, body); };
  const BorderSampler sampler(model, rules, for_each);
  std::vector<double> finer(model.edges.size(), 1.0);
  BorderPoints border = sampler.sample(finer);
  for (int round = 0; round < kMostHalvings; ++round) {
    std::vector<std::set<int>> edges(faces.size());
    for_each(static_cast<int>(faces.size()), [&](int i) { edges[i] = edges_to_refine(model.faces[faces[i]], border); });
    bool changed = false;
    for (const std::set<int>& of_face : edges) {
      for (int e : of_face) finer[e] *= 2.0;
      changed = changed || !of_face.empty();
    }
    if (!changed) break;
    border = sampler.sample(finer);
  }
  std::vector<SharpCorner> corners = small_corners(model, sampler.sharp_corners(), border);
  return {std::move(border), std::move(corners)};
}

// The faces' triangles over common points: the border points that are used, then each face's inner points.
class Assembly {
 public:
  explicit Assembly(const BorderPoints& border) : border_(border), point_of_border_(border.points.size(), -1) {}

  void add(const CadFace& face, const FaceMesh& part) {
    const int first_inner = static_cast<int>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), part.inner.begin(), part.inner.end());
    for (std::array<int, 3> corners : part.triangles) {
      for (int& c : corners) c = c < 0 ? first_inner - 1 - c : border_point(c);
      if (face.reversed) std::swap(corners[1], corners[2]);
      mesh.triangles.push_back(corners);
      mesh.face_of.push_back(face.number);
    }
  }

  TriangleMesh mesh;

 private:
  int border_point(int b) {
    if (point_of_border_[b] < 0) {
      point_of_border_[b] = static_cast<int>(mesh.points.size());
      mesh.points.push_back(border_.points[b]);
    }
    return point_of_border_[b];
  }

  const BorderPoints& border_;
  std::vector<int> point_of_border_;
};

std::string number_text(double value) {
  std::ostringstream text;
  text << std::setprecision(3) << value;
  return text.str();
}

void describe(const CadFace& face, const Border& border, const FaceMesh& part, const SizeRule& rule,
              FaceReport& report) {
  Assembly alone(border.points);
  alone.add(face, part);
  const MeshQuality q = quality(alone.mesh);
  report.triangles = static_cast<int>(part.triangles.size());
  report.inverted = part.inverted;
  report.smallest_angle = q.smallest_angle;
  std::vector<SharpCorner> corners;
  std::copy_if(border.corners.begin(), border.corners.end(), std::back_inserter(corners),
               [&face](const SharpCorner& c) { return c.face == face.number; });
  report.below_30 = small_angles(part, border.points, corners);
  report.largest_distance = part.largest_distance;
  report.mesh_area = q.area;
  report.estimated_lengths = part.estimated_lengths;
  report.status = FaceStatus::Meshed;
  if (part.inverted > 0) {
    report.status = FaceStatus::Partial;
    report.why = std::to_string(part.inverted) + " triangles face the wrong side; a smaller --size may mend it";
  } else if (part.too_large > 0) {
    report.status = FaceStatus::Partial;
    report.why =
        std::to_string(part.too_large) + " triangles stayed larger than asked for; a smaller --size may mend it";
  } else if (part.largest_distance > rule.deflection) {
    report.status = FaceStatus::Partial;
    report.why = "a triangle lies " + number_text(part.largest_distance) +
                 " from the face and not within the deflection " + number_text(rule.deflection) +
                 "; no rule asks for less than " + number_text(rule.min_size) +
                 ": a lower --min-size or a smaller --size may mend it";
  }
}

/// The order in which the faces are meshed: those with the most border points first, or one thread might begin a large
/// one when the others have nothing left.
std::vector<int> largest_first(const CadModel& model, const std::vector<int>& faces, const BorderPoints& border) {
  std::vector<std::size_t> points(faces.size(), 0);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (const TrimLoop& loop : model.faces[faces[i]].loops) {
      for (const Coedge& c : loop.coedges) points[i] += border.edges[c.edge].points.size();
    }
  }
  std::vector<int> order(faces.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&points](int a, int b) { return points[a] > points[b]; });
  return order;
}

/// One face: its triangles into `part`, what became of it into `report`.
void mesh_one(const CadModel& model, const CadFace& face, const Border& border, const SizeRule& rule, FaceMesh& part,
              FaceReport& report) {
  const auto start = Clock::now();
  if (face.surface) {
    part = mesh_face(face, border.points, rule);
    // Good to 1e-6 or better: that is what the report's digits show of the difference between the two areas.
    constexpr double kRelative = 1e-5;
    report.face_area = face_area(model, face, kRelative).value;
  } else {
    part.why = face.problems.empty() ? "it has no surface that can be used" : face.problems.front();
  }
  if (part.ok) {
    describe(face, border, part, rule, report);
  } else {
    report.why = part.why + "; repair the face in the CAD system, or leave it out with --faces";
  }
  report.seconds = seconds_since(start);
}

/// How many faces are done, and whether the work is to stop; for several threads.
class Progress {
 public:
  Progress(int total, const std::function<bool(int, int)>& report) : total_(total), report_(report) {}

  bool stopped() {
    const std::lock_guard lock(mutex_);
    return stopped_;
  }

  void add() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (report_ && !report_(done_, total_)) stopped_ = true;
  }

 private:
  std::mutex mutex_;
  int done_ = 0, total_;
  bool stopped_ = false;
  const std::function<bool(int, int)>& report_;
};

}  // namespace

double smallest_size(const MeshOptions& options, const CadModel& model) {
  if (options.min_size > 0.0) return options.min_size;
  // Small fillets are followed, and a cusp does not run away; a size beyond the part itself does not make it coarser.
  constexpr double kOfSize = 1.0 / 20, kOfDiagonal = 1.0 / 10;
  const double diagonal = model.diagonal();
  return kOfSize * (diagonal > 0.0 ? std::min(options.size, kOfDiagonal * diagonal) : options.size);
}

MeshResult mesh_model(const CadModel& model, const MeshOptions& options) {
  validate(options, model);
  const std::vector<SizeRule> rules = rules_of(options, model);
  const std::vector<int> faces = selected(options, model);
  const int total = static_cast<int>(faces.size());

  MeshResult result;
  result.smallest_size = smallest_size(options, model);
  auto start = Clock::now();
  const Border border = place_border(model, faces, rules, options);
  result.seconds_borders = seconds_since(start);

  start = Clock::now();
  std::vector<FaceMesh> parts(total);
  result.faces.resize(total);
  Progress progress(total, options.progress);
  const auto body = [&](int i) {
    const CadFace& face = model.faces[faces[i]];
    FaceReport& report = result.faces[i];
    report.face = face.number;
    report.size = rules[faces[i]].size;
    if (progress.stopped()) {
      report.status = FaceStatus::Stopped;
      report.why = "the work was stopped before it";
      return;
    }
    mesh_one(model, face, border, rules[faces[i]], parts[i], report);
    progress.add();
  };
  const std::vector<int> order = largest_first(model, faces, border.points);
  run_each(options, total, [&](int i) { body(order[i]); });
  result.seconds_faces = seconds_since(start);

  Assembly assembly(border.points);
  for (int i = 0; i < total; ++i) {
    if (!parts[i].ok) continue;
    assembly.add(model.faces[faces[i]], parts[i]);
  }
  result.mesh = std::move(assembly.mesh);
  const std::set<int> chosen(faces.begin(), faces.end());
  std::copy_if(border.corners.begin(), border.corners.end(), std::back_inserter(result.sharp_corners),
               [&chosen](const SharpCorner& c) { return chosen.count(c.face - 1) > 0; });
  return result;
}

}  // namespace geovor
