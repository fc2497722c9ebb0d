#include "interrupt.h"

#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <thread>

#include "outputs.h"

namespace geovor {
namespace {

/// A shell starts background jobs with SIGINT ignored; that wish is kept.
bool is_ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void wait_and_end(sigset_t signals) {
  int signal = 0;
  if (sigwait(&signals, &signal) != 0) return;
  remove_staged_outputs();
  // A terminal has the progress line or ^C before it.
  std::fputs(isatty(STDERR_FILENO) != 0 ? "\ngeovor: interrupted\n" : "geovor: interrupted\n", stderr);
  _exit(kInterruptedExit);
}

}  // namespace

void end_cleanly_on_interrupt() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM}) {
    if (!is_ignored(signal)) sigaddset(&signals, signal);
  }
  // Blocked here and so in all threads to come: only the thread below receives them, and in it ordinary code may run,
  // which a signal handler may not.
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread(wait_and_end, signals).detach();
}

}  // namespace geovor
