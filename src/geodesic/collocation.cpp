#include "geodesic/collocation.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "geodesic/piece.h"
#include "numeric/lobatto.h"

namespace geovor {
namespace {

// A path x(k), k in [0, 1], at Lobatto nodes. With V = dr/dk, A = d2r/dk2, T and B = n x T unit vectors along and
// across the path, the displacement w = a T + b B that makes the path a geodesic of constant speed L is, to first
// order, the solution of a'' = -A.T, b'' + L^2 K b = -A.B that vanishes at both ends; Newton's iteration, with scalar
// equations.

constexpr std::array kDegrees{8, 12, 16, 20, 24};
constexpr int kMostNodes = kDegrees.back() + 1;
constexpr int kMostIterations = 12;

// The scalar equation is solved by iterating with the inverse of d2/dk2, which contracts by L^2 |K| / pi^2.
constexpr double kLargestCurvature = 2.5;

// A move below the tolerance, in parts of the length, leaves nothing (its square) for the path itself. Directions and y
// are those before the move; they change with it by the square of the length in curvature radii. Rounding moves nodes
// by less than the finest. A polynomial of low degree has told what it can where moves are below the last.
constexpr double kFinest = 1e-14;
constexpr double kRoughlySettled = 1e-3;

// Matrices hold whole blocks of rows, the last filled up with zeros.
constexpr int kBlock = 4;
constexpr int whole_blocks(int rows) { return (rows + kBlock - 1) / kBlock * kBlock; }
constexpr int kMostRows = whole_blocks(kMostNodes);

using Block = Eigen::Array<double, kBlock, 1>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostRows, 1>;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRows, kMostNodes>;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, kMostNodes, 2>;

Matrix filled_up(const Eigen::MatrixXd& rows) {
  Matrix all = Matrix::Zero(whole_blocks(static_cast<int>(rows.rows())), rows.cols());
  all.topRows(rows.rows()) = rows;
  return all;
}

struct Rule {
  LobattoRule lobatto;
  Matrix first, second;  // derivatives at the inner nodes
  Matrix inverse;        // of the second derivative of what vanishes at the ends
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kMostNodes> tail;  // the last two Legendre coefficients

  explicit Rule(int degree) : lobatto(lobatto_rule(degree)) {
    const int inner = degree - 1;
    const Eigen::MatrixXd& D = lobatto.derivative;
    const Eigen::MatrixXd D2 = D * D;
    first = filled_up(D.middleRows(1, inner));
    second = filled_up(D2.middleRows(1, inner));
    inverse = filled_up(D2.block(1, 1, inner, inner).inverse());
    tail.resize(2, degree + 1);
    for (int i = 0; i <= degree; ++i)
      for (int last = 0; last < 2; ++last)
        tail(last, i) =
            (2 * (degree - last) + 1) * lobatto.weights[i] * std::legendre(degree - last, 2.0 * lobatto.nodes[i] - 1.0);
  }
  int inner() const { return static_cast<int>(inverse.cols()); }
};

const Rule& rule(std::size_t level) {
  static const std::array<Rule, kDegrees.size()> rules{Rule(kDegrees[0]), Rule(kDegrees[1]), Rule(kDegrees[2]),
                                                       Rule(kDegrees[3]), Rule(kDegrees[4])};
  return rules[level];
}

// The product's first rows. The matrices are too small for a library's kernels: a block of rows at a time, its sums in
// registers.
template <class V>
Vector product(const Matrix& matrix, const V& vector, int rows) {
  Vector result(matrix.rows());
  for (int row = 0; row < matrix.rows(); row += kBlock) {
    Block sum = Block::Zero();
    for (int i = 0; i < matrix.cols(); ++i) sum += vector[i] * Eigen::Map<const Block>(&matrix(row, i));
    Eigen::Map<Block> at(&result[row]);
    at = sum;
  }
  result.conservativeResize(rows);
  return result;
}

// Values at the nodes of one degree -> values at those of a higher one.
const Matrix& transfer(std::size_t from, std::size_t to) {
  using Row = std::array<Matrix, kDegrees.size()>;
  static const std::array<Row, kDegrees.size()> all = [] {
    std::array<Row, kDegrees.size()> made;
    for (std::size_t i = 0; i < kDegrees.size(); ++i)
      for (std::size_t j = i + 1; j < kDegrees.size(); ++j) {
        Eigen::MatrixXd rows(kDegrees[j] + 1, kDegrees[i] + 1);
        for (int row = 0; row <= kDegrees[j]; ++row)
          rows.row(row) = rule(i).lobatto.interpolation(rule(j).lobatto.nodes[row]);
        made[i][j] = filled_up(rows);
      }
    return made;
  }();
  return all[from][to];
}

class Collocation {
 public:
  Collocation(const Surface& surface, const Ends& ends, double tolerance);

  std::optional<Connection> solve();

 private:
  void start_on(std::size_t level);
  void refine(std::size_t level);
  bool inside() const;
  bool newton_step();
  Vector with_curvature(const Vector& start, double accuracy) const;
  double tail() const;
  std::size_t level_wanted() const;
  std::optional<Connection> result() const;

