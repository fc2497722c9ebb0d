#include "pipeline/check_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/error.h"
#include "brep/face_area.h"
#include "pipeline/cad_corners.h"

namespace geovor {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

class Checker {
 public:
  Checker(const LoadedMesh& loaded, const CadModel& model, const NearestOnCad::ForEach& for_each)
      : loaded_(loaded), mesh_(loaded.mesh), model_(model), for_each_(for_each), cad_(model, for_each) {}

  MeshCheck check();

 private:
  double area(int t) const { return 0.5 * area_vector(t).norm(); }
  Xyz area_vector(int t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return (mesh_.points[b] - mesh_.points[a]).cross(mesh_.points[c] - mesh_.points[a]);
  }
  int triangles() const { return static_cast<int>(mesh_.triangles.size()); }
  void assign_faces();
  void measure_vertices();
  void measure_angles();
  void measure_normals();
  void measure_faces();

  const LoadedMesh& loaded_;
  const TriangleMesh& mesh_;
  const CadModel& model_;
  const NearestOnCad::ForEach& for_each_;
  NearestOnCad cad_;
  MeshCheck result_;
};

MeshCheck Checker::check() {
  if (mesh_.triangles.empty()) {
    throw Error(ErrorCode::Unreadable, "the mesh holds no triangle; export it with its surface elements");
  }
  const int faces = static_cast<int>(model_.faces.size());
  bool usable = false;
  for (int f = 0; f < faces; ++f) usable = usable || cad_.on_face(f);
  if (!usable) throw Error(ErrorCode::FaceRejected, "no face of the CAD can be used; geovor info says why");
  result_.topology = topology(mesh_);
  result_.faults = mesh_faults(mesh_);
  result_.edges = edge_lengths(mesh_);
  const MeshQuality q = quality(mesh_);
  result_.area = q.area;
  result_.volume = q.volume;
  result_.on_cad = measure_to_cad(mesh_, cad_, for_each_);
  result_.on_mesh = measure_to_mesh(mesh_, cad_, for_each_);
  result_.faces.resize(faces);
  assign_faces();
  measure_vertices();
  measure_angles();
  measure_normals();
  measure_faces();
  return std::move(result_);
}

// By groups where they stand for one face each, otherwise by the place nearest to the centroid.
void Checker::assign_faces() {
  std::vector<std::map<int, int>> counts(loaded_.groups.size());
  result_.groups.resize(loaded_.groups.size());
  const auto nearest = [this](int t) { return result_.on_cad.middles[t].face; };
  for (int t = 0; t < triangles(); ++t) {
    if (mesh_.face_of[t] >= 0) ++counts[mesh_.face_of[t]][nearest(t)];
  }
  for (std::size_t g = 0; g < counts.size(); ++g) {
    CheckedGroup& group = result_.groups[g];
    int most = 0, face = -1;
    for (const auto& [f, count] : counts[g]) {
      group.triangles += count;
      if (count > most) most = count, face = f;
    }
    if (!(most > 0 && most >= kOfOneFace * group.triangles)) continue;
    group.face = face;
    group.elsewhere = group.triangles - most;
  }
  for (int t = 0; t < triangles(); ++t) {
    const int g = mesh_.face_of[t];
    result_.face_of.push_back(g >= 0 && result_.groups[g].face >= 0 ? result_.groups[g].face : nearest(t));
  }
}

void Checker::measure_vertices() {
  CheckedVertices& v = result_.vertices;
  v.tolerance = kOnCad * model_.diagonal() + loaded_.rounding;
  for (int i = 0; i < static_cast<int>(mesh_.points.size()); ++i) {
    const CadPlace& place = result_.on_cad.vertices[i];
    if (place.face < 0) continue;
    if (v.largest_at < 0 || place.distance > v.largest) {
      v.largest = place.distance;
      v.largest_at = i;
    }
    v.beyond += !(place.distance <= v.tolerance);
  }
}

// A small angle fills a sharp corner of the CAD where it stands at the corner's vertex and its triangle lies on the
// corner's face.
void Checker::measure_angles() {
  CheckedAngles& angles = result_.angles;
  const double widest = angles.narrow.back().limit;
  std::vector<CadCorner> sharp = cad_corners(model_);
  std::erase_if(sharp, [&](const CadCorner& c) { return !(c.angle < widest); });
  const auto corner_at = [&](int t, int point) {
    const CadCorner* found = nullptr;
    for (const CadCorner& c : sharp) {
      const double reach = model_.faces[c.face].tolerance + result_.vertices.tolerance;
      const bool here = c.face == result_.face_of[t] && (mesh_.points[point] - c.at).norm() <= reach;
      if (here && (!found || c.angle < found->angle)) found = &c;
    }
    return found;
  };
  angles.smallest = angles.smallest_elsewhere = 180.0;
  for (int t = 0; t < triangles(); ++t) {
    const auto a = corner_angles(mesh_, t);
    const int k = static_cast<int>(std::min_element(a.begin(), a.end()) - a.begin());
    if (angles.smallest_at < 0 || a[k] < angles.smallest) angles.smallest_at = t;
    angles.smallest = std::min(angles.smallest, a[k]);
    angles.largest = std::max(angles.largest, *std::max_element(a.begin(), a.end()));
    angles.mean_smallest += a[k] / triangles();
    CheckedFace& face = result_.faces[result_.face_of[t]];
    face.smallest_angle = face.triangles++ == 0 ? a[k] : std::min(face.smallest_angle, a[k]);
    const CadCorner* corner = a[k] < widest ? corner_at(t, mesh_.triangles[t][k]) : nullptr;
    for (NarrowTriangles& n : angles.narrow) {
      n.count += a[k] < n.limit;
      n.at_sharper_corners += a[k] < n.limit && corner && corner->angle < n.limit;
    }
    if (corner) {
      angles.at_sharper_corners.push_back({t, a[k], result_.face_of[t]});
    } else {
      angles.smallest_elsewhere = std::min(angles.smallest_elsewhere, a[k]);
    }
  }
}

// Of triangles without area there is no normal: they are listed elsewhere.
void Checker::measure_normals() {
  CheckedNormals& normals = result_.normals;
  std::vector<double> turn(triangles(), -1.0);
  for_each_(triangles(), [&](int t) {
    const int f = result_.face_of[t];
    CadPlace place = result_.on_cad.middles[t];
    if (place.face != f) {
      const auto& [a, b, c] = mesh_.triangles[t];
      place = cad_.nearest((mesh_.points[a] + mesh_.points[b] + mesh_.points[c]) / 3.0, f);
    }
    const Xyz n = cad_.on_face(f)->normal(place.uv), m = area_vector(t);
    const bool flat = std::binary_search(result_.faults.without_area.begin(), result_.faults.without_area.end(), t);
    if (!flat && n.squaredNorm() > 0.0) turn[t] = kDegrees * std::atan2(n.cross(m).norm(), n.dot(m));
  });
  double weight = 0.0;
  for (int t = 0; t < triangles(); ++t) {
    if (!(turn[t] >= 0.0)) continue;
    const double w = area(t);
    weight += w;
    normals.mean += w * turn[t];
    normals.rms += w * turn[t] * turn[t];
    if (normals.largest_at < 0 || turn[t] > normals.largest) normals.largest = turn[t], normals.largest_at = t;
    CheckedFace& face = result_.faces[result_.face_of[t]];
    face.normal_deviation = std::max(face.normal_deviation, turn[t]);
    if (!(turn[t] > 90.0)) continue;
    normals.inverted.push_back(t);
    ++face.inverted;
  }
  if (!(weight > 0.0)) return;
  normals.mean /= weight;
  normals.rms = std::sqrt(normals.rms / weight);
}

void Checker::measure_faces() {
  for (int t = 0; t < triangles(); ++t) {
    CheckedFace& face = result_.faces[result_.face_of[t]];
    face.mesh_area += area(t);
    face.to_cad = std::max(face.to_cad, result_.on_cad.largest[t]);
  }
  for_each_(static_cast<int>(result_.faces.size()), [&](int f) {
    CheckedFace& face = result_.faces[f];
    face.why_not = cad_.why_not(f);
    face.to_mesh = result_.on_mesh.largest_of_face[f];
    if (cad_.on_face(f)) face.face_area = face_area(model_, model_.faces[f]).value;
  });
}

}  // namespace

MeshCheck check_mesh(const LoadedMesh& loaded, const CadModel& model, const NearestOnCad::ForEach& for_each) {
  return Checker(loaded, model, for_each).check();
}

}  // namespace geovor
