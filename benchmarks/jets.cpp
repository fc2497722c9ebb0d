// One jet: the position and five derivatives at a point.
#include <algorithm>
#include <string>

#include "benches.h"
#include "surface/analytic_surfaces.h"
#include "table.h"

namespace geovor::bench {
namespace {

constexpr int kPoints = 1000;
constexpr int kSpans = 20;

struct Subject {
  int p, q;
  bool rational;
};
constexpr Subject kSubjects[] = {{3, 3, false}, {3, 3, true},    {2, 2, false}, {2, 2, true},  {5, 5, false},
                                 {5, 5, true},  {7, 7, false},   {7, 7, true},  {3, 5, false}, {3, 5, true},
                                 {1, 3, false}, {25, 25, false}, {25, 25, true}};

std::string name_of(const Subject& s) {
  return std::string(s.rational ? "rational" : "polynomial") + " (" + std::to_string(s.p) + ", " + std::to_string(s.q) +
         ")";
}

Contender plain_jets(const Surface& surface, const std::vector<Uv>& points) {
  return {[&surface, points] {
            for (const Uv p : points) keep(surface.jet(p));
          },
          static_cast<int>(points.size())};
}

Contender positions(const Surface& surface, const std::vector<Uv>& points) {
  return {[&surface, points] {
            for (const Uv p : points) keep(surface.position(p));
          },
          static_cast<int>(points.size())};
}

Contender locked_jets(const Surface& surface, const std::vector<Uv>& points) {
  return {[&surface, points, span = surface.span(points.front(), {})] {
            for (const Uv p : points) keep(surface.jet(p, span));
          },
          static_cast<int>(points.size())};
}

Row row_of(const Subject& subject) {
  const Spline spline = wavy_sheet(subject.p, subject.q, kSpans, subject.rational);
  const BSplineSurface surface = spline.surface();
  constexpr int kMiddle = kSpans / 2;
  const auto near = random_points({{kMiddle, kMiddle + 1}, {kMiddle, kMiddle + 1}}, kPoints);
  const auto all = random_points(surface.domain(), kPoints);
  std::vector<Contender> contenders{locked_jets(surface, near), plain_jets(surface, near), plain_jets(surface, all),
                                    positions(surface, all)};
  for (const auto& points : {near, all})
    for (const Contender& c : occ_contenders(spline, points)) contenders.push_back(c);
  const std::vector<double> t = race(contenders);
  Row row{name_of(subject)};
  for (double ns : t) row.push_back(digits(ns, 1));
  if (t.size() < 8) return row;
  row.push_back(digits(std::min(t[4], t[5]) / t[0], 2));
  row.push_back(digits(std::min(t[4], t[5]) / t[1], 2));
  row.push_back(digits(std::min(t[6], t[7]) / t[2], 2));
  return row;
}

}  // namespace

void bench_jets() {
  const WaveSurface wave({{-10, 10}, {-10, 10}});
  const double ns = race({plain_jets(wave, random_points(wave.domain(), kPoints))})[0];
  std::vector<Row> rows{{"ns a call", "locked", "one span", "random", "position"}};
  const bool occ = !occ_contenders(wavy_sheet(3, 3, 2, false), {{0, 0}}).empty();
  if (occ) {
    const Row more{"D2 one", "adaptor one", "D2 random", "adaptor random", "locked ×", "one span ×", "random ×"};
    rows[0].insert(rows[0].end(), more.begin(), more.end());
  }
  rows.push_back({"wave", digits(ns, 1), digits(ns, 1), digits(ns, 1)});
  for (const Subject& subject : kSubjects) rows.push_back(row_of(subject));
  print_table(std::string("One jet on a B-spline of 20 x 20 spans, by its degrees") +
                  (occ ? "; × = OpenCASCADE's faster way / geovor, bar 3 for polynomial (3, 3), locked" : ""),
              rows);
}

#ifndef GEOVOR_BENCH_OCC
std::vector<Contender> occ_contenders(const Spline&, const std::vector<Uv>&) { return {}; }
#endif

}  // namespace geovor::bench
