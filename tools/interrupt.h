// Ctrl-C and the request to end: stop soon, and leave nothing behind.
#pragma once

namespace geovor {

/// The program's exit code after Ctrl-C or SIGTERM: 128 + SIGINT, as shells have it.
constexpr int kInterruptedExit = 130;

/// From now on SIGINT and SIGTERM end the program at once, whatever the other threads do, with every output that is
/// staged but not committed removed (see outputs.h). To be called before any other thread starts.
void end_cleanly_on_interrupt();

}  // namespace geovor
