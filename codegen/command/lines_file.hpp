// SPDX-License-Identifier: GPL-3.0-or-later
// The file of the JSON lines of `regulus locate`.
#pragma once

#include <sys/stat.h>

#include <fstream>
#include <iostream>
#include <string>
#include <utility>

#include "codegen/command/command_line.hpp"

namespace regulus::inline command {

/// The output of the JSON lines: a file, standard output, or nothing.
class LinesFile {
 public:
  /// Throws UsageError and FileError.
  explicit LinesFile(const LocateCommand& command);

  [[nodiscard]] bool wanted() const { return !name_.empty(); }
  [[nodiscard]] bool is_standard_output() const { return name_ == "-"; }
  [[nodiscard]] std::string name() const {
    return is_standard_output() ? "standard output" : name_;
  }
  /// Throws    FileError if the file is no longer at its path.
  void require_in_place() const;
  [[nodiscard]] std::ostream& stream() { return is_standard_output() ? std::cout : file_; }

 private:
  /// Returns the identity of the file that has the name now.
  [[nodiscard]] std::pair<dev_t, ino_t> identity() const;

  std::string name_;
  std::ofstream file_;
  std::pair<dev_t, ino_t> opened_;
};

}  // namespace regulus::command
