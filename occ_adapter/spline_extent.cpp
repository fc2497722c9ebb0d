// A Bézier piece lies in the hull of its poles, and the hull of a half is nearer to it by a factor of four. A piece is
// left alone where its hull does not reach beyond the box, and where the differences of its poles show that no
// derivative of the coordinate vanishes in it: its largest value then lies on its border, which a neighbour shares or
// the box holds. What remains shrinks quickly to the places where a coordinate is extremal.
#include "occ_adapter/spline_extent.h"

#include <algorithm>
#include <utility>

namespace geovor::occ {
namespace {

constexpr int kMostPoles = 26;  // OpenCASCADE's highest degree is 25
/// Poles of one coordinate (times their weights), u down the rows.
using Net = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostPoles, kMostPoles>;

/// A Bézier piece of one coordinate, homogeneous: F / W.
struct Piece {
  Net F, W;
  UvBox box;
};

/// The knots around the span [t_k, t_k+1] as the pyramid of its poles uses them.
struct Local {
  const double* knots;  ///< t_(k-p+1) … t_(k+p)
  double from, to;      ///< the part of the span that is wanted
};

/// The rows of `net` are the poles of a span; they become the Bézier poles of its part, by the blossom: pole i is that
/// of p - i times `from` and i times `to`.
Net bezier_rows(const Net& net, const Local& local) {
  const int p = static_cast<int>(net.rows()) - 1;
  Net out(net.rows(), net.cols());
  for (int i = 0; i <= p; ++i) {
    Net d = net;
    for (int r = 1; r <= p; ++r) {
      const double x = r <= p - i ? local.from : local.to;
      for (int j = p; j >= r; --j) {
        const double lo = local.knots[j - 1], hi = local.knots[j + p - r];
        const double a = (x - lo) / (hi - lo);
        d.row(j) = (1.0 - a) * d.row(j - 1) + a * d.row(j);
      }
    }
    out.row(i) = d.row(p);
  }
  return out;
}

/// De Casteljau at the middle of the rows.
std::pair<Net, Net> halves(const Net& net) {
  std::pair<Net, Net> both{net, net};
  Net d = net;
  const int n = static_cast<int>(net.rows()) - 1;
  for (int r = 0; r <= n; ++r) {
    both.first.row(r) = d.row(0);
    both.second.row(n - r) = d.row(n - r);
    for (int i = 0; i < n - r; ++i) d.row(i) = 0.5 * (d.row(i) + d.row(i + 1));
  }
  return both;
}

Net turned(const Net& net) { return net.transpose(); }

std::pair<Piece, Piece> halves(const Piece& piece, bool along_u) {
  const auto split = [&](const Net& net) {
    auto both = halves(along_u ? net : turned(net));
    if (!along_u) both = {turned(both.first), turned(both.second)};
    return both;
  };
  auto [f, g] = split(piece.F);
  auto [v, w] = split(piece.W);
  std::pair<Piece, Piece> both{{f, v, piece.box}, {g, w, piece.box}};
  (along_u ? both.first.box.u : both.first.box.v).hi = (along_u ? piece.box.u : piece.box.v).middle();
  (along_u ? both.second.box.u : both.second.box.v).lo = (along_u ? piece.box.u : piece.box.v).middle();
  return both;
}

Net differences(const Net& net, bool along_u) {
  if (along_u) return net.bottomRows(net.rows() - 1) - net.topRows(net.rows() - 1);
  return net.rightCols(net.cols() - 1) - net.leftCols(net.cols() - 1);
}

/// Whether the derivative of F / W along u or v has a sign: that of G' W - G W' with G = F - c W, for any c.
bool has_sign(const Net& G, const Net& W, bool rational, bool along_u) {
  const Net d = differences(G, along_u);
  const double least = d.minCoeff(), most = d.maxCoeff();
  if (!rational) return least > 0.0 || most < 0.0;
  const double from_weights = G.cwiseAbs().maxCoeff() * differences(W, along_u).cwiseAbs().maxCoeff();
  const double room = W.minCoeff();
  return least * room > from_weights || most * room < -from_weights;
}

/// Whether a knot inside is as multiple as the degree: across it the derivative may jump from one sign to the other.
bool has_crease(const std::vector<double>& knots, int degree, int count) {
  for (int k = degree + 1; k + degree <= count; ++k) {
    if (!(knots[k] < knots[k + degree - 1])) return true;
  }
  return false;
}

/// Looks for the largest value of one coordinate.
class Reach {
 public:
  Reach(const SplinePoles& spline, double tolerance, const std::function<bool(double, double)>& inside)
      : spline_(spline),
        smooth_u_(!has_crease(spline.u_knots, spline.p, spline.n_u)),
        smooth_v_(spline.q > 0 && !has_crease(spline.v_knots, spline.q, spline.n_v)),
        tolerance_(tolerance),
        inside_(inside) {}

  /// The largest value beyond `most` in the piece, or `most`.
  double of(Piece first, double most) {
    most_ = most;
    std::vector<Piece> open{std::move(first)};
    while (!open.empty()) {
      const Piece piece = std::move(open.back());
      open.pop_back();
      look_at(piece, open);
    }
    return most_;
  }

 private:
  void look_at(const Piece& piece, std::vector<Piece>& open);
  double best_corner(const Piece& piece);

