// geovor: the command line around the library. Parses, runs one command, and turns every failure into one line on
// stderr and an exit code.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "base/error.h"
#include "commands.h"
#include "interrupt.h"
#include "options.h"

namespace {

int fail(geovor::ErrorCode code, std::string message) {
  // One line, whatever a file name or a library's message holds.
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  std::replace_if(message.begin(), message.end(), is_control, ' ');
  fmt::print(stderr, "geovor: {}\n", message);
  return static_cast<int>(code);
}

int run(int argc, char** argv) {
  const geovor::CommandLine arguments = geovor::parse_command_line(argc, argv);
  geovor::end_cleanly_on_interrupt();
  const int code = std::visit([](const auto& wanted) { return geovor::run(wanted); }, arguments);
  if (std::fflush(stdout) != 0) {
    throw geovor::Error(geovor::ErrorCode::Unwritable, "standard output can't be written to; free some space");
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const geovor::Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(geovor::ErrorCode::Internal, "the memory did not suffice; ask for larger triangles or fewer faces");
  } catch (const std::exception& error) {
    return fail(geovor::ErrorCode::Internal, fmt::format("a fault of geovor ({}); please report it", error.what()));
  } catch (...) {
    return fail(geovor::ErrorCode::Internal, "a fault of geovor; please report it");
  }
}
