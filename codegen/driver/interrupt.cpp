// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/interrupt.hpp"

#include <pthread.h>
#include <unistd.h>

namespace regulus::codegen {
namespace {

// SIGUSR1 is how the destructor wakes the watcher.
sigset_t watched_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (int signal : {SIGINT, SIGTERM, SIGUSR1}) sigaddset(&set, signal);
  return set;
}

constexpr int kExitInterruptedTwice = 130;

}  // namespace

InterruptGuard::InterruptGuard() {
  const sigset_t set = watched_signals();
  pthread_sigmask(SIG_BLOCK, &set, &previous_);
  watcher_ = std::thread([this] { wait_for_signals(); });
}

InterruptGuard::~InterruptGuard() {
  ending_ = true;
  pthread_kill(watcher_.native_handle(), SIGUSR1);
  watcher_.join();
  pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

void InterruptGuard::wait_for_signals() {
  const sigset_t set = watched_signals();
  while (!ending_) {
    int signal = 0;
    if (sigwait(&set, &signal) != 0 || signal == SIGUSR1) continue;
    if (requested_.exchange(true)) _exit(kExitInterruptedTwice);
  }
}

}  // namespace regulus::codegen
