// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/interrupt.hpp"

#include <pthread.h>
#include <time.h>
#include <unistd.h>

#include <iostream>

namespace regulus::detail {
namespace {

bool is_ignored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

// The destructor wakes the watcher by SIGUSR1. An ignored signal would be received, too, if it were
// blocked.
sigset_t watched_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (int signal : {SIGINT, SIGTERM, SIGUSR1}) sigaddset(&set, signal);
  if (!is_ignored(SIGHUP)) sigaddset(&set, SIGHUP);
  return set;
}

constexpr int kExitOnSignal = 128;  // as in a shell

constexpr int kPatience = 60;  // steps of 50 ms

bool is_handled(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_DFL;
}

}  // namespace

InterruptGuard::InterruptGuard() : watched_(watched_signals()) {
  pthread_sigmask(SIG_BLOCK, &watched_, &previous_);
  watcher_ = std::thread([this] { wait_for_signals(); });
}

InterruptGuard::~InterruptGuard() {
  std::cout.flush();  // an answer is safe before a signal may end the process again
  ending_ = true;
  pthread_kill(watcher_.native_handle(), SIGUSR1);
  watcher_.join();
  pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

/// True if a search begins within a few seconds and no other signal comes first.
bool InterruptGuard::search_begins() const {
  const timespec step{0, 50'000'000};
  for (int steps = 0; steps < kPatience; ++steps) {
    if (searching_ || ending_) return true;
    const int signal = sigtimedwait(&watched_, nullptr, &step);
    if (signal == SIGINT || signal == SIGTERM) return false;
  }
  return false;
}

void InterruptGuard::wait_for_signals() {
  while (!ending_) {
    int signal = 0;
    if (sigwait(&watched_, &signal) != 0 || signal == SIGUSR1) continue;
    if (signal == SIGHUP && requested_) continue;
    if (requested_.exchange(true) || (!is_handled(signal) && !search_begins()))
      _exit(kExitOnSignal + signal);
  }
}

}  // namespace regulus::detail
