// What STEP files of meshes share: Part 21's texts and numbers, the product, units, colours.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "io/byte_stream.h"
#include "mesh/labelled_mesh.h"

namespace geovor {

/// Any UTF-8 between apostrophes, as ISO 10303-21 spells it.
std::string step_string(const std::string& text);

/// A real number of Part 21, which always has a point: the same double when it is read.
struct StepReal {
  double value;
};
ByteStream& operator<<(ByteStream& out, StepReal x);

struct StepSchema {
  const char* name;         ///< for FILE_SCHEMA
  const char* application;  ///< of APPLICATION_CONTEXT
  const char* protocol;     ///< of APPLICATION_PROTOCOL_DEFINITION
  int year;
  const char* description;  ///< of the file
};

/// A STEP file of one product on its way. Entities are numbered by the caller: reserve() gives numbers away.
class StepText {
 public:
  /// Puts the header, the product and the units. Throws Error(Unwritable) for a unit that STEP lacks.
  StepText(const LabelledMesh& labelled, const StepSchema& schema, ByteStream& out);

  /// `count` numbers in a row that nobody else gets; the first of them.
  std::size_t reserve(std::size_t count);

  /// The number of a PRESENTATION_STYLE_ASSIGNMENT for surfaces of this (linear) colour; put where it is new.
  std::size_t style(const std::array<double, 3>& linear);

  /// Ends the file: the items are the product's shape in a representation of this type; `styled` are its STYLED_ITEMs.
  void finish(const char* representation, const std::vector<std::size_t>& items,
              const std::vector<std::size_t>& styled);

 private:
  void put_head(const LabelledMesh& labelled, const StepSchema& schema);
  void put_product(const std::string& name, const StepSchema& schema);
  void put_units(const std::string& unit);
  void put_list(const std::vector<std::size_t>& numbers);

  ByteStream& out_;
  std::size_t next_ = 1;
  std::size_t shape_ = 0, context_ = 0, origin_ = 0;  ///< entities of the product
  std::map<std::array<double, 3>, std::size_t> styles_;
};

}  // namespace geovor
