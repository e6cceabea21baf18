// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/mpi/together.hpp"

#include <csignal>
#include <cstdio>

namespace regulus::detail {

void unblock_signals() {
  sigset_t none;
  sigemptyset(&none);
  pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

std::vector<std::optional<std::string>> gather_parts(Communicator& communicator,
                                                     const std::string& own, double limit) {
  double named = 0;
  return communicator.gather(own, [&](const std::vector<unsigned>& ranks, double seconds) {
    if (limit > 0 && seconds >= limit + kSecondsOfPatience) return true;
    if (seconds - named < kSecondsOfPatience) return false;
    named = seconds;
    std::fprintf(stderr, "regulus-mpi: %s yet\n", describe_silent(ranks).c_str());
    return false;
  });
}

}  // namespace regulus::detail
