// Sites from a CSV file.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace geovor {

/// One site as the file gives it.
struct SiteRow {
  int line = 0;                    ///< of the file, from 1
  std::array<double, 3> values{};  ///< u, v, 0 or x, y, z
};

struct SitesFile {
  bool in_space = false;  ///< the header was x,y,z and not u,v
  std::vector<SiteRow> rows;
};

/// Reads a CSV file with the header `u,v` or `x,y,z`, in any case, with or without a byte-order mark; `#` starts a
/// comment, empty lines don't count. Throws Error(Usage) that names the line.
SitesFile read_sites_file(const std::string& path);

}  // namespace geovor
