#include "geodesic/connect.h"

#include <algorithm>

#include "geodesic/closed_forms.h"
#include "geodesic/collocation.h"
#include "geodesic/relax.h"
#include "surface/pole_chart.h"

namespace geovor {
namespace {

constexpr int kEndJets = 2;

Connection zero_length(const Ends& ends, double angle) {
  Connection c;
  c.status = ConnectStatus::Converged;
  c.angle = angle;
  const UvVec d = tangent_components(ends.at_from, ends.start.at_angle(angle));
  c.start_direction = c.end_direction = is_finite(d) ? d : UvVec{};
  c.evaluations = kEndJets;
  return c;
}

// Several points, because the length of the line in space is measured along them.
std::vector<Uv> straight_line(Uv from, Uv to) {
  constexpr int kPieces = 8;
  std::vector<Uv> line;
  for (int i = 0; i <= kPieces; ++i) line.push_back(lerp(from, to, double(i) / kPieces));
  return line;
}

bool regular(const SurfaceJet& j) { return unit_normal(j).allFinite(); }

// At a pole all values of the parameter along it are one point.
bool same_point(const Surface& surface, const Ends& ends) {
  if (ends.from == ends.to) return true;
  constexpr double kRounding = 1e-15;
  if (!(ends.chord() <= kRounding * ends.at_from.S.norm())) return false;
  return std::any_of(surface.poles().begin(), surface.poles().end(),
                     [&](const auto& pole) { return pole->holds(ends.from) && pole->holds(ends.to); });
}

}  // namespace

Connection connect(const Surface& surface, Uv from, Uv to, std::optional<Polar> guess, const ConnectOptions& options) {
  if (auto closed = connect_closed_form(surface, from, to, guess)) return *closed;
  const Ends ends(surface, from, to);
  Connection c;
  c.evaluations = kEndJets;
  if (!ends.start.n.allFinite()) {
    c.status = ConnectStatus::DegenerateMetric;
    c.degenerate_at = from;
    return c;
  }
  if (!guess && same_point(surface, ends)) return zero_length(ends, 0.0);
  if (guess && guess->s == 0.0 && ends.at_from.S == ends.at_to.S) return zero_length(ends, guess->t);
  int spent = kEndJets;
  const auto attempt = [&](Polar start) {
    c = shoot(surface, ends, start, options);
    c.evaluations = spent += c.evaluations;
    return c.status == ConnectStatus::Converged;
  };
  if (guess && guess->s > 0.0 && attempt(*guess)) return c;
  if (guess && !options.persist) return c;
  if (!guess) {
    if (auto whole = collocate(surface, ends, options)) {
      whole->evaluations += kEndJets;
      return *whole;
    }
    if (const auto near = guess_from_chord(ends); near && attempt(polar_of(ends, *near))) return c;
  }
  const bool parametric = regular(ends.at_from) && regular(ends.at_to);
  if (parametric && attempt(guess_from_parameters(surface, ends))) return c;
  if (!parametric && attempt(guess_across(ends))) return c;
  if (!options.persist || !parametric) return c;
  c = connect_along(surface, ends, straight_line(from, to), options);
  c.evaluations += spent;
  return c;
}

}  // namespace geovor
