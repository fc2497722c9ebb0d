// Reading a file that is not there is an Error that says so.
#include <cstdio>

#include "base/error.h"
#include "occ_adapter/read_cad.h"

int main() {
  try {
    geovor::read_cad("missing.step");
  } catch (const geovor::Error& error) {
    std::puts(error.what());
    return error.code() == geovor::ErrorCode::Unreadable ? 0 : 1;
  }
  return 1;
}
