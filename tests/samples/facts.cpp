#include "samples/facts.h"

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "samples/panel_quadrature.h"

namespace geovor::testing {

namespace {

constexpr double kPi = std::numbers::pi;

/// A graph z = f(x, y) over the square [-half, half]^2, with its gradient.
struct Graph {
  double half = 1.0;
  double error = 0.0;
  std::function<double(double, double)> f, fx, fy;
};

double bell(double x, double y) { return 3.0 * std::exp(-(x * x + y * y) / 0.18); }

const std::map<std::string, Graph>& graphs() {
  using std::cos, std::sin;
  static const std::map<std::string, Graph> all = {
      {"wave",
       {3.0, 1e-9, [](double x, double y) { return sin(x) * cos(y); },
        [](double x, double y) { return cos(x) * cos(y); }, [](double x, double y) { return -sin(x) * sin(y); }}},
      {"flat",
       {3.0, 1e-15, [](double, double) { return 0.0; }, [](double, double) { return 0.0; },
        [](double, double) { return 0.0; }}},
      {"paraboloid",
       {1.0, 1e-15, [](double x, double y) { return x * x + y * y; }, [](double x, double) { return 2.0 * x; },
        [](double, double y) { return 2.0 * y; }}},
      {"bumps",
       {2.0, 6e-6, [](double x, double y) { return bell(x - 1.0, y - 0.2) + bell(x + 1.0, y - 0.2); },
        [](double x, double y) {
          return -(x - 1.0) / 0.09 * bell(x - 1.0, y - 0.2) - (x + 1.0) / 0.09 * bell(x + 1.0, y - 0.2);
        },
        [](double x, double y) { return -(y - 0.2) / 0.09 * (bell(x - 1.0, y - 0.2) + bell(x + 1.0, y - 0.2)); }}},
  };
  return all;
}

std::string stem(const std::string& file) { return file.substr(0, file.find('.')); }

double graph_area(const std::string& name) {
  constexpr int kPanels = 60;
  const Graph& g = graphs().at(name);
  return integrate_panels({{-g.half, g.half}, {-g.half, g.half}}, kPanels,
                          [&](double x, double y) { return std::hypot(1.0, g.fx(x, y), g.fy(x, y)); });
}

/// The volume of samples/cad/bracket.step from its drawing: blocks, minus holes, with every fillet.
double bracket_volume() {
  const double corner = 1.0 - kPi / 4.0;  // what a fillet of radius 1 takes from (or gives to) a square corner
  const double blocks = 60.0 * 40.0 * 6.0 + 6.0 * 40.0 * 44.0;
  const double inner_bend = corner * 8.0 * 8.0 * 40.0, outer_bend = corner * 4.0 * 4.0 * 40.0;
  const double foot_corners = 2.0 * corner * 10.0 * 10.0 * 6.0, upright_corners = 2.0 * corner * 12.0 * 12.0 * 6.0;
  const double sink = kPi * 3.0 / 3.0 * (6.5 * 6.5 + 6.5 * 3.5 + 3.5 * 3.5) + kPi * 3.5 * 3.5 * 3.0;
  const double slot = (8.0 * 12.0 + kPi * 4.0 * 4.0) * 6.0;
  const double boss = kPi * 11.0 * 11.0 * 8.0, bore = kPi * 6.0 * 6.0 * 14.0;
  // Pappus: (square - quarter disk) turned about the axis; a quarter disk's centroid lies 4 r / (3 pi) from its centre.
  const double foot_of_boss = 2.0 * kPi * (9.0 * 12.5 - 9.0 * kPi / 4.0 * (14.0 - 4.0 / kPi));
  const double rim_of_boss = 2.0 * kPi * (4.0 * 10.0 - kPi * (9.0 + 8.0 / (3.0 * kPi)));
  return blocks + inner_bend - outer_bend - foot_corners - upright_corners - 2.0 * sink - slot + boss - bore +
         foot_of_boss - rim_of_boss;
}

Facts open_face(double area, double area_error, int euler = 1) { return {1, false, euler, area, area_error, {}}; }

Facts solid(int faces, int euler, double area, double volume, const std::string& unit = "millimetre") {
  return {faces, true, euler, area, 1e-9, volume, unit};
}

/// STEP spells its units out, IGES abbreviates them.
Facts in_iges(Facts facts) {
  facts.unit = "mm";
  return facts;
}

const std::map<std::string, Facts>& all_facts() {
  // Area of the bicubic patch: OpenCASCADE's integral, which agrees to the digits given for freeform and
  // freeform_refined; see README.md. The trimmed face's was integrated by OpenCASCADE too.
  const Facts patch = open_face(1919.80386613, 1e-8);
  const double plate_area = 14368.0 + 112.0 * kPi, plate_volume = 45696.0 - 1600.0 * kPi;
  static const std::map<std::string, Facts> facts = {
      {"wave.step", open_face(graph_area("wave"), 1e-8)},
      {"wave.iges", in_iges(open_face(graph_area("wave"), 1e-8))},
      {"flat.step", open_face(36.0, 1e-12)},
      {"paraboloid.step", open_face(graph_area("paraboloid"), 1e-10)},
      {"bumps.step", open_face(graph_area("bumps"), 1e-5)},
      {"freeform.step", patch},
      {"freeform_refined.step", patch},
      {"freeform_swapped.step", patch},
      {"freeform_moebius.step", patch},
      {"freeform_trimmed.step", open_face(1754.457, 1e-6, -2)},
      {"cylinder_tube.step", open_face(600.0 * kPi, 1e-9, 0)},
      {"cylinder.step", solid(3, 2, 800.0 * kPi, 3000.0 * kPi)},
      {"sphere.step", solid(1, 2, 400.0 * kPi, 4000.0 * kPi / 3.0)},
      {"torus.step", solid(1, 0, 480.0 * kPi * kPi, 1440.0 * kPi * kPi)},
      {"cone.step", solid(2, 2, 200.0 * kPi, 320.0 * kPi)},
      {"plate.step", solid(15, -10, plate_area, plate_volume)},
      {"plate.iges", in_iges(solid(15, -10, plate_area, plate_volume))},
      {"plate_inch.step", solid(15, -10, plate_area, plate_volume, "inch")},
      {"plate_metre.step", solid(15, -10, plate_area, plate_volume, "metre")},
      {"bracket.step", solid(27, -6, 10306.5897941, bracket_volume())},
  };
  return facts;
}

}  // namespace

std::optional<Facts> facts_of(const std::string& file) {
  const auto found = all_facts().find(file);
  return found == all_facts().end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> graph_height(const std::string& file, double x, double y) {
  const auto found = graphs().find(stem(file));
  return found == graphs().end() ? std::nullopt : std::optional(found->second.f(x, y));
}

double graph_error(const std::string& file) { return graphs().at(stem(file)).error; }

}  // namespace geovor::testing
