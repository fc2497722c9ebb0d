#include "pipeline/mesh_distances.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/mesh_faults.h"
#include "mesh/triangle_tree.h"

namespace geovor {
namespace {

/// A mesh of few triangles is sampled as if it had so many.
constexpr double kFewestTriangles = 10000;
/// Of the step on the mesh: the CAD is sampled more closely, since its samples know nothing of the mesh's edges.
constexpr double kStepOnCad = 0.5;
/// Points in a row of one triangle, of one side, or of a patch: a sliver from end to end of a part is not sampled for
/// ever.
constexpr int kMostInRow = 200;
/// Work is handed out in pieces of so many elements; their results are joined in order.
constexpr int kChunk = 512;

struct Sum {
  double weight = 0.0, first = 0.0, second = 0.0;
  long samples = 0;
  DistanceFigures worst{-1.0, 0.0, 0.0, Xyz::Zero(), Xyz::Zero(), -1, -1, 0};
  Uv uv;  ///< of the worst, where that is on the CAD

  void add(double distance, double w) {
    ++samples;
    weight += w;
    first += w * distance;
    second += w * distance * distance;
  }
  void add(const Sum& other) {
    samples += other.samples;
    weight += other.weight;
    first += other.first;
    second += other.second;
    if (other.worst.largest > worst.largest) worst = other.worst, uv = other.uv;
  }
  DistanceFigures figures() const {
    DistanceFigures f = worst;
    f.largest = std::max(f.largest, 0.0);
    f.samples = samples;
    if (weight > 0.0) {
      f.mean = first / weight;
      f.rms = std::sqrt(second / weight);
    }
    return f;
  }
};

/// Runs body(i, sum) for 0 … n-1 in chunks; the sums are joined in order.
template <typename Body>
Sum in_chunks(int n, const NearestOnCad::ForEach& for_each, Body&& body) {
  const int chunks = (n + kChunk - 1) / kChunk;
  std::vector<Sum> parts(chunks);
  for_each(chunks, [&](int c) {
    for (int i = c * kChunk; i < std::min(n, (c + 1) * kChunk); ++i) body(i, parts[c]);
  });
  Sum all;
  for (const Sum& part : parts) all.add(part);
  return all;
}

int steps(double length, double step) {
  const double n = std::ceil(length / step);
  return n >= 1.0 ? static_cast<int>(std::min(n, static_cast<double>(kMostInRow))) : 1;
}

double triangle_area(const TriangleMesh& mesh, int t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return 0.5 * (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
}

double sampling_step(const TriangleMesh& mesh) {
  double area = 0.0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) area += triangle_area(mesh, t);
  return std::sqrt(area / std::max(static_cast<double>(mesh.triangles.size()), kFewestTriangles));
}

/// Raises value(p) from the place p by trying all round at ever smaller steps; value is negative where p is no place.
template <typename Value>
std::array<double, 2> climb(std::array<double, 2> p, std::array<double, 2> step, Value&& value) {
  constexpr int kHalvings = 30, kTries = 400;
  double best = value(p);
  for (int halvings = 0, tries = 0; halvings < kHalvings && tries < kTries; ++tries) {
    bool higher = false;
    for (const auto& [du, dv] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, -1}, {-1, 1}}) {
      const std::array<double, 2> q{p[0] + du * step[0], p[1] + dv * step[1]};
      const double v = value(q);
      if (!(v > best)) continue;
      best = v;
      p = q;
      higher = true;
    }
    if (higher) continue;
    step = {0.5 * step[0], 0.5 * step[1]};
    ++halvings;
  }
  return p;
}

class MeshSampler {
 public:
  MeshSampler(const TriangleMesh& mesh, const NearestOnCad& cad, const NearestOnCad::ForEach& for_each,
              MeshOnCad& result)
      : mesh_(mesh), cad_(cad), for_each_(for_each), step_(sampling_step(mesh)), result_(result) {}

  void measure() {
    Sum all = vertices();
    all.add(edges());
    all.add(insides());
    result_.distance = all.figures();
    climb_from_worst();
    const double& worst = result_.distance.largest;
    double& there = result_.largest[result_.distance.triangle];
    there = std::max(there, worst);
  }

 private:
  CadPlace take(const Xyz& x, int triangle, double weight, double& largest, Sum& sum) const {
    const CadPlace place = cad_.nearest(x);
    sum.add(place.distance, weight);
    largest = std::max(largest, place.distance);
    if (place.distance > sum.worst.largest) {
      sum.worst.largest = place.distance;
      sum.worst.from = x;
      sum.worst.to = place.foot;
      sum.worst.face = place.face;
      sum.worst.triangle = triangle;
    }
    return place;
  }

  Sum vertices();
  Sum edges();
  Sum insides();
  void climb_from_worst();

  const TriangleMesh& mesh_;
  const NearestOnCad& cad_;
  const NearestOnCad::ForEach& for_each_;
  double step_;
  MeshOnCad& result_;
};

