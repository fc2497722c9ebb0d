#include "io/picture_projection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace geovor {

PictureProjection PictureProjection::isometric(const std::vector<Xyz>& points, const PageFrame& frame) {
  return from(Xyz(1.0, -1.0, 1.0).normalized(), points, frame);
}

PictureProjection PictureProjection::from(const Xyz& towards_viewer, const std::vector<Xyz>& points,
                                          const PageFrame& frame) {
  constexpr double kFromAbove = 0.999;  // beyond, z has hardly any length on the page
  PictureProjection view;
  view.towards_ = towards_viewer;
  const Xyz upwards = std::abs(view.towards_.z()) > kFromAbove ? Xyz::UnitY() : Xyz::UnitZ();
  view.right_ = upwards.cross(view.towards_).normalized();
  view.up_ = view.towards_.cross(view.right_);
  view.x_ = frame.left + 0.5 * frame.width;
  view.y_ = frame.top + 0.5 * frame.height;
  if (points.empty()) return view;
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Xyz lower = Xyz::Constant(kInf), upper = -lower;  // along right, up, towards
  for (const Xyz& p : points) {
    const Xyz q(p.dot(view.right_), p.dot(view.up_), p.dot(view.towards_));
    lower = lower.cwiseMin(q);
    upper = upper.cwiseMax(q);
  }
  const Xyz middle = 0.5 * (lower + upper), extent = upper - lower;
  view.centre_ = middle[0] * view.right_ + middle[1] * view.up_ + middle[2] * view.towards_;
  const double scale =
      std::min(extent[0] > 0.0 ? frame.width / extent[0] : kInf, extent[1] > 0.0 ? frame.height / extent[1] : kInf);
  if (scale < kInf) view.scale_ = scale;
  return view;
}

PagePoint PictureProjection::operator()(const Xyz& p) const {
  const Xyz d = p - centre_;
  return {x_ + scale_ * d.dot(right_), y_ - scale_ * d.dot(up_), scale_ * d.dot(towards_)};
}

}  // namespace geovor
