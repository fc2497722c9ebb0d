#include "geodesic/relax.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "numeric/lobatto.h"

namespace geovor {
namespace {

// Tried one after the other until shooting converges from the result.
constexpr std::array kDegrees{10, 20, 40};

constexpr int kMaxIterations = 60;
constexpr int kMaxHalvings = 12;

// Steps below this part of the length end the iteration: shooting takes over from there.
constexpr double kSettled = 1e-7;

// Shooting that ends with a length farther from the relaxed one than this has found another geodesic.
constexpr double kSamePath = 0.02;

struct Rule {
  LobattoRule lobatto;
  Eigen::MatrixXd stiffness;  // D^T W D: the energy of node positions r is 1/2 r^T stiffness r
  explicit Rule(int degree) : lobatto(lobatto_rule(degree)) {
    stiffness = lobatto.derivative.transpose() * lobatto.weights.asDiagonal() * lobatto.derivative;
  }
};

const Rule& rule_of(int degree) {
  static const std::array<Rule, kDegrees.size()> rules{Rule(kDegrees[0]), Rule(kDegrees[1]), Rule(kDegrees[2])};
  for (const Rule& rule : rules)
    if (rule.lobatto.nodes.size() == degree + 1) return rule;
  return rules.back();
}

using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3>;

double energy(const Rule& rule, const Positions& r) { return 0.5 * r.cwiseProduct(rule.stiffness * r).sum(); }

// The energy as a function of the interior nodes: value, gradient and Hessian at a path.
struct Model {
  const Rule& rule;
  std::vector<SurfaceJet> jets;
  Positions r;
  double value = 0.0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd gauss_newton;  // J^T stiffness J: positive definite
  Eigen::MatrixXd curvature;     // what the second derivatives of the surface add, block-diagonal

