#include "voronoi/border_view.h"

#include <algorithm>
#include <cmath>

namespace geovor {
namespace {

// A place nearer to its site than this part of the step to it is the site's own: it has no angle.
constexpr double kOwnPlace = 1e-9;

// A step longer than this part of the distance to the site may swing the ray too far for a guess; the shortest ray is
// the cell's own there.
constexpr double kLongStep = 0.5;

/// The vertex's first generator owns the border that leaves it.
std::optional<Polar> ray_at_start(const VoronoiDiagram& d, int site, const CellPiece& piece) {
  if (piece.from_vertex < 0) return std::nullopt;
  const DiagramVertex& v = d.vertices[piece.from_vertex];
  if (v.sites.empty() || v.sites.front() != site) return std::nullopt;
  return Polar{v.radius, v.angles.front()};
}

double turn(const BorderView::Place& a, const BorderView::Place& b) { return wrap_angle(b.polar.t - a.polar.t); }

}  // namespace

BorderView view_of_border(const SiteRays& rays, const VoronoiDiagram& diagram, int site, const CellPiece& piece) {
  BorderView view;
  std::optional<SiteRay> last;
  std::optional<Polar> guess = ray_at_start(diagram, site, piece);
  const Xyz home = rays.surface().position(rays.site(site));
  for (size_t i = 0; i < piece.border_uv.size(); ++i) {
    const Uv uv = piece.border_uv[i];
    const Xyz x = piece.border_xyz[i];
    const double step = (x - piece.border_xyz[i > 0 ? i - 1 : i + 1 < piece.border_xyz.size() ? i + 1 : i]).norm();
    if (!((x - home).norm() > kOwnPlace * step)) {
      last.reset(), guess.reset();
      continue;
    }
    if (last) guess = step < kLongStep * last->polar.s ? std::optional<Polar>(carry(*last, x)) : std::nullopt;
    auto ray = rays.roughly_to(site, uv, guess);
    if (!ray && guess) ray = rays.roughly_to(site, uv);
    guess.reset();
    last = ray;
    if (ray) {
      view.places.push_back({uv, ray->polar, ray->y});
    } else {
      view.complete = false;
    }
  }
  return view;
}

std::vector<HiddenRun> hidden_runs(const BorderView& view, double width) {
  std::vector<HiddenRun> runs;
  const int n = static_cast<int>(view.places.size());
  for (int i = 0; i + 1 < n;) {
    int k = i;
    double aside = 0.0;
    for (; k + 1 < n && turn(view.places[k], view.places[k + 1]) < 0.0; ++k) {
      aside += std::abs(turn(view.places[k], view.places[k + 1]) * view.places[k + 1].y);
    }
    if (aside > width) runs.push_back({i, k});
    i = std::max(k, i + 1);
  }
  return runs;
}

void begin_in_front(BorderView& view) {
  const int n = static_cast<int>(view.places.size());
  for (int i = 0; i + 1 < n; ++i) {
    if (!(turn(view.places[i], view.places[i + 1]) > 0.0)) continue;
    view.places.pop_back();  // the first place once more
    std::rotate(view.places.begin(), view.places.begin() + i, view.places.end());
    view.places.push_back(view.places.front());
    return;
  }
}

}  // namespace geovor
