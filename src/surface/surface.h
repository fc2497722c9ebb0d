// What every room above knows of a surface: a map r(u,v) that can be evaluated with its derivatives.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/interval.h"
#include "base/uv.h"
#include "base/xyz.h"

namespace geovor {

/// r(u,v) and its partial derivatives up to the second order, from one evaluation.
struct SurfaceJet {
  Xyz S, Su, Sv, Suu, Suv, Svv;
};

/// The partial derivatives of the third order.
struct SurfaceThirds {
  Xyz uuu, uuv, uvv, vvv;
};

/// A piece of the parameter plane on which the surface is one analytic function (for a B-spline: one
/// polynomial span). `u` and `v` name the piece to the surface that made it; `box` are its borders, infinite
/// where the piece has no border in that direction.
struct Span {
  int u = 0;
  int v = 0;
  UvBox box;
};

enum class SurfaceKind { Plane, Cylinder, Cone, Sphere, Torus, BSpline, Revolution, Extrusion, Offset, Function };

/// "plane", "cylinder", …: the words that the program prints.
std::string to_string(SurfaceKind kind);

class PoleChart;  // surface/pole_chart.h
using PoleCharts = std::vector<std::shared_ptr<const PoleChart>>;

/// What a surface finds out once, when it is first asked for it, from whatever thread. A copy starts anew.
class PoleCache {
 public:
  PoleCache();
  ~PoleCache();
  PoleCache(const PoleCache&) : PoleCache() {}
  PoleCache& operator=(const PoleCache& other);
  const PoleCharts& get(const class Surface& surface) const;

 private:
  struct Entry;
  std::unique_ptr<Entry> entry_;
};

/// A parametric surface. Immutable, so that any number of threads may evaluate it.
class Surface {
 public:
  virtual ~Surface() = default;

  virtual SurfaceKind kind() const = 0;

  /// The rectangle on which the map is defined; ends may be infinite (a plane) or, in a periodic direction,
  /// one period apart.
  virtual UvBox domain() const = 0;

  /// The period in u (v), where the map repeats itself: r(u + period, v) = r(u, v). Evaluation takes any
  /// parameter in a periodic direction.
  virtual std::optional<double> u_period() const { return std::nullopt; }
  virtual std::optional<double> v_period() const { return std::nullopt; }

  /// The jet at `p`. In a non-periodic direction a `p` outside the domain is evaluated on the continuation of
  /// the outermost piece (as OpenCASCADE does), which is meant for rounding-sized excursions.
  virtual SurfaceJet jet(Uv p) const = 0;

  /// Position only, where that is cheaper.
  virtual Xyz position(Uv p) const { return jet(p).S; }

  /// The analytic piece that holds `p`; on a border between pieces, the one into which `towards` points.
  virtual Span span(Uv p, UvVec towards) const {
    (void)p, (void)towards;
    constexpr double kInf = std::numeric_limits<double>::infinity();
    return {0, 0, {{-kInf, kInf}, {-kInf, kInf}}};
  }

  /// The jet of the analytic piece `span`, also outside the borders of that piece: an integrator that stays on
  /// one piece meets no knot.
  virtual SurfaceJet jet(Uv p, const Span& span) const {
    (void)span;
    return jet(p);
  }

  /// The third derivatives of the analytic piece `span`. Exact, unless the surface says otherwise: those that don't
  /// have them take differences of fourth order of the second derivatives, good to about 1e-12 of their size.
  virtual SurfaceThirds third(Uv p, const Span& span) const;

  /// Smallest order of continuity across the lines between pieces inside the domain: 0 for a surface with
  /// creases, kSmooth where it is analytic.
  static constexpr int kSmooth = 99;
  virtual int continuity() const { return kSmooth; }

  /// Charts of the places where a side of the domain, in a direction that is not periodic, is one point of space but
  /// the surface is smooth all the same (surface/pole_chart.h). The tip of a cone is no such place. Made at the first
  /// call; safe from any thread.
  const PoleCharts& poles() const { return pole_cache_.get(*this); }

 private:
  friend class PoleCache;
  virtual PoleCharts make_poles() const { return {}; }
  PoleCache pole_cache_;
};

using SurfacePtr = std::shared_ptr<const Surface>;

}  // namespace geovor
