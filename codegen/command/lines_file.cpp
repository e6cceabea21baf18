// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/command/lines_file.hpp"

#include "codegen/support/errors.hpp"

namespace regulus::inline command {
namespace {

std::string chosen(const LocateCommand& command) {
  const bool print = command.boxes_unless_json && !command.output.json;
  return command.lines.empty() && print ? std::string("-") : command.lines;
}

}  // namespace

LinesFile::LinesFile(const LocateCommand& command) : name_(chosen(command)) {
  if (name_ == "-" && command.output.json)
    throw UsageError("--json and --output - both write to standard output; use one of them");
  if (name_.empty() || name_ == "-") return;
  file_.open(name_);
  if (!file_) throw FileError("cannot write " + name_);
  opened_ = identity();
}

void LinesFile::require_in_place() const {
  const std::pair<dev_t, ino_t> none;
  if (wanted() && !is_standard_output() && (opened_ == none || identity() != opened_))
    throw FileError(name_ + " was removed during the run");
}

std::pair<dev_t, ino_t> LinesFile::identity() const {
  struct stat status {};
  return ::stat(name_.c_str(), &status) == 0 ? std::pair(status.st_dev, status.st_ino)
                                             : std::pair<dev_t, ino_t>();
}

}  // namespace regulus::command
