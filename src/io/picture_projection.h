// How space is laid on the page of a picture.
#pragma once

#include <vector>

#include "base/xyz.h"

namespace geovor {

/// A place on the page: x to the right and y downwards in page units; depth grows towards the viewer, in page units
/// too.
struct PagePoint {
  double x = 0.0, y = 0.0, depth = 0.0;
};

/// The part of the page that a picture may fill.
struct PageFrame {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
};

/// An orthographic view, z upwards on the page.
class PictureProjection {
 public:
  /// The isometric view from the right, front and above (as CAD programs start with: from (1, -1, 1)), scaled and
  /// shifted so that the points fill the frame and stand in its middle.
  static PictureProjection isometric(const std::vector<Xyz>& points, const PageFrame& frame);

  /// From any other direction, a unit vector; z upwards on the page, or y where the view is from above or below.
  static PictureProjection from(const Xyz& towards_viewer, const std::vector<Xyz>& points, const PageFrame& frame);

  PagePoint operator()(const Xyz& p) const;

  /// Unit vectors of space.
  const Xyz& right() const { return right_; }
  const Xyz& up() const { return up_; }
  const Xyz& towards_viewer() const { return towards_; }
  /// Page units a unit of space.
  double scale() const { return scale_; }

 private:
  Xyz right_, up_, towards_;
  Xyz centre_ = Xyz::Zero();
  double scale_ = 1.0, x_ = 0.0, y_ = 0.0;
};

}  // namespace geovor
