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

void set_aside(const OutputFile& output) {
  std::error_code error;
  const fs::file_status status = fs::status(output.path, error);
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
