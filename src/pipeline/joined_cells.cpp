#include "pipeline/joined_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>

// The pieces are nodes of a graph whose arcs are the stretches of seams with the same site on both sides. From the
// largest piece on, each piece that an arc reaches for the first time is moved by the arc's period next to the piece
// before; then every stretch whose two sides have come to lie on each other vanishes. Different pieces in the same copy
// of the plane don't overlap, and no piece is there twice, so what is joined lies in one sheet.

namespace geovor {
namespace {

bool turns_in_files(SurfaceKind kind) {
  return kind == SurfaceKind::Cylinder || kind == SurfaceKind::Cone || kind == SurfaceKind::Sphere ||
         kind == SurfaceKind::Torus;
}

class Joiner {
 public:
  Joiner(const CellSheet& sheet, const FaceOutline& outline) : sheet_(sheet), outline_(outline) {
    const Surface& surface = outline.surface();
    const bool all = turns_in_files(surface.kind());
    if (all || surface.kind() == SurfaceKind::Revolution) u_period_ = surface.u_period().value_or(0.0);
    if (all) v_period_ = surface.v_period().value_or(0.0);
    next_.assign(sheet.lines.size(), {});
    piece_of_.assign(sheet.lines.size(), -1);
    shift_.assign(sheet.cells.size(), {0.0, 0.0});
    find_partners();
  }

  std::vector<JoinedCell> run() {
    std::vector<JoinedCell> out;
    std::vector<char> joined(sheet_.cells.size(), 0);
    for (int i : by_size()) {
      if (joined[i]) continue;
      std::vector<int> group = spread(i, joined);
      std::sort(group.begin(), group.end());
      out.push_back(join(group));
    }
    std::stable_sort(out.begin(), out.end(), [](const JoinedCell& a, const JoinedCell& b) { return a.site < b.site; });
    return out;
  }

 private:
  void find_partners() {
    partner_.assign(sheet_.lines.size(), -1);
    std::map<std::pair<int, double>, int> stretches;
    for (int i = 0; i < static_cast<int>(sheet_.lines.size()); ++i) {
      const SheetLine& line = sheet_.lines[i];
      if (line.side < 0 || outline_.sides()[line.side].partner < 0) continue;
      const double lo = std::min(line.t0, line.t1);
      stretches[{line.side, lo}] = i;
      const auto other = stretches.find({outline_.sides()[line.side].partner, lo});
      if (other != stretches.end()) partner_[i] = other->second, partner_[other->second] = i;
    }
    for (int c = 0; c < static_cast<int>(sheet_.cells.size()); ++c) {
      for (const auto& loop : sheet_.cells[c].loops) {
        for (LineUse use : loop) {
          if (sheet_.lines[use.line].run < 0) piece_of_[use.line] = c;
        }
      }
    }
  }

  /// Largest first, so that little is moved.
  std::vector<int> by_size() const {
    std::vector<double> sizes;
    std::vector<int> order;
    for (int i = 0; i < static_cast<int>(sheet_.cells.size()); ++i) {
      double twice = 0.0;
      for (LineUse use : sheet_.cells[i].loops.front()) twice += twice_area({use, {0.0, 0.0}});
      sizes.push_back(twice), order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return sizes[a] > sizes[b]; });
    return order;
  }

  /// The line's part of the sum that is twice the area of its loop.
  double twice_area(ShiftedUse s) const {
    const Uv origin{outline_.box().u.lo, outline_.box().v.lo};
    const auto& uv = sheet_.lines[s.use.line].uv;
    const auto at = [&](size_t i) { return uv[i] + s.shift - origin; };
    double sum = 0.0;
    for (size_t i = 0; i + 1 < uv.size(); ++i) sum += cross(at(i), at(i + 1));
    return s.use.reversed ? -sum : sum;
  }

  /// By how many periods the place of `line` is away from that of its partner.
  UvVec gap(int line) const {
    const Uv here = sheet_.lines[line].uv.front(), there = sheet_.lines[partner_[line]].uv.back();
    return {whole(here.u - there.u, u_period_), whole(here.v - there.v, v_period_)};
  }

  static double whole(double difference, double period) {
    return period > 0.0 ? period * std::round(difference / period) : 0.0;
  }

