// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/command/lines_file.hpp"

#include <system_error>

#include "codegen/support/errors.hpp"

namespace regulus::inline command {
namespace {

std::string chosen(const LocateCommand& command) {
  const bool print = command.boxes_unless_json && !command.output.json;
  return command.lines.empty() && print ? std::string("-") : command.lines;
}

template <class Step>
void with_reason(const std::string& name, Step step) {
  try {
    step();
  } catch (const std::system_error& error) {
    throw FileError(name + " cannot " + error.what());
  }
}

}  // namespace

LinesFile::LinesFile(const LocateCommand& command) : name_(chosen(command)) {
  if (name_ == "-" && command.output.json)
    throw UsageError("--json and --output - both write to standard output; use one of them");
  if (name_.empty() || name_ == "-") return;
  with_reason(name_, [&] { file_.emplace(name_); });
}

void LinesFile::finish() {
  if (file_) return with_reason(name_, [&] { file_->put_in_place(); });
  if (wanted() && !stream().flush()) throw FileError("cannot write " + name());
}

}  // namespace regulus::command
