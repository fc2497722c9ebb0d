// A mesh while a reader takes it from a file. Private to the room.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/loaded_mesh.h"

namespace geovor {

/// Throws Error(Unreadable): "line 7: what; what would mend it"; without a line where that is 0.
[[noreturn]] void fail_to_read(int line, const std::string& what);

class MeshBuilder {
 public:
  void point(const Xyz& x) { loaded_.mesh.points.push_back(x); }
  int points() const { return static_cast<int>(loaded_.mesh.points.size()); }
  int triangles() const { return static_cast<int>(loaded_.mesh.triangles.size()); }

  /// The group of this name, made where it is new.
  int group(std::string_view name);
  /// A corner as a file numbers it, from `first` on; what can be no number of a point becomes -1, which finish()
  /// refuses.
  template <typename Number>
  static int corner(Number number, int first = 0) {
    const bool fits = number >= 0 && number <= static_cast<Number>(std::numeric_limits<int>::max() - first);
    return fits ? first + static_cast<int>(number) : -1;
  }
  /// A polygon becomes a fan of triangles; fewer than three corners count as an element of another kind.
  void polygon(const std::vector<int>& corners, int group);
  void other_element() { ++loaded_.other_elements; }
  void set_group(int triangle, int group) { loaded_.mesh.face_of[triangle] = group; }

  /// Makes points of equal coordinates one: the first of them.
  void weld();

  /// `digits`: significant digits of the coordinates (decimal_digits or those of a text), see rounding_of.
  static constexpr int kSingle = -1, kDouble = -2;
  /// Throws Error(Unreadable) where a corner is no point of the file, or a point is not finite.
  LoadedMesh finish(int digits);

 private:
  LoadedMesh loaded_;
  std::map<std::string, int, std::less<>> groups_;
};

}  // namespace geovor