  /// Whether moving the partner's piece lays its side of the seam on the line.
  bool can_join(int line) const {
    const int other = partner_[line];
    if (other < 0 || piece_of_[other] < 0 || piece_of_[line] < 0) return false;
    if (sheet_.cells[piece_of_[line]].site != sheet_.cells[piece_of_[other]].site) return false;
    const UvVec left = sheet_.lines[line].uv.front() - sheet_.lines[other].uv.back() - gap(line);
    const UvBox& box = outline_.box();
    constexpr double kSamePlace = 1e-3;  // p-curves of a seam are a period apart to the CAD's accuracy
    return std::abs(left.u) <= kSamePlace * box.u.length() && std::abs(left.v) <= kSamePlace * box.v.length();
  }

  std::vector<int> spread(int start, std::vector<char>& joined) {
    std::vector<int> group;
    std::queue<int> reached({start});
    joined[start] = 1;
    for (; !reached.empty(); reached.pop()) {
      const int piece = reached.front();
      group.push_back(piece);
      for (const auto& loop : sheet_.cells[piece].loops) {
        for (LineUse use : loop) {
          if (!can_join(use.line) || joined[piece_of_[partner_[use.line]]]) continue;
          const int other = piece_of_[partner_[use.line]];
          shift_[other] = shift_[piece] + gap(use.line);
          joined[other] = 1;
          reached.push(other);
        }
      }
    }
    return group;
  }

  /// The two sides of the seam have come to lie on each other.
  bool vanishes(int line) const {
    if (sheet_.lines[line].run >= 0 || !can_join(line)) return false;
    const UvVec step = shift_[piece_of_[partner_[line]]] - shift_[piece_of_[line]] - gap(line);
    const double small = 0.5 * std::max(u_period_, v_period_);  // shifts are whole periods
    return std::abs(step.u) < small && std::abs(step.v) < small;
  }

  struct Follower {
    ShiftedUse use;
    bool walked = false;
  };

  std::array<Follower, 2>& at(LineUse use) { return next_[use.line]; }

  JoinedCell join(const std::vector<int>& group) {
    JoinedCell cell;
    cell.site = sheet_.cells[group.front()].site;
    std::vector<ShiftedUse> starts;
    for (int piece : group) {
      for (const auto& loop : sheet_.cells[piece].loops) {
        for (size_t i = 0; i < loop.size(); ++i) {
          at(loop[i])[loop[i].reversed] = {{loop[(i + 1) % loop.size()], shift_[piece]}, false};
          if (!vanishes(loop[i].line)) starts.push_back({loop[i], shift_[piece]});
        }
      }
    }
    std::vector<double> areas;
    for (const ShiftedUse& start : starts) {
      if (at(start.use)[start.use.reversed].walked) continue;
      cell.loops.push_back(walk(start));
      double twice = 0.0;
      for (const ShiftedUse& use : cell.loops.back()) twice += twice_area(use);
      areas.push_back(twice);
    }
    // One loop runs counter-clockwise: the outer one.
    const auto outer = std::max_element(areas.begin(), areas.end()) - areas.begin();
    if (!areas.empty()) std::swap(cell.loops.front(), cell.loops[outer]);
    return cell;
  }

  /// Once around from a line that stays; at a stretch that vanished the way goes on along what follows its partner.
  std::vector<ShiftedUse> walk(ShiftedUse use) {
    std::vector<ShiftedUse> loop;
    while (!at(use.use)[use.use.reversed].walked) {
      at(use.use)[use.use.reversed].walked = true;
      loop.push_back(use);
      use = at(use.use)[use.use.reversed].use;
      while (vanishes(use.use.line)) use = next_[partner_[use.use.line]][0].use;
    }
    return loop;
  }

  const CellSheet& sheet_;
  const FaceOutline& outline_;
  double u_period_ = 0.0, v_period_ = 0.0;     ///< 0: none that files know
  std::vector<int> partner_;                   ///< of a line: the other side of the seam
  std::vector<int> piece_of_;                  ///< of a stretch: index into the sheet's cells
  std::vector<UvVec> shift_;                   ///< of a piece
  std::vector<std::array<Follower, 2>> next_;  ///< of a line and whether it is reversed
};

}  // namespace

std::vector<JoinedCell> joined_cells(const CellSheet& sheet, const FaceOutline& outline) {
  return Joiner(sheet, outline).run();
}

}  // namespace geovor
