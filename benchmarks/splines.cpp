#include "splines.h"

#include <Eigen/LU>
#include <cmath>
#include <random>

namespace geovor::bench {
namespace {

std::vector<double> equidistant(double lo, double hi, int spans) {
  std::vector<double> knots;
  for (int i = 0; i <= spans; ++i) knots.push_back(lo + (hi - lo) * i / spans);
  return knots;
}

std::vector<double> flat(const std::vector<double>& knots, int degree) {
  std::vector<double> t(degree, knots.front());
  t.insert(t.end(), knots.begin(), knots.end());
  t.insert(t.end(), degree, knots.back());
  return t;
}

// Means of neighbouring knots: the coefficients of the identity, and good places to interpolate at.
std::vector<double> greville(const std::vector<double>& knots, int degree) {
  const std::vector<double> t = flat(knots, degree);
  std::vector<double> places;
  for (size_t i = 0; i + degree + 1 < t.size(); ++i) {
    double sum = 0.0;
    for (int k = 1; k <= degree; ++k) sum += t[i + k];
    places.push_back(sum / degree);
  }
  return places;
}

// N_i,p(x), by the definition.
double basis(const std::vector<double>& t, size_t i, int p, double x) {
  if (p == 0) return t[i] <= x && (x < t[i + 1] || (x == t.back() && t[i] < x && t[i + 1] == x)) ? 1.0 : 0.0;
  const double left = t[i + p] > t[i] ? (x - t[i]) / (t[i + p] - t[i]) * basis(t, i, p - 1, x) : 0.0;
  const double right =
      t[i + p + 1] > t[i + 1] ? (t[i + p + 1] - x) / (t[i + p + 1] - t[i + 1]) * basis(t, i + 1, p - 1, x) : 0.0;
  return left + right;
}

template <class Function>
Eigen::VectorXd interpolate(const std::vector<double>& knots, int degree, const Function& f) {
  const std::vector<double> t = flat(knots, degree), places = greville(knots, degree);
  const auto n = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd N(n, n);
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) N(i, j) = basis(t, j, degree, places[i]);
    values(i) = f(places[i]);
  }
  return N.partialPivLu().solve(values);
}

}  // namespace

std::vector<int> clamped_multiplicities(const std::vector<double>& knots, int degree) {
  std::vector<int> multiplicities(knots.size(), 1);
  multiplicities.front() = multiplicities.back() = degree + 1;
  return multiplicities;
}

BSplineSurface Spline::surface() const {
  return {KnotVector(u_knots, clamped_multiplicities(u_knots, p), p),
          KnotVector(v_knots, clamped_multiplicities(v_knots, q), q), poles, weights};
}

Spline wavy_sheet(int p, int q, int spans, bool rational) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.1, 0.1), height(-0.5, 0.5), weight(0.5, 2.0);
  Spline s{p, q, equidistant(0, spans, spans), equidistant(0, spans, spans), {}, {}};
  for (int i = 0; i < s.u_count(); ++i) {
    for (int j = 0; j < s.v_count(); ++j) {
      const double x = i * spans / (s.u_count() - 1.0), y = j * spans / (s.v_count() - 1.0);
      s.poles.push_back({x + jitter(random), y + jitter(random), height(random)});
      if (rational) s.weights.push_back(weight(random));
    }
  }
  return s;
}

Spline cubic_wave(double half, double step) {
  constexpr int kDegree = 3;
  const std::vector<double> knots = equidistant(-half, half, static_cast<int>(std::lround(2.0 * half / step)));
  const std::vector<double> x = greville(knots, kDegree);
  const Eigen::VectorXd sine = interpolate(knots, kDegree, [](double u) { return std::sin(u); });
  const Eigen::VectorXd cosine = interpolate(knots, kDegree, [](double v) { return std::cos(v); });
  Spline s{kDegree, kDegree, knots, knots, {}, {}};
  for (size_t i = 0; i < x.size(); ++i)
    for (size_t j = 0; j < x.size(); ++j) s.poles.push_back({x[i], x[j], sine(i) * cosine(j)});
  return s;
}

}  // namespace geovor::bench