Sum MeshSampler::vertices() {
  std::vector<int> triangle(mesh_.points.size(), -1);
  for (int t = static_cast<int>(mesh_.triangles.size()) - 1; t >= 0; --t) {
    for (const int p : mesh_.triangles[t]) triangle[p] = t;
  }
  result_.vertices.resize(mesh_.points.size());
  const Sum sum = in_chunks(static_cast<int>(mesh_.points.size()), for_each_, [&](int i, Sum& part) {
    double largest = 0.0;
    if (triangle[i] >= 0) result_.vertices[i] = take(mesh_.points[i], triangle[i], 0.0, largest, part);
  });
  result_.largest.assign(mesh_.triangles.size(), 0.0);
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (const int p : mesh_.triangles[t]) {
      result_.largest[t] = std::max(result_.largest[t], result_.vertices[p].distance);
    }
  }
  return sum;
}

Sum MeshSampler::edges() {
  std::vector<MeshEdge> edges = mesh_edges(mesh_);
  std::vector<double> largest(edges.size(), 0.0);
  const Sum sum = in_chunks(static_cast<int>(edges.size()), for_each_, [&](int e, Sum& part) {
    const Xyz a = mesh_.points[edges[e].from], d = mesh_.points[edges[e].to] - a;
    const int n = 2 * steps(0.5 * d.norm(), step_);  // even: the middle is where a chord is farthest off
    for (int k = 1; k < n; ++k) take(a + d * k / n, edges[e].triangles.front(), 0.0, largest[e], part);
  });
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (const int t : edges[e].triangles) result_.largest[t] = std::max(result_.largest[t], largest[e]);
  }
  return sum;
}

// Rows along the longest side, each point for an equal part of the area of its row.
Sum MeshSampler::insides() {
  result_.middles.resize(mesh_.triangles.size());
  return in_chunks(static_cast<int>(mesh_.triangles.size()), for_each_, [&](int t, Sum& part) {
    const auto& corners = mesh_.triangles[t];
    const double area = triangle_area(mesh_, t);
    int k = 0;
    double longest = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double length = (mesh_.points[corners[(i + 1) % 3]] - mesh_.points[corners[i]]).norm();
      if (length > longest) longest = length, k = i;
    }
    const Xyz &a = mesh_.points[corners[k]], &b = mesh_.points[corners[(k + 1) % 3]],
              &apex = mesh_.points[corners[(k + 2) % 3]];
    const int rows = longest > 0.0 ? steps(2.0 * area / longest, step_) : 1;
    double& largest = result_.largest[t];
    result_.middles[t] = take((a + b + apex) / 3.0, t, rows == 1 ? area : 0.0, largest, part);
    for (int r = 0; rows > 1 && r < rows; ++r) {
      const double lo = static_cast<double>(r) / rows, hi = static_cast<double>(r + 1) / rows, f = 0.5 * (lo + hi);
      const int n = steps((1.0 - f) * longest, step_);
      const double weight = area * ((1.0 - lo) * (1.0 - lo) - (1.0 - hi) * (1.0 - hi)) / n;
      for (int i = 0; i < n; ++i) {
        const double g = (i + 0.5) / n;
        take((1.0 - f) * ((1.0 - g) * a + g * b) + f * apex, t, weight, largest, part);
      }
    }
  });
}

void MeshSampler::climb_from_worst() {
  DistanceFigures& worst = result_.distance;
  if (worst.triangle < 0) return;
  const auto& t = mesh_.triangles[worst.triangle];
  const Xyz &a = mesh_.points[t[0]], p = mesh_.points[t[1]] - a, q = mesh_.points[t[2]] - a;
  const double pp = p.squaredNorm(), pq = p.dot(q), qq = q.squaredNorm(), det = pp * qq - pq * pq;
  if (!(det > 0.0)) return;
  const Xyz r = worst.from - a;
  const auto inside = [](double x) { return std::clamp(x, 0.0, 1.0); };
  std::array<double, 2> start{inside((qq * r.dot(p) - pq * r.dot(q)) / det), 0.0};
  start[1] = std::min(inside((pp * r.dot(q) - pq * r.dot(p)) / det), 1.0 - start[0]);
  constexpr double kStep = 0.25;
  climb(start, {kStep, kStep}, [&](const std::array<double, 2>& k) {
    // Held inside by clamping, so that rounding does not stop a walk along a side.
    const double k0 = inside(k[0]), k1 = std::clamp(k[1], 0.0, 1.0 - k0);
    const Xyz x = a + k0 * p + k1 * q;
    const CadPlace place = cad_.nearest(x);
    if (place.distance > worst.largest) {
      worst.largest = place.distance;
      worst.from = x;
      worst.to = place.foot;
      worst.face = place.face;
    }
    return place.distance;
  });
}

class CadSampler {
 public:
  CadSampler(const TriangleMesh& mesh, const NearestOnCad& cad, const NearestOnCad::ForEach& for_each)
      : cad_(cad), for_each_(for_each), tree_(mesh), step_(kStepOnCad * sampling_step(mesh)) {}

