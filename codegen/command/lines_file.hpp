// SPDX-License-Identifier: GPL-3.0-or-later
// The file of the JSON lines of `regulus locate`.
#pragma once

#include <iostream>
#include <optional>
#include <string>

#include "codegen/command/command_line.hpp"
#include "runtime/files/atomic_stream.hpp"

namespace regulus::inline command {

/// The output of the JSON lines: a file, which appears when it is complete, standard output, or
/// nothing.
class LinesFile {
 public:
  /// Throws UsageError and FileError.
  explicit LinesFile(const LocateCommand& command);

  [[nodiscard]] bool wanted() const { return !name_.empty(); }
  [[nodiscard]] bool is_standard_output() const { return name_ == "-"; }
  [[nodiscard]] std::string name() const {
    return is_standard_output() ? "standard output" : name_;
  }
  [[nodiscard]] std::ostream& stream() { return file_ ? *file_ : std::cout; }
  /// The lines are complete. Throws FileError, with the reason, if one could not be written.
  void finish();

 private:
  std::string name_;
  std::optional<AtomicStream> file_;
};

}  // namespace regulus::command
