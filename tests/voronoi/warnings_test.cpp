// What a diagram says about the limits of its own truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "test_faces.h"
#include "voronoi/diagram_builder.h"

namespace geovor::testing {
namespace {

/// A surface that keeps its periods to itself.
class Undeclared final : public Surface {
 public:
  Undeclared(SurfacePtr base, UvBox domain) : base_(std::move(base)), domain_(domain) {}
  SurfaceKind kind() const override { return SurfaceKind::Function; }
  UvBox domain() const override { return domain_; }
  SurfaceJet jet(Uv p) const override { return base_->jet(p); }

 private:
  SurfacePtr base_;
  UvBox domain_;
};

constexpr UvBox kOnce = {{0.0, 2.0 * kPi}, {0.0, 3.0}};

SurfacePtr tube() { return std::make_shared<Cylinder>(Frame{}, 1.0); }

std::vector<DiagramWarning> warnings_of(const TestFace& face, const std::vector<Uv>& sites, const std::string& kind) {
  std::vector<DiagramWarning> out;
  for (const DiagramWarning& w : build_diagram(face.domain(), sites).warnings) {
    if (w.kind == kind) out.push_back(w);
  }
  return out;
}

const std::vector<Uv> kTubeSites = {{0.5, 0.7}, {2.6, 2.2}, {5.0, 1.1}};

TEST(Warnings, ASeamWithoutPeriodIsNamed) {
  const auto w =
      warnings_of(TestFace(std::make_shared<Undeclared>(tube(), kOnce)).ring(kOnce), kTubeSites, "seam_is_border");
  ASSERT_EQ(w.size(), 1u);
  EXPECT_LT(std::min(w[0].uv.u, 2.0 * kPi - w[0].uv.u), 1e-9);
  EXPECT_NE(w[0].text.find("period"), std::string::npos);
}

TEST(Warnings, ASeamWithoutPeriodIsNamedWhereItsSidesAreTwoEdges) {
  const TestFace two_edges = TestFace(std::make_shared<Undeclared>(tube(), kOnce)).rectangle(kOnce);
  EXPECT_EQ(warnings_of(two_edges, kTubeSites, "seam_is_border").size(), 1u);
  const TestFace no_loops = whole(std::make_shared<Undeclared>(tube(), kOnce));
  EXPECT_EQ(warnings_of(no_loops, kTubeSites, "seam_is_border").size(), 1u);
}

TEST(Warnings, NoSeamIsNamedWhereThereIsNoneOrThePeriodIsDeclared) {
  EXPECT_TRUE(warnings_of(TestFace(tube()).ring(kOnce), kTubeSites, "seam_is_border").empty());
  EXPECT_TRUE(warnings_of(plane_square(), {{0.2, 0.1}, {-0.4, 0.5}}, "seam_is_border").empty());
  const UvBox open = {{0.0, 2.0 * kPi - 1e-3}, {0.0, 3.0}};
  EXPECT_TRUE(
      warnings_of(TestFace(std::make_shared<Undeclared>(tube(), open)).rectangle(open), kTubeSites, "seam_is_border")
          .empty());
}

}  // namespace
}  // namespace geovor::testing
