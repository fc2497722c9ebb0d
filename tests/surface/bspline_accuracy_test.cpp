// How many digits the jets of B-spline surfaces have, held against the Cox-de Boor recurrence in extended precision;
// and that every processor gives the same ones.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>

#include "support/splines.h"
#include "surface/bspline_kernels.h"

namespace geovor {
namespace {

using testing::random_spline;
using testing::SplineData;
using testing::uniform;

using Real = long double;
using Point = std::array<Real, 4>;

constexpr int kDegrees[][2] = {{1, 1}, {1, 3}, {2, 2}, {3, 2}, {3, 3},  {4, 4},   {5, 5},
                               {3, 5}, {6, 6}, {7, 7}, {4, 9}, {12, 1}, {14, 14}, {25, 25}};

// The k-th derivatives of the polynomials that N_i,p is on the span [t_s, t_s+1], i = s - p … s, by the definition.
std::vector<Real> basis(const std::vector<double>& t, int s, int p, int k, Real x) {
  std::vector<Real> N{1};  // of degree q: i = s - q … s
  for (int q = 1; q <= p; ++q) {
    std::vector<Real> up(q + 1, 0);
    for (int r = 0; r < q; ++r) {  // what N_i,q-1, i = s - q + 1 + r, gives to its two parents
      const int i = s - q + 1 + r;
      const Real width = Real(t[i + q]) - t[i];
      const bool derive = q > p - k;
      up[r] += N[r] * (derive ? Real(-q) : Real(t[i + q]) - x) / width;
      up[r + 1] += N[r] * (derive ? Real(q) : x - t[i]) / width;
    }
    N = up;
  }
  return k > p ? std::vector<Real>(p + 1, 0) : N;
}

struct Truth {
  std::array<std::array<Real, 3>, 6> jet;  // S, Su, Sv, Suu, Suv, Svv
  std::array<Real, 6> scale;               // sizes of what is summed up
};

constexpr int kOfU[6] = {0, 1, 0, 2, 1, 0}, kOfV[6] = {0, 0, 1, 0, 1, 2};

Truth truth(const SplineData& d, const Span& span, Uv x) {
  std::array<Point, 6> A{};
  Truth result{};
  Real weight_terms = 0;
  for (int o = 0; o < 6; ++o) {
    const auto Nu = basis(d.u_knots, span.u, d.u_degree, kOfU[o], x.u);
    const auto Nv = basis(d.v_knots, span.v, d.v_degree, kOfV[o], x.v);
    for (int a = 0; a <= d.u_degree; ++a) {
      for (int b = 0; b <= d.v_degree; ++b) {
        const size_t at = static_cast<size_t>(span.u - d.u_degree + a) * d.v_count() + span.v - d.v_degree + b;
        const Real w = d.weights.empty() ? 1.0 : d.weights[at], N = Nu[a] * Nv[b] * w;
        for (int c = 0; c < 3; ++c) A[o][c] += N * d.poles[at][c];
        A[o][3] += N;
        if (o == 0) weight_terms += std::abs(N);
        result.scale[o] += std::abs(N) * (1 + d.poles[at].norm());
      }
    }
  }
  // S w = A, differentiated.
  const Real w = A[0][3];
  auto& [S, Su, Sv, Suu, Suv, Svv] = result.jet;
  for (int c = 0; c < 3; ++c) {
    S[c] = A[0][c] / w;
    Su[c] = (A[1][c] - A[1][3] * S[c]) / w;
    Sv[c] = (A[2][c] - A[2][3] * S[c]) / w;
    Suu[c] = (A[3][c] - 2 * A[1][3] * Su[c] - A[3][3] * S[c]) / w;
    Suv[c] = (A[4][c] - A[1][3] * Sv[c] - A[2][3] * Su[c] - A[4][3] * S[c]) / w;
    Svv[c] = (A[5][c] - 2 * A[2][3] * Sv[c] - A[5][3] * S[c]) / w;
  }
  if (d.weights.empty()) return result;
  auto& k = result.scale;
  // Outside the span the weights' sum has negative terms: w itself has lost digits, and every derivative divides by it.
  for (Real& k_o : k) k_o *= weight_terms * weight_terms / (w * w * std::abs(w));
  k[3] += 2 * k[1] * k[1];
  k[4] += 2 * k[1] * k[2];
  k[5] += 2 * k[2] * k[2];
  return result;
}

// Worst error over 200 points of random spans; `place` picks a parameter for a span of a unit interval's length.
template <class Place>
Real worst_error(const SplineData& d, Place place) {
  const BSplineSurface s = d.surface();
  std::mt19937 random(17);
  Real worst = 0;
  for (int i = 0; i < 200; ++i) {
    const Span span = s.span(testing::random_point(random, s.domain()), {1, 1});
    auto in = [&](const std::vector<double>& t, int at) { return t[at] + place(random) * (t[at + 1] - t[at]); };
    const Uv x{in(d.u_knots, span.u), in(d.v_knots, span.v)};
    const SurfaceJet j = s.jet(x, span);
    const Truth true_jet = truth(d, span, x);
    const Xyz* vectors[6] = {&j.S, &j.Su, &j.Sv, &j.Suu, &j.Suv, &j.Svv};
    for (int o = 0; o < 6; ++o)
      for (int c = 0; c < 3; ++c) {
        if (true_jet.scale[o] == 0) {
          EXPECT_EQ((*vectors[o])[c], 0.0);
          continue;
        }
        const Real error = std::abs((*vectors[o])[c] - true_jet.jet[o][c]) / true_jet.scale[o];
        if (!(error <= worst)) worst = error;  // NaN as well
      }
  }
  return worst;
}

// Relative to the sum of the absolute terms, which is what rounding the poles to double costs already. It grows with
// the number of roundings in a row, about the degree.
Real bound(int p, int q) { return (8 + 2 * std::max(p, q)) * std::numeric_limits<double>::epsilon(); }

template <class Place>
void expect_accurate(Place place) {
  for (const auto& [p, q] : kDegrees)
    for (bool rational : {false, true})
      EXPECT_LE(worst_error(random_spline(p, q, 4, rational, 100 + p), place), bound(p, q))
          << p << " x " << q << " rational " << rational;
}

TEST(BSplineAccuracy, JetsAreExactToRoundingInsideTheirSpan) {
  expect_accurate([](std::mt19937& random) { return uniform(random, 0.0, 1.0); });
}

TEST(BSplineAccuracy, JetsAreExactToRoundingOnKnotsFromBothSides) {
  expect_accurate([](std::mt19937& random) { return static_cast<double>(random() % 2); });
}

TEST(BSplineAccuracy, JetsAreExactToRoundingATenthOfASpanOutside) {
  expect_accurate([](std::mt19937& random) { return random() % 2 ? 1.1 : -0.1; });
}

// A span a thousand times shorter than its neighbours must not cost three digits of the first derivative.
TEST(BSplineAccuracy, JetsAreExactToRoundingOnVeryUnevenKnots) {
  for (int p : {2, 3, 5, 8}) {
    SplineData d = random_spline(p, 3, 5, false, 60 + p);
    d.u_knots[p + 2] = d.u_knots[p + 1] + 1e-3;
    d.u_knots[p + 3] = d.u_knots[p + 2] + 1e-6;
    EXPECT_LE(worst_error(d, [](std::mt19937& random) { return uniform(random, 0.0, 1.0); }), bound(p, 3)) << p;
  }
}

TEST(BSplineAccuracy, EveryProcessorGivesTheSameBits) {
  for (const auto& [p, q] : kDegrees) {
    for (bool rational : {false, true}) {
      const SplineData d = random_spline(p, q, 3, rational, 7);
      BSplineNet net{SpanBasis(KnotVector::from_flat(d.u_knots, p)),
                     SpanBasis(KnotVector::from_flat(d.v_knots, q)),
                     rational,
                     {1, 2, 3},
                     {},
                     d.v_count()};
      for (size_t i = 0; i < d.poles.size(); ++i)
        net.poles.push_back({{d.poles[i].x(), d.poles[i].y(), d.poles[i].z(), rational ? d.weights[i] : 1.0}});
      const BSplineKernels a = portable_kernels(p, q), b = fastest_kernels(p, q);
      std::mt19937 random(1);
      for (int i = 0; i < 100; ++i) {
        const double u = uniform(random, -1, 4), v = uniform(random, -1, 4);
        SurfaceJet of_a, of_b;
        a.jet(net, p + 1, q + 2, u, v, of_a);
        b.jet(net, p + 1, q + 2, u, v, of_b);
        EXPECT_EQ(std::memcmp(&of_a, &of_b, sizeof of_a), 0);
        Xyz at_a, at_b;
        a.position(net, p + 1, q + 2, u, v, at_a);
        b.position(net, p + 1, q + 2, u, v, at_b);
        EXPECT_EQ(std::memcmp(&at_a, &at_b, sizeof at_a), 0);
      }
    }
  }
}

}  // namespace
}  // namespace geovor
