// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a command and prints its peak memory in kB. This is a program of its own, because a process
// starts with the peak of the one that started it (Linux keeps ru_maxrss over exec).
//
//     bench_peak_memory COMMAND ARGUMENT…
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc < 2) return 64;
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    // The output of the command is not needed.
    if (!std::freopen("/dev/null", "w", stdout) || !std::freopen("/dev/null", "w", stderr))
      _exit(127);
    execv(argv[1], argv + 1);
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) != child) return 70;
  std::printf("%ld\n", usage.ru_maxrss);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 70;
}
