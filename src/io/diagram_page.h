// The page of a diagram: "@TITLE@" and "@DATA@" stand for what differs. Private to the room.
#pragma once

namespace geovor {

extern const char* const kDiagramPage;

}  // namespace geovor
