// The page that shows a diagram or a mesh in a browser and turns it: its text, script included, around the data.
#pragma once

#include <functional>
#include <string>

#include "io/byte_stream.h"

namespace geovor {

struct PageParts {
  std::string title;                      ///< any text
  std::string keys;                       ///< what the keys beside those that turn and zoom do, and a click, as HTML
  std::function<void(ByteStream&)> data;  ///< puts the JSON that the script reads
};

/// Arrays in the JSON are base 64 of little-endian words; places are floats in the ball of radius 1. `points`,
/// `normals`, `triangles`; `owners`: of a point, owner * 16 + colour, where an owner is a site or a face; `lines`:
/// polylines, each its kind (0 bisector, 1 cut locus, 2 border), the number of its points, and these; `sites`: points.
/// Plain members: `title`, `unit`, `areas` (an owner, or null), `names` (an owner; without it they are sites), `tints`
/// (red, green, blue in bytes, an owner; without it the colours are the page's), `side` (where the triangles are to be
/// seen: the usual length of their sides).
void put_page(const PageParts& parts, ByteStream& out);

/// Any text inside JSON in a script; quotation marks not included.
std::string script_escaped(const std::string& text);

}  // namespace geovor
