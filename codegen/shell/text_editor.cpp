// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/shell/text_editor.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "codegen/support/errors.hpp"

namespace regulus::inline shell {
namespace {

/// A file only for its owner, with the extension that editors know for model files.
class DraftFile {
 public:
  explicit DraftFile(const std::string& text) {
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    path_ = ((error ? "/tmp" : folder) / "regulus-XXXXXX.toml").string();
    const int file = mkstemps(path_.data(), 5);
    if (file < 0) throw FileError("cannot write " + path_);
    close(file);
    std::ofstream stream(path_, std::ios::binary);
    stream << text;
    if (!stream.flush()) throw FileError("cannot write " + path_);
  }
  ~DraftFile() { unlink(path_.c_str()); }
  DraftFile(const DraftFile&) = delete;
  DraftFile& operator=(const DraftFile&) = delete;

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] std::string text() const {
    std::ifstream stream(path_, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) throw FileError("cannot read " + path_);
    return text;
  }

 private:
  std::string path_;
};

std::string editor() {
  for (const char* variable : {"VISUAL", "EDITOR"})
    if (const char* named = std::getenv(variable); named && *named) return named;
  return "vi";
}

/// The variables may contain options, so the shell splits them.
int run_editor(std::string path) {
  std::string shell = "/bin/sh", option = "-c", name = "sh";
  std::string command = editor() + " \"$1\"";
  char* const arguments[] = {shell.data(), option.data(), command.data(),
                             name.data(),  path.data(),   nullptr};
  pid_t child = 0;
  if (posix_spawn(&child, shell.c_str(), nullptr, nullptr, arguments, environ) != 0) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::string edited(const std::string& text) {
  const DraftFile draft(text);
  if (run_editor(draft.path()) != 0)
    throw FileError(
        "the editor failed, and the model is unchanged (set EDITOR to use another editor)");
  return draft.text();
}

}  // namespace regulus::shell
