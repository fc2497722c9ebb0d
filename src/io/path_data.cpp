#include "io/path_data.h"

#include <cmath>
#include <cstdlib>

namespace geovor {
namespace {

long tenths(double x) { return std::lround(10.0 * x); }

}  // namespace

// A minus sign parts two numbers as well as a blank does, and a zero before the point need not be written.
void PathData::append(long tenths) {
  const bool after_number = !text_.empty() && (text_.back() == '.' || (text_.back() >= '0' && text_.back() <= '9'));
  if (tenths < 0) {
    text_ += '-';
  } else if (after_number) {
    text_ += ' ';
  }
  const long whole = std::labs(tenths) / 10, part = std::labs(tenths) % 10;
  if (whole > 0 || part == 0) text_ += std::to_string(whole);
  if (part > 0) {
    text_ += '.';
    text_ += static_cast<char>('0' + part);
  }
}

void PathData::move(const PagePoint& to) {
  x_ = start_x_ = tenths(to.x), y_ = start_y_ = tenths(to.y);
  text_ += command_ = 'M';
  append(x_);
  append(y_);
}

void PathData::line(const PagePoint& to) {
  const long dx = tenths(to.x) - x_, dy = tenths(to.y) - y_;
  if (dx == 0 && dy == 0) return;
  const char command = dy == 0 ? 'h' : dx == 0 ? 'v' : 'l';
  if (command != command_) text_ += command_ = command;
  if (dx != 0) append(dx);
  if (dy != 0) append(dy);
  x_ += dx, y_ += dy;
}

void PathData::close() {
  text_ += command_ = 'z';
  x_ = start_x_, y_ = start_y_;
}

}  // namespace geovor
