// Patches of elementary surfaces and a wave under parameters whose lines stop at the sides: feet, normals and
// curvatures are known in closed form, and must not be worse there.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>

#include "support/differences.h"
#include "support/stopping_maps.h"
#include "surface/analytic_surfaces.h"
#include "surface/elementary_surfaces.h"
#include "surface/forms.h"
#include "surface/project.h"
#include "surface/shape.h"

namespace geovor {
namespace {

using testing::uniform;

/// A rectangle of the parameters of a surface, without periods.
class Piece final : public Surface {
 public:
  Piece(SurfacePtr base, const UvBox& box) : base_(std::move(base)), box_(box) {}
  SurfaceKind kind() const override { return base_->kind(); }
  UvBox domain() const override { return box_; }
  SurfaceJet jet(Uv p) const override { return base_->jet(p); }
  using Surface::jet;

 private:
  SurfacePtr base_;
  UvBox box_;
};

struct Patch {
  std::string name;
  SurfacePtr surface;
  UvBox box;
  std::function<Xyz(const Xyz&)> foot;  // on the whole surface
};

std::vector<Patch> patches() {
  const auto cylinder = [](const Xyz& x) {
    const double r = std::hypot(x.x(), x.y());
    return Xyz(2.0 * x.x() / r, 2.0 * x.y() / r, x.z());
  };
  const auto torus = [](const Xyz& x) {
    const Xyz c = 3.0 * Xyz(x.x(), x.y(), 0.0).normalized();
    return Xyz(c + (x - c).normalized());
  };
  return {{"Plane",
           std::make_shared<Plane>(Frame{}),
           {{-1, 2}, {0.5, 3}},
           [](const Xyz& x) { return Xyz(x.x(), x.y(), 0.0); }},
          {"Cylinder", std::make_shared<Cylinder>(Frame{}, 2.0), {{0.3, 1.8}, {-1, 2}}, cylinder},
          {"Sphere",
           std::make_shared<Sphere>(Frame{}, 2.0),
           {{0.3, 1.5}, {-0.7, 0.9}},
           [](const Xyz& x) { return Xyz(2.0 * x.normalized()); }},
          {"Torus", std::make_shared<Torus>(Frame{}, 3.0, 1.0), {{0.2, 1.1}, {-1.2, 1.4}}, torus}};
}

std::vector<SurfacePtr> stopped(const Patch& patch) {
  const UvBox& box = patch.box;
  const SurfacePtr base = std::make_shared<Piece>(patch.surface, box);
  using testing::PowerMap;
  using testing::SmoothStep;
  const auto power = [](Interval range, int m) { return std::make_shared<PowerMap>(range, m); };
  const auto smooth = [](Interval range) { return std::make_shared<SmoothStep>(range); };
  return {std::make_shared<Reparameterized>(base, power(box.u, 3), moebius_map(box.v, 1.0)),
          std::make_shared<Reparameterized>(base, power(box.u, 2), power(box.v, 4)),
          std::make_shared<Reparameterized>(base, power(box.u, 3), power(box.v, 3), true),
          std::make_shared<Reparameterized>(base, smooth(box.u), smooth(box.v)),
          std::make_shared<Reparameterized>(base, smooth(box.u), power(box.v, 5))};
}

// In turn a corner, points of the sides, points at any small distance from a side, and points inside.
Uv some_place(std::mt19937& random, int i) {
  Uv p{uniform(random, 0, 1), uniform(random, 0, 1)};
  const double little = std::pow(10.0, -uniform(random, 1, 12));
  switch (i % 9) {
    case 0:
      return {0, 0};
    case 1:
      return {0, p.v};
    case 2:
      return {1, p.v};
    case 3:
      return {p.u, 0};
    case 4:
      return {p.u, 1};
    case 5:
      return {little, p.v};
    case 6:
      return {p.u, 1 - little};
    case 7:
      return {little, little};
    default:
      return p;
  }
}

TEST(StoppingLines, FeetAreFoundFromTheirEndsAndCornersToo) {
  for (const Patch& patch : patches()) {
    for (const SurfacePtr& s : stopped(patch)) {
      const auto& map = static_cast<const Reparameterized&>(*s);
      std::mt19937 random(1);
      int inside = 0;
      for (int i = 0; i < 270; ++i) {
        const Uv guess = some_place(random, i);
        const Xyz off(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
        const Xyz x = s->position(guess) + 0.2 * off;
        const Xyz foot = patch.foot(x);
        const Projection p = project_near(*s, x, guess, s->domain());
        EXPECT_TRUE(p.converged) << patch.name << " " << i;
        const Uv whole = project_near(*patch.surface, foot, map.to_base(guess), patch.surface->domain()).uv;
        if (!patch.box.contains(whole)) {
          const auto [u, v] = s->domain();
          EXPECT_TRUE(p.uv.u == u.lo || p.uv.u == u.hi || p.uv.v == v.lo || p.uv.v == v.hi) << patch.name << " " << i;
          continue;
        }
        ++inside;
        EXPECT_LT((p.foot - foot).norm(), 1e-12) << patch.name << " " << i << " from " << guess.u << " " << guess.v;
      }
      EXPECT_GT(inside, 80) << patch.name;
    }
  }
}

// Beyond the border the foot is the nearest point of the patch: the same one that the patch's own parameters give.
TEST(StoppingLines, FeetOfPointsBeyondTheBorderLieOnIt) {
  for (const Patch& patch : patches()) {
    const Reparameterized plain(std::make_shared<Piece>(patch.surface, patch.box), moebius_map(patch.box.u, 1.0),
                                moebius_map(patch.box.v, 1.0));
    for (const SurfacePtr& s : stopped(patch)) {
      const auto& map = static_cast<const Reparameterized&>(*s);
      std::mt19937 random(2);
      for (int i = 0; i < 180; ++i) {
        const Uv guess = some_place(random, i);
        const Xyz off(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
        const Xyz x = s->position(guess) + 0.2 * off;
        const Projection p = project_near(*s, x, guess, s->domain());
        const Projection q = project_near(plain, x, plain.from_base(map.to_base(guess)), plain.domain());
        EXPECT_TRUE(p.converged && q.converged) << patch.name << " " << i;
        EXPECT_LT((p.foot - q.foot).norm(), 2e-12) << patch.name << " " << i << " from " << guess.u << " " << guess.v;
      }
    }
  }
}

TEST(StoppingLines, HaveTheNormalAndCurvatureOfTheSurfaceUpToTheirEnds) {
  std::vector<Patch> all = patches();
  all.push_back({"Wave", std::make_shared<WaveSurface>(UvBox{{0, 6}, {0, 6}}), {{1, 4}, {2, 5}}, {}});
  for (const Patch& patch : all) {
    for (const SurfacePtr& s : stopped(patch)) {
      const auto& map = static_cast<const Reparameterized&>(*s);
      const ShapeField field(*s, s->domain());
      std::mt19937 random(3);
      for (int i = 0; i < 270; ++i) {
        const Uv p = some_place(random, i);
        const SurfaceJet truth = patch.surface->jet(map.to_base(p));
        const auto shape = field.at(p, s->jet(p));
        ASSERT_TRUE(shape.has_value()) << patch.name << " " << i;
        const double sign = map.swapped() ? -1.0 : 1.0;
        EXPECT_LT((shape->n - sign * unit_normal(truth)).norm(), 1e-10) << patch.name << " " << p.u << " " << p.v;
        EXPECT_NEAR(shape->largest_curvature(), curvatures(truth).largest(), 1e-7)
            << patch.name << " " << p.u << " " << p.v;
      }
    }
  }
}

TEST(ShapeField, IsExactAtThePolesOfASphere) {
  const Sphere sphere({}, 2.0);
  const ShapeField field(sphere, sphere.domain());
  for (double away : {0.0, 1e-14, 1e-9, 1e-5, 1e-2}) {
    const Uv p{0.7, std::numbers::pi / 2 - away};
    const SurfaceJet j = sphere.jet(p);
    const auto shape = field.at(p, j);
    ASSERT_TRUE(shape.has_value()) << away;
    EXPECT_LT((shape->n - j.S.normalized()).norm(), 1e-14) << away;
    EXPECT_NEAR(shape->largest_curvature(), 0.5, 1e-14) << away;
  }
}

TEST(ShapeField, KnowsNothingAtTheTipOfACone) {
  const Cone cone({}, 2.0, 0.5);
  const ShapeField field(cone, {{0, 6}, {cone.apex_v(), 1}});
  const Uv tip{1.0, cone.apex_v()};
  EXPECT_FALSE(field.at(tip, cone.jet(tip)).has_value());
}

}  // namespace
}  // namespace geovor