  CadOnMesh measure() {
    CadOnMesh result;
    Sum all;
    for (int f = 0; f < static_cast<int>(cad_.model().faces.size()); ++f) {
      const NearestOnFace* face = cad_.on_face(f);
      Sum sum;
      if (face) {
        sum = surface(*face, f);
        sum.add(border(*face, f));
      }
      result.largest_of_face.push_back(std::max(sum.worst.largest, 0.0));
      all.add(sum);
    }
    result.distance = all.figures();
    climb_from(all, result);
    return result;
  }

 private:
  void take(const Xyz& x, Uv uv, int face, double weight, Sum& sum) const {
    const TriangleTree::Nearest n = tree_.nearest(x);
    sum.add(n.distance, weight);
    if (n.distance > sum.worst.largest) {
      sum.worst.largest = n.distance;
      sum.worst.from = x;
      sum.worst.to = n.foot;
      sum.worst.face = face;
      sum.worst.triangle = n.triangle;
      sum.uv = uv;
    }
  }

  Sum surface(const NearestOnFace& face, int f) const;
  Sum border(const NearestOnFace& face, int f) const;
  void climb_from(const Sum& all, CadOnMesh& result) const;

  const NearestOnCad& cad_;
  const NearestOnCad::ForEach& for_each_;
  TriangleTree tree_;
  double step_;
};

// A grid in each patch, each point for its part of the area.
Sum CadSampler::surface(const NearestOnFace& face, int f) const {
  const auto& patches = face.patches();
  const Surface& s = face.domain().surface();
  return in_chunks(static_cast<int>(patches.size()), for_each_, [&](int i, Sum& part) {
    const SurfacePatch& patch = patches[i];
    const Xyz size = patch.extent.hi - patch.extent.lo;
    const double du = patch.box.u.length(), dv = patch.box.v.length();
    const int nu = steps(std::min(patch.Su.norm() * du, size.norm()), step_);
    const int nv = steps(std::min(patch.Sv.norm() * dv, size.norm()), step_);
    for (int a = 0; a < nu; ++a) {
      for (int b = 0; b < nv; ++b) {
        const Uv uv{patch.box.u.lo + du * (a + 0.5) / nu, patch.box.v.lo + dv * (b + 0.5) / nv};
        if (!patch.inside && !face.domain().contains(uv)) continue;
        const SurfaceJet j = s.jet(uv);
        take(j.S, uv, f, j.Su.cross(j.Sv).norm() * du / nu * dv / nv, part);
      }
    }
  });
}

// Points on the edges' curves, which bound the figures and carry no area.
Sum CadSampler::border(const NearestOnFace& face, int f) const {
  const auto& pieces = face.border();
  return in_chunks(static_cast<int>(pieces.size()), for_each_, [&](int i, Sum& part) {
    const NearestOnFace::BorderPiece& piece = pieces[i];
    const int n = steps((piece.curve->position(piece.t.hi) - piece.curve->position(piece.t.lo)).norm(), step_);
    for (int k = 0; k <= n; ++k) {
      const double t = piece.t.lo + piece.t.length() * k / n;
      const auto uv = piece.coedge->pcurve->position(t);
      take(piece.curve->position(t), {uv[0], uv[1]}, f, 0.0, part);
    }
  });
}

void CadSampler::climb_from(const Sum& all, CadOnMesh& result) const {
  DistanceFigures& worst = result.distance;
  if (worst.face < 0) return;
  const NearestOnFace& face = *cad_.on_face(worst.face);
  const Surface& s = face.domain().surface();
  const SurfaceJet j = s.jet(all.uv);
  const UvBox& box = face.domain().box();
  const auto step = [this](double speed, double most) { return speed > 0.0 ? std::min(step_ / speed, most) : most; };
  climb({all.uv.u, all.uv.v}, {step(j.Su.norm(), box.u.length()), step(j.Sv.norm(), box.v.length())},
        [&](const std::array<double, 2>& p) {
          const Uv uv{p[0], p[1]};
          if (!face.domain().contains(uv)) return -1.0;
          const Xyz x = s.position(uv);
          const TriangleTree::Nearest n = tree_.nearest(x);
          if (n.distance > worst.largest) {
            worst.largest = n.distance;
            worst.from = x;
            worst.to = n.foot;
            worst.triangle = n.triangle;
          }
          return n.distance;
        });
  double& of_face = result.largest_of_face[worst.face];
  of_face = std::max(of_face, worst.largest);
}

}  // namespace

MeshOnCad measure_to_cad(const TriangleMesh& mesh, const NearestOnCad& cad, const NearestOnCad::ForEach& for_each) {
  MeshOnCad result;
  if (!mesh.triangles.empty()) MeshSampler(mesh, cad, for_each, result).measure();
  return result;
}

CadOnMesh measure_to_mesh(const TriangleMesh& mesh, const NearestOnCad& cad, const NearestOnCad::ForEach& for_each) {
  return CadSampler(mesh, cad, for_each).measure();
}

}  // namespace geovor
