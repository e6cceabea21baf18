// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/lines_file.hpp"

#include <system_error>

#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

template <class Step>
void with_reason(const std::string& name, Step step) {
  try {
    step();
  } catch (const std::system_error& error) {
    throw FileError(name + " cannot " + error.what());
  }
}

}  // namespace

LinesFile::LinesFile(const LinesRequest& request) : request_(request) {
  if (request_.stream == nullptr && !request_.file.empty())
    with_reason(request_.file, [&] { file_.emplace(request_.file); });
}

void LinesFile::finish() {
  if (file_) return with_reason(name(), [&] { file_->put_in_place(); });
  if (is_wanted() && !stream().flush()) throw FileError("cannot write " + name());
}

}  // namespace regulus::detail
