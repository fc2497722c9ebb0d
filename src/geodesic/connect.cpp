#include "geodesic/connect.h"

#include "geodesic/closed_forms.h"
#include "geodesic/relax.h"

namespace geovor {
namespace {

constexpr int kEndJets = 2;

Connection zero_length(const SurfaceJet& j, double angle) {
  Connection c;
  c.status = ConnectStatus::Converged;
  c.angle = angle;
  c.start_direction = c.end_direction = tangent_components(j, tangent_at_angle(j, angle));
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

}  // namespace

Connection connect(const Surface& surface, Uv from, Uv to, std::optional<Polar> guess, const ConnectOptions& options) {
  if (auto closed = connect_closed_form(surface, from, to, guess)) return *closed;
  const Ends ends(surface, from, to);
  Connection c;
  c.evaluations = kEndJets;
  if (!regular(ends.at_from) || !regular(ends.at_to)) {
    c.status = ConnectStatus::DegenerateMetric;
    return c;
  }
  const bool same_point = ends.at_from.S == ends.at_to.S;
  if (same_point && (guess ? guess->s == 0.0 : from == to)) {
    c = zero_length(ends.at_from, guess ? guess->t : 0.0);
    c.evaluations = kEndJets;
    return c;
  }
  int spent = kEndJets;
  const auto attempt = [&](Polar start) {
    c = shoot(surface, ends, start, options);
    c.evaluations = spent += c.evaluations;
    return c.status == ConnectStatus::Converged;
  };
  if (guess && guess->s > 0.0 && attempt(*guess)) return c;
  if (guess && !options.persist) return c;
  if (!guess) {
    if (const auto near = guess_from_chord(ends); near && attempt(*near)) return c;
  }
  if (attempt(guess_from_parameters(surface, ends)) || !options.persist) return c;
  c = connect_along(surface, ends, straight_line(from, to), options);
  c.evaluations += spent;
  return c;
}

}  // namespace geovor
