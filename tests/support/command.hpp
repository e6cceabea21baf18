// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the command, or another program, as a person does, with arguments, but without a terminal.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace regulus::detail::test {

inline const std::string kCommand = REGULUS_BINARY_DIR "/bin/regulus";
inline const std::string kVerify = REGULUS_BINARY_DIR "/bin/regulus-verify";

inline const std::string kModels = REGULUS_SOURCE_DIR "/models/";
inline std::string model_path(const std::string& name) { return kModels + name + ".toml"; }
inline const std::string kRobot1 = model_path("robot_1");
inline const std::string kPlanar = model_path("planar_3rpr");

using Words = std::vector<std::string>;

struct CommandResult {
  int exit_code = -1;  ///< −1: a signal ended it
  std::string output;  ///< standard output
  std::string errors;  ///< standard error
};

/// A program that has been started and not yet waited for.
class RunningCommand {
 public:
  explicit RunningCommand(const std::vector<std::string>& words) {
    std::array<int, 2> out{}, err{};
    if (pipe2(out.data(), O_CLOEXEC) != 0 || pipe2(err.data(), O_CLOEXEC) != 0)
      throw std::runtime_error("no pipe");
    pid_ = fork();
    if (pid_ == 0) become(words, out[1], err[1]);
    close(out[1]);
    close(err[1]);
    out_ = out[0];
    err_ = err[0];
  }
  RunningCommand(const RunningCommand&) = delete;
  RunningCommand& operator=(const RunningCommand&) = delete;

  [[nodiscard]] pid_t pid() const noexcept { return pid_; }

  /// Waits until the program handles the signal or waits for it, or has ended.
  void wait_for_handler(int signal) const {
    siginfo_t end{};
    while (!catches(signal) &&
           ::waitid(P_PID, id_t(pid_), &end, WEXITED | WNOHANG | WNOWAIT) == 0 && end.si_pid == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  /// Reads to the end. Standard error is read first: it must hold what fits into a pipe.
  [[nodiscard]] CommandResult wait() {
    CommandResult result;
    result.output = drain(out_);
    result.errors = drain(err_);
    int status = 0;
    waitpid(pid_, &status, 0);
    if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
    return result;
  }

 private:
  [[noreturn]] static void become(const std::vector<std::string>& words, int out, int err) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }

  /// Reads the masks of blocked and of handled signals that the kernel shows. Before the child is the
  /// program, the C library may block all signals.
  [[nodiscard]] bool catches(int signal) const {
    std::error_code none;
    if (std::filesystem::read_symlink("/proc/" + std::to_string(pid_) + "/exe", none) ==
        std::filesystem::read_symlink("/proc/self/exe", none))
      return false;
    std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
    for (std::string line; std::getline(status, line);)
      if ((line.starts_with("SigCgt:") || line.starts_with("SigBlk:")) &&
          (std::stoull(line.substr(7), nullptr, 16) >> unsigned(signal - 1) & 1U) != 0)
        return true;
    return false;
  }

  static std::string drain(int descriptor) {
    std::string text;
    std::array<char, 4096> buffer{};
    for (ssize_t n; (n = read(descriptor, buffer.data(), buffer.size())) > 0;)
      text.append(buffer.data(), std::size_t(n));
    close(descriptor);
    return text;
  }

  pid_t pid_ = -1;
  int out_ = -1, err_ = -1;
};

[[nodiscard]] inline CommandResult run_command(const std::vector<std::string>& words) {
  return RunningCommand(words).wait();
}

/// Runs `regulus` with these words, and then `more`.
inline CommandResult regulus(Words words, const Words& more = {}) {
  words.insert(words.begin(), kCommand);
  words.insert(words.end(), more.begin(), more.end());
  return run_command(words);
}

}  // namespace regulus::detail::test
