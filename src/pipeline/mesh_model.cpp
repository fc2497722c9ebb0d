#include "pipeline/mesh_model.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>
#include <set>

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

void validate(const MeshOptions& o, const CadModel& model) {
  require(o.size > 0.0 && std::isfinite(o.size), "the size must be a positive length; give --size a number above 0");
  require(model.diagonal() <= kMostSizesAcross * o.size,
          "the size is less than 1/10000 of the model's diagonal; give a larger --size (the lengths here are in " +
              model.unit + ")");
  require(o.min_size >= 0.0 && o.min_size <= o.size, "the smallest size must lie between 0 and the size");
  require(o.deflection > 0.0, "the deflection must be a positive length");
  require(o.angle > 0.0, "the angle must be positive");
  require(o.gradation > 0.0, "the gradation must be positive");
  for (int n : o.faces) {
    require(
        n >= 1 && n <= static_cast<int>(model.faces.size()),
        "there is no Face" + std::to_string(n) + "; the file has Face1 to Face" + std::to_string(model.faces.size()));
  }
}

std::vector<int> selected(const MeshOptions& o, const CadModel& model) {
  std::set<int> chosen;
  for (int n : o.faces) chosen.insert(n - 1);
  if (o.faces.empty()) {
    for (size_t f = 0; f < model.faces.size(); ++f) chosen.insert(static_cast<int>(f));
  }
  return {chosen.begin(), chosen.end()};
}

// Border points that keep every face's border polygon simple: where it crosses itself its edges get twice as many
// points.
BorderPoints place_border(const CadModel& model, const std::vector<int>& faces, const SizeRule& rule) {
  constexpr int kMostHalvings = 4;
  std::vector<double> finer(model.edges.size(), 1.0);
  BorderPoints border = sample_border(model, rule, finer);
  for (int round = 0; round < kMostHalvings; ++round) {
    bool changed = false;
    for (int f : faces) {
      const CadFace& face = model.faces[f];
      if (!face.surface) continue;
      const std::vector<int> bad = points_to_refine(face, border);
      const std::set<int> at(bad.begin(), bad.end());
      std::set<int> edges;
      for (const TrimLoop& loop : face.loops) {
        for (const Coedge& c : loop.coedges) {
          const auto& points = border.edges[c.edge].points;
          if (std::any_of(points.begin(), points.end(), [&at](int p) { return at.count(p) > 0; })) edges.insert(c.edge);
        }
      }
      for (int e : edges) finer[e] *= 2.0;
      changed = changed || !edges.empty();
    }
    if (!changed) break;
    border = sample_border(model, rule, finer);
  }
  return border;
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

void describe(const CadFace& face, const BorderPoints& border, const FaceMesh& part, FaceReport& report) {
  Assembly alone(border);
  alone.add(face, part);
  const MeshQuality q = quality(alone.mesh);
  report.triangles = static_cast<int>(part.triangles.size());
  report.inverted = part.inverted;
  report.smallest_angle = q.smallest_angle;
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
  }
}

/// One face: its triangles into `part`, what became of it into `report`.
void mesh_one(const CadModel& model, const CadFace& face, const BorderPoints& border, const SizeRule& rule,
              FaceMesh& part, FaceReport& report) {
  const auto start = Clock::now();
  if (face.surface) {
    part = mesh_face(face, border, rule);
    report.face_area = face_area(model, face).value;
  } else {
    part.why = face.problems.empty() ? "it has no surface that can be used" : face.problems.front();
  }
  if (part.ok) {
    describe(face, border, part, report);
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
  const SizeRule rule{options.size, smallest_size(options, model), options.deflection, options.angle,
                      options.gradation};
  const std::vector<int> faces = selected(options, model);
  const int total = static_cast<int>(faces.size());

  MeshResult result;
  result.smallest_size = rule.min_size;
  auto start = Clock::now();
  const BorderPoints border = place_border(model, faces, rule);
  result.seconds_borders = seconds_since(start);

  start = Clock::now();
  std::vector<FaceMesh> parts(total);
  result.faces.resize(total);
  Progress progress(total, options.progress);
  const auto body = [&](int i) {
    const CadFace& face = model.faces[faces[i]];
    FaceReport& report = result.faces[i];
    report.face = face.number;
    if (progress.stopped()) {
      report.status = FaceStatus::Stopped;
      report.why = "the work was stopped before it";
      return;
    }
    mesh_one(model, face, border, rule, parts[i], report);
    progress.add();
  };
  if (options.for_each) {
    options.for_each(total, body);
  } else {
    for (int i = 0; i < total; ++i) body(i);
  }
  result.seconds_faces = seconds_since(start);

  Assembly assembly(border);
  for (int i = 0; i < total; ++i) {
    if (!parts[i].ok) continue;
    assembly.add(model.faces[faces[i]], parts[i]);
  }
  result.mesh = std::move(assembly.mesh);
  return result;
}

}  // namespace geovor
