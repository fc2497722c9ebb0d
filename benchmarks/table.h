// Text tables: a heading, columns as wide as their longest cell, the first one left-aligned, the others right-aligned.
#pragma once

#include <string>
#include <vector>

namespace geovor::bench {

using Row = std::vector<std::string>;

/// Prints to stdout; the first row holds the names of the columns.
void print_table(const std::string& heading, const std::vector<Row>& rows);

/// A number with so many digits after the point.
std::string digits(double x, int after_point);

}  // namespace geovor::bench