  const SplinePoles& spline_;
  bool smooth_u_, smooth_v_;
  double tolerance_;
  const std::function<bool(double, double)>& inside_;
  double most_ = 0.0;
};

/// The largest value at a corner; the box grows by it if the corner counts.
double Reach::best_corner(const Piece& piece) {
  double best = -std::numeric_limits<double>::infinity();
  Uv at{0.0, 0.0};
  for (const auto& [i, u] :
       {std::pair{Eigen::Index{0}, piece.box.u.lo}, std::pair{piece.F.rows() - 1, piece.box.u.hi}}) {
    for (const auto& [j, v] :
         {std::pair{Eigen::Index{0}, piece.box.v.lo}, std::pair{piece.F.cols() - 1, piece.box.v.hi}}) {
      const double value = piece.F(i, j) / piece.W(i, j);
      if (value > best) {
        best = value;
        at = {u, v};
      }
    }
  }
  if (best > most_ && inside_(at.u, at.v)) most_ = best;
  return best;
}

void Reach::look_at(const Piece& piece, std::vector<Piece>& open) {
  const double hull = (piece.F.array() / piece.W.array()).maxCoeff();
  if (!(hull > most_ + tolerance_)) return;
  const Net G = piece.F - piece.F(0, 0) / piece.W(0, 0) * piece.W;
  if (smooth_u_ && has_sign(G, piece.W, spline_.rational, true)) return;
  if (smooth_v_ && has_sign(G, piece.W, spline_.rational, false)) return;
  if (!(hull > best_corner(piece) + tolerance_)) return;
  // Where the differences differ more, the piece is bent more, or it bends with the other direction.
  const auto spread = [&G](bool along_u) {
    const Net d = differences(G, along_u);
    return d.maxCoeff() - d.minCoeff();
  };
  const bool along_u = spline_.q == 0 || spread(true) >= spread(false);
  const Interval side = along_u ? piece.box.u : piece.box.v;
  if (!(side.lo < side.middle() && side.middle() < side.hi)) return;
  auto [first, second] = halves(piece, along_u);
  open.push_back(std::move(first));
  open.push_back(std::move(second));
}

/// Spans of a flat knot vector that `over` meets: the index of the last knot before each, and the part that is met.
std::vector<std::pair<int, Interval>> spans(const std::vector<double>& knots, int degree, int count, Interval over) {
  std::vector<std::pair<int, Interval>> met;
  for (int k = degree; k < count; ++k) {
    const Interval part{std::max(knots[k], over.lo), std::min(knots[k + 1], over.hi)};
    if (part.lo < part.hi) met.emplace_back(k, part);
  }
  return met;
}

/// The span's poles of one coordinate, as Bézier poles of the part.
Piece bezier(const SplinePoles& s, const std::pair<int, Interval>& u, const std::pair<int, Interval>& v,
             const Eigen::Vector3d& axis) {
  Piece piece{Net(s.p + 1, s.q + 1), Net(s.p + 1, s.q + 1), {u.second, v.second}};
  for (int i = 0; i <= s.p; ++i) {
    for (int j = 0; j <= s.q; ++j) {
      const Eigen::Vector4d& pole = s.poles[(u.first - s.p + i) * s.n_v + v.first - s.q + j];
      piece.F(i, j) = pole.head<3>().dot(axis);
      piece.W(i, j) = pole[3];
    }
  }
  for (Net* net : {&piece.F, &piece.W}) {
    *net = bezier_rows(*net, {&s.u_knots[u.first - s.p + 1], u.second.lo, u.second.hi});
    if (s.q > 0) *net = turned(bezier_rows(turned(*net), {&s.v_knots[v.first - s.q + 1], v.second.lo, v.second.hi}));
  }
  return piece;
}

/// The box of the poles of a span, which holds it.
Extent pole_box(const SplinePoles& s, int k_u, int k_v) {
  Extent box;
  for (int i = k_u - s.p; i <= k_u; ++i) {
    for (int j = k_v - s.q; j <= k_v; ++j) {
      const Eigen::Vector4d& pole = s.poles[i * s.n_v + j];
      box.add(pole.head<3>() / pole[3]);
    }
  }
  return box;
}

}  // namespace

void grow(Extent& extent, const SplinePoles& spline, const UvBox& over, double tolerance,
          const std::function<bool(double u, double v)>& inside) {
  const auto along_u = spans(spline.u_knots, spline.p, spline.n_u, over.u);
  const auto along_v = spline.q == 0 ? std::vector<std::pair<int, Interval>>{{0, over.v}}
                                     : spans(spline.v_knots, spline.q, spline.n_v, over.v);
  Reach reach(spline, tolerance, inside);
  for (const auto& u : along_u) {
    for (const auto& v : along_v) {
      const Extent poles = pole_box(spline, u.first, v.first);
      for (int k = 0; k < 3; ++k) {
        if (poles.upper[k] > extent.upper[k] + tolerance)
          extent.upper[k] = reach.of(bezier(spline, u, v, Xyz::Unit(k)), extent.upper[k]);
        if (poles.lower[k] < extent.lower[k] - tolerance)
          extent.lower[k] = -reach.of(bezier(spline, u, v, -Xyz::Unit(k)), -extent.lower[k]);
      }
    }
  }
}

}  // namespace geovor::occ
