// Colour and light of a mesh picture.
#pragma once

#include <string>

#include "base/xyz.h"
#include "io/picture_projection.h"

namespace geovor {

/// Red, green and blue in linear light, 0 … 1.
using LinearColour = Eigen::Vector3d;

/// "#rrggbb".
std::string to_hex(const LinearColour& colour);

/// A tint for a CAD face: of even lightness, and far in hue from those of the faces with the next numbers.
LinearColour face_tint(int number);
/// The one tint of a picture that is not coloured by face.
LinearColour plain_tint();

/// The light that a surface of this tint and unit normal (towards the viewer) sends to the viewer: a key light from the
/// upper left, a weak fill light from the right, the sky and a trace of gloss.
LinearColour lit(const LinearColour& tint, const Xyz& normal, const PictureProjection& view);

}  // namespace geovor