  const Surface& surface_;
  const Ends& ends_;
  Piece piece_;
  double tolerance_;
  std::size_t level_ = 0;
  const Rule* rule_ = nullptr;
  Columns x_;
  // At the inner nodes, of the path before its last step:
  std::array<Xyz, kMostNodes> bend_;  // the part of A along the normal
  Vector curvature_;                  // L^2 K
  double length_ = 0.0;
  double move_ = 0.0;  // the largest displacement of the last step, in parts of the length
  int evaluations_ = 0;
};

// The cubic through the ends with the directions that the chord suggests; the straight line where it suggests none.
Collocation::Collocation(const Surface& surface, const Ends& ends, double tolerance)
    : surface_(surface),
      ends_(ends),
      piece_(surface, ends.from, ends.to - ends.from, false),
      tolerance_(std::max(tolerance, kFinest)) {
  start_on(0);
  const UvVec way = ends.to - ends.from;
  UvVec first = way, last = way;
  if (const auto guess = guess_from_chord(ends)) {
    first = tangent_components(ends.at_from, guess->first);
    last = tangent_components(ends.at_to, guess->last);
  }
  const UvVec bend0 = first - way, bend1 = last - way;
  for (int i = 0; i < x_.rows(); ++i) {
    const double k = rule_->lobatto.nodes[i], l = 1.0 - k;
    const Uv p = lerp(ends.from, ends.to, k) + k * l * (l * bend0 - k * bend1);
    x_.row(i) << p.u, p.v;
  }
}

void Collocation::start_on(std::size_t level) {
  level_ = level;
  rule_ = &rule(level);
  x_.resize(kDegrees[level] + 1, 2);
  curvature_.resize(rule_->inner());
}

void Collocation::refine(std::size_t level) {
  const Columns coarse = x_;
  const Matrix& rows = transfer(level_, level);
  start_on(level);
  for (int axis = 0; axis < 2; ++axis) x_.col(axis) = product(rows, coarse.col(axis), kDegrees[level] + 1);
  x_.row(0) = coarse.row(0);
  x_.row(x_.rows() - 1) = coarse.row(coarse.rows() - 1);
}

// Between nodes the path bulges a little more than at them.
bool Collocation::inside() const {
  constexpr double kBulge = 0.02;
  const UvBox domain = surface_.domain();
  for (int axis = 0; axis < 2; ++axis) {
    const bool periodic = (axis == 0 ? surface_.u_period() : surface_.v_period()).has_value();
    const Interval box = axis == 0 ? domain.u : domain.v, piece = piece_.range(axis);
    const double lo = std::max(piece.lo, periodic ? piece.lo : box.lo);
    const double hi = std::min(piece.hi, periodic ? piece.hi : box.hi);
    const auto inner = x_.col(axis).segment(1, rule_->inner());
    const double least = inner.minCoeff(), most = inner.maxCoeff(), bulge = kBulge * (most - least);
    const double first = x_(0, axis), last = x_(x_.rows() - 1, axis);
    if (!(least - bulge >= lo && most + bulge <= hi && std::min(first, last) >= lo && std::max(first, last) <= hi))
      return false;
  }
  return true;
}

// b with b'' + L^2 K b = f, from its value without curvature.
Vector Collocation::with_curvature(const Vector& start, double accuracy) const {
  constexpr int kMost = 40;
  Vector b = start, term = start;
  const double scale = start.cwiseAbs().maxCoeff();
  for (int i = 0; i < kMost && term.cwiseAbs().maxCoeff() > accuracy * scale; ++i) {
    term = -product(rule_->inverse, Vector(curvature_.cwiseProduct(term)), rule_->inner());
    b += term;
  }
  return b;
}

// The parameters of a vector along T are (u', v') / |V|, those of one along B (-(F u' + G v'), E u' + F v') / (W |V|).
bool Collocation::newton_step() {
  constexpr double kOfStep = 1e-6;  // the next step mends the rest
  const int inner = rule_->inner();
  const Vector du = product(rule_->first, x_.col(0), inner), dv = product(rule_->first, x_.col(1), inner);
  const Vector ddu = product(rule_->second, x_.col(0), inner), ddv = product(rule_->second, x_.col(1), inner);
  Vector along(inner), across(inner), speed(inner), per_across(inner);
  Columns b(inner, 2);
  for (int i = 0; i < inner; ++i) {
    const SurfaceJet j = piece_.jet(surface_, {x_(i + 1, 0), x_(i + 1, 1)});
    const double u = du[i], v = dv[i];
    const Xyz V = u * j.Su + v * j.Sv, m = j.Su.cross(j.Sv);
    const Xyz A = u * u * j.Suu + 2.0 * u * v * j.Suv + v * v * j.Svv + ddu[i] * j.Su + ddv[i] * j.Sv;
    const double V2 = V.squaredNorm(), per_W2 = 1.0 / m.squaredNorm(), M = j.Suv.dot(m);
    speed[i] = std::sqrt(V2);
    per_across[i] = std::sqrt(per_W2) / speed[i];
    curvature_[i] = V2 * (j.Suu.dot(m) * j.Svv.dot(m) - M * M) * per_W2 * per_W2;
    bend_[i] = (A.dot(m) * per_W2) * m;
    along[i] = -A.dot(V) / speed[i];
    across[i] = -A.dot(m.cross(V)) * per_across[i];
    b.row(i) << -j.Sv.dot(V), j.Su.dot(V);
  }
  evaluations_ += inner;
  length_ = rule_->lobatto.weights.segment(1, inner).dot(speed);  // but for the ends' small weights
  if (!(curvature_.cwiseAbs().maxCoeff() < kLargestCurvature)) return false;
  const Vector s = product(rule_->inverse, along, inner),
               c = with_curvature(product(rule_->inverse, across, inner), kOfStep);
  for (int i = 0; i < inner; ++i) {
    const double k = s[i] / speed[i], l = c[i] * per_across[i];
    x_(i + 1, 0) += k * du[i] + l * b(i, 0);
    x_(i + 1, 1) += k * dv[i] + l * b(i, 1);
  }
  move_ = std::max(s.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()) / length_;
  return std::isfinite(move_) && inside();
}

// Of the path, in parts of its length.
double Collocation::tail() const {
  const Eigen::Matrix2d last = rule_->tail * x_;
  double most = 0.0;
  for (const SurfaceJet* j : {&ends_.at_from, &ends_.at_to})
    for (int i = 0; i < 2; ++i) most = std::max(most, (last(i, 0) * j->Su + last(i, 1) * j->Sv).norm());
  return most / length_;
}

// The coefficients fall geometrically.
std::size_t Collocation::level_wanted() const {
  const double degree = kDegrees[level_] * std::log(tolerance_) / std::log(std::min(tail(), 0.5));
  std::size_t level = level_;
  while (level < kDegrees.size() && kDegrees[level] < degree) ++level;
  return level;
}

std::optional<Connection> Collocation::solve() {
  const double bend = std::min(1.0, (ends_.at_to.S - ends_.at_from.S).norm() * ends_.curvature);
  const double settled = tolerance_ / std::max(bend * bend, kRoughlySettled);
  double before = 0.5;
  for (int i = 0; i < kMostIterations; ++i) {
    if (!newton_step() || !(move_ < before)) return std::nullopt;
    before = std::max(0.5 * move_, settled);
    if (move_ > kRoughlySettled) continue;
    const std::size_t wanted = level_wanted();
    if (wanted == kDegrees.size()) return std::nullopt;
    if (wanted > level_) {
      refine(wanted);
      before = 0.5;
    } else if (move_ <= settled) {
      return result();
    }
  }
  return std::nullopt;
}

// The chord is the sum of its parts: c = V(0) + int (1 - k) A dk = V(1) - int k A dk. With the tangential part of A
// gone and that along the end's normal projected away, what is left loses no digits, as differentiating the path would.
std::optional<Connection> Collocation::result() const {
  const Xyz chord = ends_.at_to.S - ends_.at_from.S;
  constexpr double kRounding = 1e-16;
  const Vector line = rule_->lobatto.nodes.segment(1, rule_->inner());
  const Vector shape =
      line + with_curvature(-product(rule_->inverse, Vector(curvature_.cwiseProduct(line)), rule_->inner()), kRounding);
  Xyz first = chord, last = chord;
  double slope = 1.0;  // of the Jacobi field that is 0 and 1 at the ends, at the start
  for (int i = 0; i < rule_->inner(); ++i) {
    const double k = line[i], weight = rule_->lobatto.weights[i + 1];
    first -= weight * (1.0 - k) * bend_[i];
    last += weight * k * bend_[i];
    slope += weight * (1.0 - k) * curvature_[i] * shape[i];
  }
  const Xyz &n0 = ends_.start.n, &n1 = ends_.finish.n;
  first -= first.dot(n0) * n0;
  last -= last.dot(n1) * n1;
  Connection c;
  c.status = ConnectStatus::Converged;
  c.length = first.norm();
  if (!(std::abs(last.norm() - c.length) <= tolerance_ * c.length)) return std::nullopt;
  c.angle = ends_.start.angle_of(first);
  c.start_direction = tangent_components(ends_.at_from, first / c.length);
  c.end_direction = tangent_components(ends_.at_to, last.normalized());
  c.y = c.length / slope;
  c.residual = move_ * move_ * c.length;
  c.evaluations = evaluations_;
  return c;
}

}  // namespace

std::optional<Connection> collocate(const Surface& surface, const Ends& ends, const ConnectOptions& options) {
  constexpr double kRadii = 2.0;
  const double chord = (ends.at_to.S - ends.at_from.S).norm();
  if (!(chord > 0.0 && chord * ends.curvature < kRadii)) return std::nullopt;
  return Collocation(surface, ends, options.tolerance).solve();
}

}  // namespace geovor
