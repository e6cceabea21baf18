// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/measure/process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

#include "tests/bench/measure/clocks.hpp"

namespace regulus::detail::bench {
namespace {

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  for (std::string& word : words) result.push_back(word.data());
  result.push_back(nullptr);
  return result;
}

/// Puts later assignments first, since the C library takes the first one of a name.
std::vector<std::string> merged(const std::vector<std::string>& environment) {
  std::vector<std::string> result(environment.rbegin(), environment.rend());
  for (char** own = environ; *own; ++own) {
    const std::string assignment = *own;
    const std::string name = assignment.substr(0, assignment.find('=') + 1);
    bool replaced = false;
    for (const std::string& other : environment) replaced |= other.starts_with(name);
    if (!replaced) result.push_back(assignment);
  }
  return result;
}

std::string drain(int descriptor) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t n; (n = read(descriptor, buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), static_cast<std::size_t>(n));
  return text;
}

}  // namespace

ProcessRun run_process(const std::vector<std::string>& command,
                       const std::vector<std::string>& environment) {
  std::vector<std::string> words = command, variables = merged(environment);
  std::array<int, 2> pipe{};
  if (pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDERR_FILENO);

  ProcessRun run;
  const double start = wall_seconds();
  pid_t child = 0;
  const int refused = posix_spawnp(&child, words[0].c_str(), &actions, nullptr,
                                   pointers(words).data(), pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  close(pipe[1]);
  run.output = drain(pipe[0]);
  close(pipe[0]);
  if (refused != 0) return run;
  int status = 0;
  waitpid(child, &status, 0);
  run.wall_seconds = wall_seconds() - start;
  if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
  return run;
}

}  // namespace regulus::detail::bench
