// The triangles of a mesh face by face, under names that a format takes.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/labelled_mesh.h"

namespace geovor {

/// What the names of a format may hold.
enum class NameAlphabet {
  Text,   ///< UTF-8 without control characters, " and backslash
  Word,   ///< the same without white space
  Plain,  ///< ASCII letters, digits, '_' and '-', a letter first
};

struct FaceGroup {
  int face = 0;
  std::string name;  ///< the CAD's where no other face has it, else with "_FaceN"; "FaceN" where the CAD has none
  std::optional<std::array<double, 3>> colour;  ///< linear
  std::span<const int> triangles;               ///< ascending; never empty
};

class FaceGroups {
 public:
  /// Names are of at most `longest` bytes, and differ in more than the case of their letters.
  /// REQUIRES: first_fault(mesh) finds nothing; longest >= 40.
  FaceGroups(const LabelledMesh& labelled, NameAlphabet alphabet, std::size_t longest = kLongest);
  FaceGroups(const FaceGroups&) = delete;  // spans point into it
  FaceGroups& operator=(const FaceGroups&) = delete;

  /// Ascending by face.
  const std::vector<FaceGroup>& groups() const { return groups_; }
  auto begin() const { return groups_.begin(); }
  auto end() const { return groups_.end(); }
  std::size_t size() const { return groups_.size(); }

  /// Room enough for people, and less than any reader's buffer (Gmsh's has 128 bytes).
  static constexpr std::size_t kLongest = 80;

 private:
  std::vector<int> order_;
  std::vector<FaceGroup> groups_;
};

/// The text with what the alphabet lacks replaced, cut to `longest` bytes between two characters; empty where no letter
/// or digit is left.
std::string name_in(NameAlphabet alphabet, const std::string& text, std::size_t longest);

}  // namespace geovor
