// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/earlier_outputs.hpp"

#include <filesystem>
#include <system_error>

#include "codegen/support/errors.hpp"

namespace regulus::inline support {
namespace {

namespace fs = std::filesystem;

void require_other_file(const std::string& model, const OutputFile& output) {
  std::error_code none;
  if (!model.empty() && fs::equivalent(model, output.path, none))
    throw UsageError(output.option + ": " + output.path +
                     " is the model file; name another file to write");
}

[[noreturn]] void fail(const OutputFile& output, const std::string& folder,
                       const std::string& why) {
  throw FileError(output.option + ": the earlier folder " + folder + ' ' + why);
}

/// Removes numbered files alone, so that no file of the user is lost.
void remove_parts(const OutputFile& output, const std::string& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos)
      fail(output, folder, "has the file " + name + ", which is no part of a proof; move it");
    fs::remove(entry.path(), error);
  }
  if (!fs::remove(folder, error) && error)
    fail(output, folder, "cannot be removed: " + error.message());
}

/// Moves or removes the parts of an earlier file, before that file is moved.
void set_parts_aside(const OutputFile& output, bool file_exists) {
  const std::string folder = output.path + output.parts_ending;
  const std::string old = output.path + ".old" + output.parts_ending;
  if (!file_exists) return remove_parts(output, folder);
  remove_parts(output, old);
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  fs::rename(folder, old, error);
  if (error) fail(output, folder, "cannot be renamed to " + old + ": " + error.message());
}

void set_aside(const OutputFile& output) {
  std::error_code error;
  const fs::file_status status = fs::status(output.path, error);
  if (!output.parts_ending.empty()) set_parts_aside(output, fs::is_regular_file(status));
  if (!fs::exists(status)) return;
  if (!fs::is_regular_file(status)) {
    if (output.must_be_file)
      throw FileError(output.option + ": " + output.path +
                      " is not a regular file; name another file to write");
    return;
  }
  fs::rename(output.path, output.path + ".old", error);
  if (error)
    throw FileError(output.option + ": the earlier file " + output.path + " cannot be renamed to " +
                    output.path + ".old: " + error.message());
}

}  // namespace

void set_earlier_outputs_aside(const std::string& model, const std::vector<OutputFile>& outputs) {
  for (const OutputFile& output : outputs)
    if (!output.path.empty()) require_other_file(model, output);
  for (const OutputFile& output : outputs)
    if (!output.path.empty()) set_aside(output);
}

}  // namespace regulus::support
