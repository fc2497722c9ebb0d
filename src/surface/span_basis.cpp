#include "surface/span_basis.h"

namespace geovor {
namespace {

// A polynomial on a span: coefficient k belongs to a^(n-k) b^k.
using Polynomial = std::vector<double>;

void add(const Polynomial& f, double factor, Polynomial& sum) {
  for (size_t k = 0; k < f.size(); ++k) sum[k] += factor * f[k];
}

// sum += f * (at_lo a + at_hi b), one degree higher.
void add_product(const Polynomial& f, double at_lo, double at_hi, Polynomial& sum) {
  for (size_t k = 0; k < f.size(); ++k) {
    sum[k] += at_lo * f[k];
    sum[k + 1] += at_hi * f[k];
  }
}

// The functions of one span, from degree to degree. [Piegl & Tiller, The NURBS Book, (2.5) and (2.7)]
class Recurrence {
 public:
  Recurrence(const KnotVector& knots, int span) : t_(&knots.flat()[span]), reciprocals_(knots.reciprocals(span)) {}

  // From the functions of degree q - 1 (q of them) to those of degree q: the factors are convex weights in the span.
  std::vector<Polynomial> raised(const std::vector<Polynomial>& N, int q) const {
    std::vector<Polynomial> up(q + 1, Polynomial(q + 1, 0.0));
    for (int r = 0; r < q; ++r) {
      const double right = t_[1 + r], left = t_[1 + r - q], per = reciprocal(q, r);
      add_product(N[r], (right - t_[0]) * per, (right - t_[1]) * per, up[r]);
      add_product(N[r], (t_[0] - left) * per, (t_[1] - left) * per, up[r + 1]);
    }
    return up;
  }

  // From derivatives of the functions of degree q - 1 to those, one order higher, of the functions of degree q.
  std::vector<Polynomial> differentiated(const std::vector<Polynomial>& D, int q) const {
    std::vector<Polynomial> up(q + 1, Polynomial(D.front().size(), 0.0));
    for (int r = 0; r < q; ++r) {
      add(D[r], -q * reciprocal(q, r), up[r]);
      add(D[r], q * reciprocal(q, r), up[r + 1]);
    }
    return up;
  }

 private:
  double reciprocal(int q, int r) const { return reciprocals_[q * (q - 1) / 2 + r]; }

  const double* t_;
  const double* reciprocals_;
};

}  // namespace

SpanBasis::SpanBasis(const KnotVector& knots) : degree_(knots.degree()) {
  const std::vector<double>& t = knots.flat();
  const int p = degree_, last = static_cast<int>(t.size()) - p - 1;
  row_of_span_.assign(t.size(), 0);
  for (int i = p; i < last; ++i) {
    if (!(t[i] < t[i + 1])) continue;
    row_of_span_[i] = static_cast<int>(places_.size());
    places_.push_back({t[i], t[i + 1], 1.0 / (t[i + 1] - t[i]), table_.size()});
    tabulate(knots, i);
  }
}

void SpanBasis::tabulate(const KnotVector& knots, int span) {
  const Recurrence recurrence(knots, span);
  const int p = degree_;
  for (int order = 0; order < 3; ++order) {
    if (order > p) continue;
    std::vector<Polynomial> N{{1.0}};
    for (int q = 1; q <= p; ++q) N = q <= p - order ? recurrence.raised(N, q) : recurrence.differentiated(N, q);
    for (int k = 0; k <= p - order; ++k) {
      const size_t at = table_.size();
      table_.resize(at + quads(p), Quad{});
      for (int r = 0; r <= p; ++r) table_[at + r / 4].at[r % 4] = N[r][k];
    }
  }
}

}  // namespace geovor
