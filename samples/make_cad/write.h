// Writing the samples so that the same shape gives the same bytes: no time, no author, every digit of a double.
#pragma once

#include <string>

class TopoDS_Shape;

namespace make_cad {

/// `unit` in OpenCASCADE's words: "MM", "INCH", "M". The shape is in millimetres and keeps its size.
void write_step(const TopoDS_Shape& shape, const std::string& name, const std::string& unit, const std::string& path);
void write_iges(const TopoDS_Shape& shape, const std::string& path);

}  // namespace make_cad
