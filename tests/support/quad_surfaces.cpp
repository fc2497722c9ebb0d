#include "support/quad_surfaces.h"

namespace geovor::testing {
namespace {

QuadJet graph(const Float128& u, const Float128& v, const std::array<Float128, 6>& f) {
  return {{u, v, f[0]}, {1, 0, f[1]}, {0, 1, f[2]}, {0, 0, f[3]}, {0, 0, f[4]}, {0, 0, f[5]}};
}

using Polynomial = std::vector<Float128>;

// p times (a + b x).
Polynomial times_linear(const Polynomial& p, const Float128& a, const Float128& b) {
  Polynomial out(p.size() + 1, Float128(0));
  for (std::size_t i = 0; i < p.size(); ++i) out[i] += a * p[i], out[i + 1] += b * p[i];
  return out;
}

void add(Polynomial& to, const Polynomial& p) {
  if (to.size() < p.size()) to.resize(p.size(), Float128(0));
  for (std::size_t i = 0; i < p.size(); ++i) to[i] += p[i];
}

// The functions N_{span-degree} … N_{span} of full degree on the span, in powers of x - middle.
std::vector<Polynomial> basis_polynomials(const std::vector<double>& t, int span, int degree, const Float128& middle) {
  std::vector<Polynomial> N(2 * degree + 2, Polynomial{});  // N[k] is N_{span - degree + k}
  N[degree] = {Float128(1)};
  for (int q = 1; q <= degree; ++q) {
    for (int k = 0; k <= degree; ++k) {
      const int i = span - degree + k;
      Polynomial sum;
      const auto term = [&](const Polynomial& p, int lo, int hi, int from, int sign) {
        if (p.empty() || !(t[hi] > t[lo])) return;
        const Float128 width = Float128(t[hi]) - Float128(t[lo]);
        add(sum, times_linear(p, sign * (middle - Float128(t[from])) / width, sign / width));
      };
      if (i >= 0) term(N[k], i, i + q, i, 1);
      if (i + q + 1 < static_cast<int>(t.size())) term(N[k + 1], i + 1, i + q + 1, i + q + 1, -1);
      N[k] = sum;
    }
  }
  N.resize(degree + 1);
  for (Polynomial& p : N) p.resize(degree + 1, Float128(0));
  return N;
}

// 1, x, x^2, … with first and second derivatives.
std::array<Polynomial, 3> powers(const Float128& x, int degree) {
  std::array<Polynomial, 3> p;
  for (Polynomial& row : p) row.assign(degree + 1, Float128(0));
  p[0][0] = 1;
  for (int i = 1; i <= degree; ++i) {
    p[0][i] = p[0][i - 1] * x;
    p[1][i] = i * p[0][i - 1];
    p[2][i] = i * p[1][i - 1];
  }
  return p;
}

using Homogeneous = std::array<Float128, 4>;

QuadVec space(const Homogeneous& h) { return {h[0], h[1], h[2]}; }

}  // namespace

QuadJet QuadWave::jet(const Float128& u, const Float128& v, std::array<int, 2>) const {
  const Float128 su = sin(u), cu = cos(u), sv = sin(v), cv = cos(v);
  return graph(u, v, {su * cv, cu * cv, -su * sv, -su * cv, -cu * sv, -su * cv});
}

QuadJet QuadParaboloid::jet(const Float128& u, const Float128& v, std::array<int, 2>) const {
  return graph(u, v, {u * u + v * v, 2 * u, 2 * v, 2, 0, 2});
}

QuadJet QuadCylinder::jet(const Float128& u, const Float128& v, std::array<int, 2>) const {
  const Float128 c = cos(u), s = sin(u);
  return {{c, s, v}, {-s, c, 0}, {0, 0, 1}, {-c, -s, 0}, {0, 0, 0}, {0, 0, 0}};
}

QuadJet QuadEllipsoid::jet(const Float128& u, const Float128& v, std::array<int, 2>) const {
  const Float128 x = a_ * cos(u), y = b_ * sin(u), xu = -a_ * sin(u), yu = b_ * cos(u), C = cos(v), S = sin(v);
  return {{x * C, y * C, c_ * S}, {xu * C, yu * C, 0},   {-x * S, -y * S, c_ * C},
          {-x * C, -y * C, 0},    {-xu * S, -yu * S, 0}, {-x * C, -y * C, -c_ * S}};
}

QuadJet QuadTorus::jet(const Float128& u, const Float128& v, std::array<int, 2>) const {
  const Float128 c = cos(u), s = sin(u), h = r_ * sin(v), k = r_ * cos(v), w = R_ + k;
  return {{w * c, w * s, h},   {-w * s, w * c, 0}, {-h * c, -h * s, k},
          {-w * c, -w * s, 0}, {h * s, -h * c, 0}, {-k * c, -k * s, -h}};
}

QuadJet QuadBump::jet(const Float128& u, const Float128& v, std::array<int, 2>) const {
  const Float128 w = 1 / (s_ * s_), f = A_ * exp(-(u * u + v * v) * w / 2);
  return graph(u, v, {f, -u * w * f, -v * w * f, (u * u * w - 1) * w * f, u * v * w * w * f, (v * v * w - 1) * w * f});
}

QuadSpline::Axis QuadSpline::make_axis(const std::vector<double>& knots, int degree) {
  Axis axis{degree, {}, {}, {}};
  for (int i = degree; i + degree + 1 < static_cast<int>(knots.size()); ++i) {
    if (!(knots[i + 1] > knots[i])) continue;
    axis.spans.push_back(i);
    axis.middles.push_back((Float128(knots[i]) + Float128(knots[i + 1])) / 2);
    axis.basis.push_back(basis_polynomials(knots, i, degree, axis.middles.back()));
  }
  return axis;
}

QuadSpline::QuadSpline(const SplineData& data)
    : axes_{make_axis(data.u_knots, data.u_degree), make_axis(data.v_knots, data.v_degree)},
      rational_(!data.weights.empty()) {
  const auto& [U, V] = axes_;
  for (std::size_t i = 1; i < U.spans.size(); ++i) lines_[0].push_back(data.u_knots[U.spans[i]]);
  for (std::size_t j = 1; j < V.spans.size(); ++j) lines_[1].push_back(data.v_knots[V.spans[j]]);
  for (std::size_t i = 0; i < U.spans.size(); ++i) {
    for (std::size_t j = 0; j < V.spans.size(); ++j) {
      std::vector<Homogeneous> patch((U.degree + 1) * (V.degree + 1), Homogeneous{0, 0, 0, 0});
      for (int k = 0; k <= U.degree; ++k) {
        for (int l = 0; l <= V.degree; ++l) {
          const int pole = (U.spans[i] - U.degree + k) * data.v_count() + V.spans[j] - V.degree + l;
          const Float128 w = rational_ ? data.weights[pole] : 1.0;
          const Xyz& P = data.poles[pole];
          const Homogeneous h{w * P.x(), w * P.y(), w * P.z(), w};
          for (int a = 0; a <= U.degree; ++a)
            for (int b = 0; b <= V.degree; ++b)
              for (int c = 0; c < 4; ++c)
                patch[a * (V.degree + 1) + b][c] += U.basis[i][k][a] * V.basis[j][l][b] * h[c];
        }
      }
      patches_.push_back(std::move(patch));
    }
  }
}

QuadJet QuadSpline::jet(const Float128& u, const Float128& v, std::array<int, 2> piece) const {
  const auto& [U, V] = axes_;
  const auto pu = powers(u - U.middles[piece[0]], U.degree), pv = powers(v - V.middles[piece[1]], V.degree);
  const auto& patch = patches_[piece[0] * V.spans.size() + piece[1]];
  const int coordinates = rational_ ? 4 : 3;
  // h[m][n]: the homogeneous point differentiated m times in u and n times in v.
  Homogeneous h[3][3] = {};
  for (int a = 0; a <= U.degree; ++a) {
    for (int n = 0; n < 3; ++n) {
      Homogeneous row{0, 0, 0, 0};
      for (int b = n; b <= V.degree; ++b)
        for (int c = 0; c < coordinates; ++c) row[c] += patch[a * (V.degree + 1) + b][c] * pv[n][b];
      for (int m = 0; m + n < 3 && m <= a; ++m)
        for (int c = 0; c < coordinates; ++c) h[m][n][c] += pu[m][a] * row[c];
    }
  }
  if (!rational_)
    return {space(h[0][0]), space(h[1][0]), space(h[0][1]), space(h[2][0]), space(h[1][1]), space(h[0][2])};
  const Float128 w = 1 / h[0][0][3];
  QuadJet j;
  j.S = w * space(h[0][0]);
  j.Su = w * (space(h[1][0]) - h[1][0][3] * j.S);
  j.Sv = w * (space(h[0][1]) - h[0][1][3] * j.S);
  j.Suu = w * (space(h[2][0]) - 2 * h[1][0][3] * j.Su - h[2][0][3] * j.S);
  j.Suv = w * (space(h[1][1]) - h[1][0][3] * j.Sv - h[0][1][3] * j.Su - h[1][1][3] * j.S);
  j.Svv = w * (space(h[0][2]) - 2 * h[0][1][3] * j.Sv - h[0][2][3] * j.S);
  return j;
}

}  // namespace geovor::testing
