// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coqc.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "runtime/files/atomic_file.hpp"
#include "runtime/formal/coq_audit.hpp"
#include "runtime/verifier/input_file.hpp"

namespace regulus::verifier {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostOutput = std::size_t{1} << 24;

double seconds_now() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

std::string temporary_name() {
  return (fs::temp_directory_path() / ("regulus-verify-" + std::to_string(getuid()))).string();
}

/// The environment without what names libraries of Coq. Those of the user are searched for in a
/// folder that has none.
std::vector<std::string> environment(const std::string& empty) {
  std::vector<std::string> variables = {"XDG_DATA_HOME=" + empty, "XDG_DATA_DIRS=" + empty,
                                        "XDG_CONFIG_HOME=" + empty};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text(*variable);
    if (!text.starts_with("COQ") && !text.starts_with("ROCQ") && !text.starts_with("OCAML") &&
        !text.starts_with("XDG_"))
      variables.emplace_back(text);
  }
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

/// Starts a program of PATH in a folder; the file `output` there gets all that it prints.
pid_t start(std::vector<std::string> words, const std::string& folder, const char* output) {
  std::vector<std::string> variables = environment(folder);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output, O_WRONLY | O_CREAT | O_TRUNC,
                                   0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = -1;
  const int error = posix_spawnp(&process, words.front().c_str(), &actions, nullptr,
                                 pointers(words).data(), pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT)
    throw std::runtime_error(
        "coqc is not installed, or not in PATH (Debian: the packages coq and libcoq-interval)");
  if (error != 0)
    throw std::runtime_error("coqc cannot be started: " + std::system_category().message(error));
  return process;
}

/// Returns true if the process ended with the exit code 0.
bool wait_for(pid_t process, double end) {
  int status = -1;
  for (;;) {
    const pid_t ended = waitpid(process, &status, end > 0 ? WNOHANG : 0);
    if (ended == process) return WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (ended < 0 && errno != EINTR) throw std::runtime_error("coqc cannot be waited for");
    if (end > 0 && seconds_now() > end) {
      kill(process, SIGKILL);
      waitpid(process, &status, 0);
      throw CoqTimeout("the time limit ended before Coq did");
    }
    if (ended == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

/// The library is installed in share, and lies elsewhere where it is built.
std::vector<fs::path> folders_beside_the_program() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {};
  const fs::path prefix = program.parent_path().parent_path();
  return {prefix / "share/regulus/formal", prefix / "runtime/formal"};
}

}  // namespace

std::string find_coq_library(const std::string& named) {
  const auto has = [](const fs::path& folder, const char* file) {
    std::error_code error;
    return fs::is_regular_file(folder / file, error);
  };
  std::vector<fs::path> folders = folders_beside_the_program();
  if (const char* variable = std::getenv("REGULUS_FORMAL");
      variable != nullptr && *variable != '\0')
    folders = {variable};
  if (!named.empty()) folders = {named};
  for (const fs::path& folder : folders)
    if (has(folder, "Notations.vo") && has(folder, "Legs.vo")) return fs::absolute(folder).string();
  for (const fs::path& folder : folders)
    if (has(folder, "Notations.v"))
      throw std::runtime_error(
          "the library of theorems in " + folder.string() +
          " is not compiled: copy it to a folder where you may write, run there 'coq_makefile -f "
          "_CoqProject -o Makefile && make' (Debian: the packages coq and libcoq-interval), and "
          "name "
          "the folder by --library");
  throw std::runtime_error((named.empty() ? "there is no library of theorems beside this program"
                                          : "there is no library of theorems in " + named) +
                           "; --library FOLDER names the folder of its compiled files (FORMAL.md)");
}

Coqc::Coqc(std::string library, double time_limit)
    : library_(std::move(library)),
      end_(time_limit > 0 && time_limit < 1e9 ? seconds_now() + time_limit : 0),
      folder_(temporary_name(), 0700) {}

Coqc::Answer Coqc::compile(const std::string& name, const std::string& text) {
  const std::string folder = fs::absolute(folder_.path()).string();
  detail::AtomicFile file(folder + '/' + name + ".v");
  file.write(text);
  file.put_in_place();
  const std::string output = name + ".out";
  const pid_t process = start({"coqc", "-q", "-w", "none", "-Q", library_, "Regulus", "-Q", folder,
                               kAuditedFolder, name + ".v"},
                              folder, output.c_str());
  Answer answer;
  answer.is_accepted = wait_for(process, end_);
  answer.text = read_text(folder + '/' + output, kMostOutput);
  return answer;
}

}  // namespace regulus::verifier
