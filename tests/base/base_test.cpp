#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

#include "base/error.h"
#include "base/interval.h"
#include "base/uv.h"

namespace geovor {
namespace {

template <typename A, typename B>
concept Addable = requires(A a, B b) {
  a + b;
};

TEST(Uv, PlacesCannotBeAddedButDirectionsCan) {
  static_assert(!Addable<Uv, Uv>);
  static_assert(!std::is_convertible_v<UvVec, Uv> && !std::is_convertible_v<Uv, UvVec>);
  static_assert(Addable<Uv, UvVec> && Addable<UvVec, UvVec>);
  const Uv p = Uv{1, 2} + UvVec{3, 4};
  EXPECT_EQ(p, (Uv{4, 6}));
  const UvVec d = p - Uv{1, 2};
  EXPECT_EQ(d.u, 3);
  EXPECT_EQ(d.v, 4);
}

TEST(Uv, CrossIsTwiceTheAreaAndChangesSignWithTheOrder) {
  const UvVec a{2, 0}, b{1, 3};
  EXPECT_EQ(cross(a, b), 6);
  EXPECT_EQ(cross(b, a), -6);
  EXPECT_EQ(cross(a, a), 0);
}

TEST(Uv, LerpMeetsBothEnds) {
  const Uv a{1, -2}, b{4, 7};
  EXPECT_EQ(lerp(a, b, 0), a);
  EXPECT_EQ(lerp(a, b, 1), b);
}

TEST(Uv, NotANumberIsNotFinite) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_finite(Uv{0, 0}));
  EXPECT_FALSE(is_finite(Uv{0, kNan}));
  EXPECT_FALSE(is_finite(UvVec{std::numeric_limits<double>::infinity(), 0}));
}

TEST(Interval, HoldsItsEndsAndMayBeInfinite) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const Interval all{-kInf, kInf};
  EXPECT_TRUE(all.contains(1e300));
  EXPECT_EQ(all.clamp(5), 5);
  const Interval unit{0, 1};
  EXPECT_TRUE(unit.contains(0) && unit.contains(1));
  EXPECT_FALSE(unit.contains(1 + 1e-15));
  EXPECT_EQ(unit.clamp(-3), 0);
  EXPECT_EQ(unit.middle(), 0.5);
}

TEST(Error, CarriesItsCodeAndItsLine) {
  const Error e(ErrorCode::Unreadable, "no face; give one");
  EXPECT_EQ(static_cast<int>(e.code()), 2);
  EXPECT_STREQ(e.what(), "no face; give one");
}

}  // namespace
}  // namespace geovor
