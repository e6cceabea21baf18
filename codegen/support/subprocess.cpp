// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/subprocess.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace regulus::detail {
namespace {

class Redirections {
 public:
  explicit Redirections(const StandardStreams& streams) {
    posix_spawn_file_actions_init(&actions_);
    redirect(STDIN_FILENO, streams.input);
    redirect(STDOUT_FILENO, streams.output);
    redirect(STDERR_FILENO, streams.errors);
  }
  Redirections(const Redirections&) = delete;
  Redirections& operator=(const Redirections&) = delete;
  ~Redirections() { posix_spawn_file_actions_destroy(&actions_); }

  [[nodiscard]] const posix_spawn_file_actions_t* get() const noexcept { return &actions_; }

 private:
  void redirect(int stream, int to) {
    if (to >= 0) posix_spawn_file_actions_adddup2(&actions_, to, stream);
  }

  posix_spawn_file_actions_t actions_{};
};

}  // namespace

Subprocess::Subprocess(const std::vector<std::string>& words, const StandardStreams& streams) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int error = posix_spawnp(&process_, arguments[0], Redirections(streams).get(), nullptr,
                                 arguments.data(), environ);
  if (error != 0) {
    process_ = -1;
    throw std::system_error(error, std::generic_category(), words.front());
  }
}

Subprocess::~Subprocess() { wait(); }

int Subprocess::wait() noexcept {
  int status = -1;
  while (process_ > 0) {
    if (waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    process_ = -1;
  }
  return exit_code_;
}

}  // namespace regulus::detail
