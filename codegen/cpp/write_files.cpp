// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/cpp/write_files.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "codegen/support/errors.hpp"

namespace regulus::inline cpp {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw FileError(path.string() + " cannot be written: " + reason);
}

/// A file under a temporary name until it is put in place; removed if it never is.
class WaitingFile {
 public:
  WaitingFile(fs::path path, const std::string& text)
      : path_(std::move(path)), waiting_(path_.string() + ".part" + std::to_string(::getpid())) {
    errno = 0;
    std::ofstream out(waiting_, std::ios::binary);
    out << text;
    out.close();
    if (out) return;
    const int error = errno;
    remove();
    fail(path_, error != 0 ? std::strerror(error) : "the file system refuses it");
  }
  WaitingFile(WaitingFile&& other) noexcept
      : path_(std::move(other.path_)), waiting_(std::exchange(other.waiting_, fs::path())) {}
  WaitingFile(const WaitingFile&) = delete;
  WaitingFile& operator=(const WaitingFile&) = delete;
  WaitingFile& operator=(WaitingFile&&) = delete;
  ~WaitingFile() { remove(); }

  void put_in_place() {
    std::error_code error;
    fs::rename(waiting_, path_, error);
    if (error) fail(path_, error.message());
    waiting_.clear();
  }

 private:
  void remove() noexcept {
    std::error_code ignored;
    if (!waiting_.empty()) fs::remove(waiting_, ignored);
  }

  fs::path path_;
  fs::path waiting_;
};

/// Escapes a path for a rule of a makefile.
std::string escaped(const std::string& path) {
  std::string text;
  for (const char c : path) {
    if (c == ' ' || c == '#') text += '\\';
    if (c == '$') text += '$';
    text += c;
  }
  return text;
}

}  // namespace

void write_files(const fs::path& folder, const std::vector<GeneratedFile>& files) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(folder, error.message());
  std::vector<WaitingFile> waiting;
  for (const GeneratedFile& file : files) {
    if (fs::is_directory(folder / file.name)) fail(folder / file.name, "there is a folder");
    waiting.emplace_back(folder / file.name, file.text);
  }
  for (WaitingFile& file : waiting) file.put_in_place();
}

void write_file(const fs::path& path, const std::string& text) {
  WaitingFile(path, text).put_in_place();
}

std::string dependency_text(const fs::path& folder, const std::vector<GeneratedFile>& files,
                            const std::string& input) {
  std::string text;
  for (const GeneratedFile& file : files) {
    if (!text.empty()) text += ' ';
    text += escaped((folder / file.name).string());
  }
  return text + ": " + escaped(input) + "\n";
}

}  // namespace regulus::cpp