  Model(const Surface& surface, const Rule& path_rule, const std::vector<Uv>& nodes);
  Eigen::VectorXd newton_step() const;
  double length_of(const Eigen::VectorXd& step) const;
};

Model::Model(const Surface& surface, const Rule& path_rule, const std::vector<Uv>& nodes)
    : rule(path_rule), r(nodes.size(), 3) {
  const int count = static_cast<int>(nodes.size()), inner = count - 2;
  for (int i = 0; i < count; ++i) {
    jets.push_back(surface.jet(nodes[i]));
    r.row(i) = jets.back().S.transpose();
  }
  const Positions force = rule.stiffness * r;
  value = 0.5 * r.cwiseProduct(force).sum();
  gradient.resize(2 * inner);
  gauss_newton.resize(2 * inner, 2 * inner);
  curvature.setZero(2 * inner, 2 * inner);
  for (int i = 0; i < inner; ++i) {
    const SurfaceJet& a = jets[i + 1];
    const Xyz f = force.row(i + 1).transpose();
    gradient.segment<2>(2 * i) << a.Su.dot(f), a.Sv.dot(f);
    curvature.block<2, 2>(2 * i, 2 * i) << a.Suu.dot(f), a.Suv.dot(f), a.Suv.dot(f), a.Svv.dot(f);
    for (int j = 0; j < inner; ++j) {
      const SurfaceJet& b = jets[j + 1];
      gauss_newton.block<2, 2>(2 * i, 2 * j) << a.Su.dot(b.Su), a.Su.dot(b.Sv), a.Sv.dot(b.Su), a.Sv.dot(b.Sv);
      gauss_newton.block<2, 2>(2 * i, 2 * j) *= rule.stiffness(i + 1, j + 1);
    }
  }
}

// Newton where the Hessian is positive definite, else with the surface's part of it left out.
Eigen::VectorXd Model::newton_step() const {
  const Eigen::LLT<Eigen::MatrixXd> full(gauss_newton + curvature);
  if (full.info() == Eigen::Success) return -full.solve(gradient);
  return -gauss_newton.ldlt().solve(gradient);
}

// The largest move of a node, in space.
double Model::length_of(const Eigen::VectorXd& step) const {
  double longest = 0.0;
  for (int i = 0; i < step.size() / 2; ++i) {
    const double move = push_forward(jets[i + 1], {step[2 * i], step[2 * i + 1]}).norm();
    longest = move <= longest ? longest : move;  // NaN stays
  }
  return longest;
}

std::vector<Uv> moved(std::vector<Uv> nodes, const Eigen::VectorXd& step, double k) {
  for (int i = 0; i < step.size() / 2; ++i) nodes[i + 1] = nodes[i + 1] + k * UvVec{step[2 * i], step[2 * i + 1]};
  return nodes;
}

Positions positions(const Surface& surface, const std::vector<Uv>& nodes) {
  Positions r(nodes.size(), 3);
  for (std::size_t i = 0; i < nodes.size(); ++i) r.row(i) = surface.position(nodes[i]).transpose();
  return r;
}

Polar start_of(const Rule& rule, const Model& model, const Ends& ends) {
  const Xyz velocity = (rule.lobatto.derivative.row(0) * model.r).transpose();
  return {std::sqrt(2.0 * model.value), ends.start.angle_of(velocity)};
}

std::vector<Uv> refined(const std::vector<Uv>& nodes, const LobattoRule& coarse, const LobattoRule& fine) {
  std::vector<Uv> result;
  for (const double x : fine.nodes) {
    const Eigen::RowVectorXd row = coarse.interpolation(x);
    Uv p{0.0, 0.0};
    for (std::size_t j = 0; j < nodes.size(); ++j) p = p + UvVec{row[j] * nodes[j].u, row[j] * nodes[j].v};
    result.push_back(p);
  }
  result.front() = nodes.front();
  result.back() = nodes.back();
  return result;
}

}  // namespace

RelaxedPath relax(const Surface& surface, const Ends& ends, std::vector<Uv> nodes) {
  const Rule& rule = rule_of(static_cast<int>(nodes.size()) - 1);
  RelaxedPath path;
  for (int i = 0; i < kMaxIterations && !path.converged; ++i) {
    const Model model(surface, rule, nodes);
    path.evaluations += static_cast<int>(nodes.size());
    path.start = start_of(rule, model, ends);
    const Eigen::VectorXd step = model.newton_step();
    double k = 1.0;
    bool lower = false;
    for (int halving = 0; halving < kMaxHalvings && !lower; ++halving, k *= 0.5) {
      const std::vector<Uv> trial = moved(nodes, step, k);
      path.evaluations += static_cast<int>(nodes.size());
      lower = energy(rule, positions(surface, trial)) <= model.value;
      if (lower) nodes = trial;
    }
    path.converged = model.length_of(step) <= kSettled * path.start.s;
    if (!lower) break;
  }
  path.nodes = std::move(nodes);
  return path;
}

std::vector<Uv> at_lobatto_nodes(const Surface& surface, const std::vector<Uv>& polyline, int degree) {
  std::vector<double> reach{0.0};
  Xyz last = surface.position(polyline.front());
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    const Xyz next = surface.position(polyline[i]);
    reach.push_back(reach.back() + (next - last).norm());
    last = next;
  }
  std::vector<Uv> nodes;
  std::size_t piece = 1;
  for (const double t : rule_of(degree).lobatto.nodes) {
    const double s = t * reach.back();
    while (piece + 1 < reach.size() && reach[piece] < s) ++piece;
    const double length = reach[piece] - reach[piece - 1];
    const double k = length > 0.0 ? (s - reach[piece - 1]) / length : 0.0;
    nodes.push_back(lerp(polyline[piece - 1], polyline[piece], k));
  }
  nodes.front() = polyline.front();
  nodes.back() = polyline.back();
  return nodes;
}

Connection connect_along(const Surface& surface, const Ends& ends, const std::vector<Uv>& polyline,
                         const ConnectOptions& options) {
  std::vector<Uv> nodes = at_lobatto_nodes(surface, polyline, kDegrees.front());
  Connection c;
  int evaluations = static_cast<int>(polyline.size());
  for (std::size_t level = 0; level < kDegrees.size(); ++level) {
    const RelaxedPath path = relax(surface, ends, nodes);
    evaluations += path.evaluations;
    c = shoot(surface, ends, path.start, options);
    c.evaluations = evaluations += c.evaluations;
    const bool same_path = std::abs(c.length - path.start.s) <= kSamePath * c.length;
    if (c.status == ConnectStatus::Converged && same_path) break;
    if (level + 1 == kDegrees.size()) break;
    nodes = refined(path.nodes, rule_of(kDegrees[level]).lobatto, rule_of(kDegrees[level + 1]).lobatto);
  }
  return c;
}

}  // namespace geovor
