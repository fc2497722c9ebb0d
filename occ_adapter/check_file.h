// What can be said of a CAD file from its text alone, before OpenCASCADE sees it: OpenCASCADE reads a file that was cut
// short as far as it goes and reports success.
#pragma once

#include <string>

namespace geovor {

enum class CadFormat { Step, Iges, Brep, BinaryBrep };

/// The format by the file's ending, in any case, once its text was found to be of that format and complete.
/// Throws Error(Unreadable).
CadFormat check_cad_file(const std::string& path);

/// Why OpenCASCADE finds no face in an IGES file that has some: data beyond column 64 of the parameter section.
bool iges_overflows_column_64(const std::string& path);

}  // namespace geovor
