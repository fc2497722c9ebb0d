// Smooth surfaces given by formulas, for tests, samples and documentation (SurfaceKind::Function).
#pragma once

#include <vector>

#include "surface/height_jet.h"
#include "surface/surface.h"

namespace geovor {

/// The graph (u, v, f(u, v)) over a rectangle.
class GraphSurface : public Surface {
 public:
  explicit GraphSurface(const UvBox& domain) : domain_(domain) {}
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return domain_; }
  SurfaceJet jet(Uv p) const final {
    const HeightJet h = height(p);
    return {{p.u, p.v, h.f},   {1.0, 0.0, h.fu},  {0.0, 1.0, h.fv},
            {0.0, 0.0, h.fuu}, {0.0, 0.0, h.fuv}, {0.0, 0.0, h.fvv}};
  }
  using Surface::jet;
  SurfaceThirds third(Uv p, const Span&) const final {
    const HeightThirds h = height_thirds(p);
    return {{0.0, 0.0, h.fuuu}, {0.0, 0.0, h.fuuv}, {0.0, 0.0, h.fuvv}, {0.0, 0.0, h.fvvv}};
  }
  virtual HeightJet height(Uv p) const = 0;
  virtual HeightThirds height_thirds(Uv p) const = 0;

 private:
  UvBox domain_;
};

/// z = sin u cos v, the wave of the paper's figures.
class WaveSurface final : public GraphSurface {
 public:
  using GraphSurface::GraphSurface;
  HeightJet height(Uv p) const override;
  HeightThirds height_thirds(Uv p) const override;
};

/// z = u^2 + v^2.
class Paraboloid final : public GraphSurface {
 public:
  using GraphSurface::GraphSurface;
  HeightJet height(Uv p) const override;
  HeightThirds height_thirds(Uv p) const override;
};

/// z = u^3 - 3 u v^2.
class MonkeySaddle final : public GraphSurface {
 public:
  using GraphSurface::GraphSurface;
  HeightJet height(Uv p) const override;
  HeightThirds height_thirds(Uv p) const override;
};

/// z = sum of A exp(-|(u, v) - centre|^2 / (2 s^2)).
class GaussianBumps final : public GraphSurface {
 public:
  struct Bump {
    Uv centre;
    double height = 1.0;  ///< A
    double width = 1.0;   ///< s
  };
  GaussianBumps(std::vector<Bump> bumps, const UvBox& domain) : GraphSurface(domain), bumps_(std::move(bumps)) {}
  HeightJet height(Uv p) const override;
  HeightThirds height_thirds(Uv p) const override;

 private:
  std::vector<Bump> bumps_;
};

/// (a cos u cos v, b sin u cos v, c sin v), u of period 2 pi, poles at v = -pi/2 and pi/2.
class Ellipsoid final : public Surface {
 public:
  Ellipsoid(double a, double b, double c) : a_(a), b_(b), c_(c) {}
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override;
  std::optional<double> u_period() const override;
  SurfaceJet jet(Uv p) const override;
  SurfaceThirds third(Uv p, const Span& span) const override;
  using Surface::jet;

 private:
  PoleCharts make_poles() const override;
  double a_, b_, c_;
};

/// (c cosh(v/c) cos u, c cosh(v/c) sin u, v), u of period 2 pi: a minimal surface, K = -1 / (c^2 cosh^4(v/c)).
class Catenoid final : public Surface {
 public:
  Catenoid(double c, Interval v_range) : c_(c), v_range_(v_range) {}
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override;
  std::optional<double> u_period() const override;
  SurfaceJet jet(Uv p) const override;
  SurfaceThirds third(Uv p, const Span& span) const override;
  using Surface::jet;

 private:
  double c_;
  Interval v_range_;
};

/// (v cos u, v sin u, c u): a minimal surface, K = -c^2 / (c^2 + v^2)^2. The same metric as the catenoid's with
/// v = c sinh(v_catenoid / c).
class Helicoid final : public Surface {
 public:
  Helicoid(double c, const UvBox& domain) : c_(c), domain_(domain) {}
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return domain_; }
  SurfaceJet jet(Uv p) const override;
  SurfaceThirds third(Uv p, const Span& span) const override;
  using Surface::jet;

 private:
  double c_;
  UvBox domain_;
};

}  // namespace geovor
