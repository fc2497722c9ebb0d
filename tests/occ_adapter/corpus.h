// Where the shared CAD files are, and how OpenCASCADE alone reads them: the referee for the adapter.
#pragma once

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

namespace geovor::test {

/// Path of a file of the shared data; empty where the data is absent (see SKIP_WITHOUT).
std::string shared_file(const std::string& relative);

/// Read by OpenCASCADE's plain readers, by the ending.
TopoDS_Shape read_by_occ(const std::string& path);

/// In TopExp order.
std::vector<TopoDS_Face> faces_of(const TopoDS_Shape& shape);

/// A folder of its own for a test's files, empty at the start.
std::string scratch_folder(const std::string& name);

/// Files with faces of every kind that are read in well under a second each.
std::vector<std::string> varied_files();

}  // namespace geovor::test

/// Leaves a test whose data is absent: fails where CI=true, skips elsewhere.
#define SKIP_WITHOUT(path)                                                          \
  if ((path).empty()) {                                                             \
    if (std::getenv("CI") != nullptr && std::string(std::getenv("CI")) == "true") { \
      FAIL() << "the shared data is missing; set GEOVOR_SHARED";                    \
    }                                                                               \
    GTEST_SKIP() << "the shared data is missing; set GEOVOR_SHARED";                \
  }
