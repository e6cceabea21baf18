// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/write_files.hpp"

#include <system_error>

#include "codegen/support/errors.hpp"
#include "codegen/support/visible_text.hpp"
#include "runtime/files/atomic_file.hpp"

namespace regulus::detail {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw FileError(path.string() + " cannot be written: " + reason);
}

/// Calls `write`, with the file's name in its errors.
template <class Write>
auto name_in_errors(const fs::path& path, Write write) {
  try {
    return write();
  } catch (const std::system_error& error) {
    fail(path, error.code().message());
  }
}

AtomicFile written_beside(const fs::path& path, const std::string& text) {
  return name_in_errors(path, [&] {
    AtomicFile file(path.string());
    file.write(text);
    return file;
  });
}

/// Escapes a path for a rule of a makefile.
std::string escaped(const std::string& path) {
  if (path.find('\n') != std::string::npos)
    throw FileError("--depfile: a rule cannot name a file whose path has a line break; rename " +
                    visible(path));
  std::string text;
  for (const char c : path) {
    if (c == ' ' || c == '#') text += '\\';
    if (c == '$') text += '$';
    text += c;
  }
  return text;
}

}  // namespace

void require_room_in(const fs::path& folder) {
  fs::path there = fs::absolute(folder);
  while (!fs::exists(there) && there.has_relative_path()) there = there.parent_path();
  name_in_errors(folder,
                 [&] { const AtomicFile probe((there / "regulus").string(), 0600, AT_FDCWD); });
}

void write_files(const fs::path& folder, const std::vector<GeneratedFile>& files) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(folder, error.message());
  std::vector<AtomicFile> waiting;
  for (const GeneratedFile& file : files) {
    if (fs::is_directory(folder / file.name)) fail(folder / file.name, "there is a folder");
    waiting.push_back(written_beside(folder / file.name, file.text));
  }
  for (std::size_t i = 0; i < files.size(); ++i)
    name_in_errors(folder / files[i].name, [&] { waiting[i].put_in_place(); });
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

}  // namespace regulus::detail
