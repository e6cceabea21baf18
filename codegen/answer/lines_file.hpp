// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <ostream>
#include <string>

#include "codegen/answer/services.hpp"
#include "runtime/files/atomic_stream.hpp"

namespace regulus::detail {

/// The output of the JSON lines of a paving: a file, which appears when it is complete, a stream, or
/// nothing.
class LinesFile {
 public:
  /// Throws FileError.
  explicit LinesFile(const LinesRequest& request);

  [[nodiscard]] bool is_wanted() const noexcept { return request_.is_wanted(); }
  [[nodiscard]] const std::string& name() const noexcept {
    return request_.stream != nullptr ? request_.name_of_stream : request_.file;
  }
  /// Requires  is_wanted().
  [[nodiscard]] std::ostream& stream() { return file_ ? *file_ : *request_.stream; }
  /// The lines are complete. Throws FileError, with the reason, if one could not be written.
  void finish();

 private:
  LinesRequest request_;
  std::optional<AtomicStream> file_;
};

}  // namespace regulus::detail
