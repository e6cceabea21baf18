// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/earlier_outputs.hpp"

#include <filesystem>
#include <map>
#include <system_error>

#include "codegen/support/errors.hpp"
#include "runtime/files/atomic_file.hpp"
#include "runtime/files/temporary.hpp"

namespace regulus::detail {
namespace {

namespace fs = std::filesystem;

/// Returns every name that the run, or an earlier one, gives to a file or a folder of this output.
std::vector<std::string> names_of(const OutputFile& output) {
  const std::string& path = output.path;
  if (output.continues) return {path, path + ".lock"};
  const std::string old = path + kEarlierEnding;
  std::vector<std::string> names = {path, old};
  if (!output.parts_ending.empty())
    names.insert(names.end(), {path + output.parts_ending, old + output.parts_ending});
  return names;
}

std::string canonical(const std::string& path) {
  std::error_code none;
  return fs::weakly_canonical(fs::absolute(path, none), none).string();
}

/// Links to it are the same file.
void require_no_input(const std::vector<std::string>& inputs, const OutputFile& output) {
  std::error_code none;
  for (const std::string& name : names_of(output))
    for (const std::string& input : inputs)
      if (!input.empty() &&
          (fs::equivalent(input, name, none) || canonical(input) == canonical(name)))
        throw UsageError(output.option + ": this run reads " + name +
                         "; name another file to write");
}

/// `taken`: the names of other outputs, with their options; those of this one are added.
void require_own_names(const OutputFile& output, std::map<std::string, std::string>& taken) {
  for (const std::string& name : names_of(output))
    if (const auto other = taken.find(canonical(name)); other != taken.end())
      throw UsageError(other->second + " and " + output.option + ": both would write " + name +
                       "; name two files");
  for (const std::string& name : names_of(output)) taken.emplace(canonical(name), output.option);
}

/// Returns those that are files; a device may have any number of outputs.
std::vector<OutputFile> files_of(const std::vector<OutputFile>& outputs) {
  std::vector<OutputFile> files;
  for (const OutputFile& output : outputs)
    if (!output.path.empty() && (output.must_be_file || !is_stream(output.path)))
      files.push_back(output);
  return files;
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

/// Files that a run goes on with are read by who knows them.
void require_file(const OutputFile& output) {
  std::error_code error;
  const fs::file_status status = fs::status(output.path, error);
  if (!fs::exists(status) || output.continues) return;
  if (is_stream(output.path) || !fs::is_regular_file(status))
    throw FileError(output.option + ": " + output.path +
                    " is not a regular file; name another file to write");
}

/// A file is made there and removed: only this shows that one can be made. One that exists is renamed
/// first, a link to one, too; a link to none is followed.
void require_room(const OutputFile& output) try {
  const std::string& path = output.path;
  if (fs::exists(path))
    const AtomicFile beside(path, 0600, AT_FDCWD);
  else
    const AtomicFile new_one(path);
} catch (const std::system_error& error) {
  const std::string folder = fs::path(output.path).parent_path().string();
  std::string why = error.code().message() + "; name another file";
  if (std::error_code none; !folder.empty() && !fs::exists(folder, none))
    why = "there is no folder " + folder + "; make it, or name a file in another one";
  throw FileError(output.option + ": " + output.path + " cannot be created: " + why);
}

/// Moves or removes the parts of an earlier file, before that file is moved.
void set_parts_aside(const OutputFile& output, bool file_exists) {
  const std::string folder = output.path + output.parts_ending;
  const std::string old = output.path + kEarlierEnding + output.parts_ending;
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
  const std::string old = output.path + kEarlierEnding;
  fs::rename(output.path, old, error);
  if (error)
    throw FileError(output.option + ": the earlier file " + output.path + " cannot be renamed to " +
                    old + ": " + error.message());
}

}  // namespace

void set_earlier_outputs_aside(const std::vector<std::string>& inputs,
                               const std::vector<OutputFile>& outputs) {
  const std::vector<OutputFile> files = files_of(outputs);
  std::map<std::string, std::string> taken;
  for (const OutputFile& output : files) {
    require_no_input(inputs, output);
    require_own_names(output, taken);
    require_file(output);
    require_room(output);
  }
  for (const OutputFile& output : files)
    if (!output.continues) set_aside(output);
}

}  // namespace regulus::detail
