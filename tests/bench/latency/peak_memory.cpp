// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a command and prints the most memory that it had at once, in kB. A program of its own: a
// process starts with the peak of the one that started it (Linux carries ru_maxrss over exec).
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
    // What the command prints is not asked for.
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
