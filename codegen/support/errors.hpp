// SPDX-License-Identifier: GPL-3.0-or-later
// Exceptions cross the boundaries only: a verdict is a value, never thrown.
#pragma once

#include <stdexcept>
#include <string>

namespace regulus {

/// Bad input: a model file, an option, a C++ model. what() is "file:line: found F, expected E" for
/// a mistake of syntax, and "file:line: PROBLEM; REMEDY" for any other.
class InputError : public std::runtime_error {
 public:
  /// line 0 = not known or not a file. `symbol` is the name at fault, empty if none.
  InputError(const std::string& file, int line, const std::string& found,
             const std::string& expected, const std::string& symbol = {})
      : InputError(file, line, found, expected, symbol, Wording::kSyntax) {}

  /// Returns a mistake that is not one of syntax. found() is the problem, expected() the remedy.
  [[nodiscard]] static InputError statement(const std::string& file, int line,
                                            const std::string& problem, const std::string& remedy,
                                            const std::string& symbol = {}) {
    return {file, line, problem, remedy, symbol, Wording::kStatement};
  }

  /// Returns the same mistake at another place.
  [[nodiscard]] InputError at(const std::string& file, int line) const {
    return {file, line, found_, expected_, symbol_, wording_};
  }

  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] int line() const noexcept { return line_; }
  [[nodiscard]] const std::string& found() const noexcept { return found_; }
  [[nodiscard]] const std::string& expected() const noexcept { return expected_; }
  [[nodiscard]] const std::string& symbol() const noexcept { return symbol_; }

 private:
  enum class Wording { kSyntax, kStatement };

  InputError(const std::string& file, int line, const std::string& found,
             const std::string& expected, const std::string& symbol, Wording wording)
      : std::runtime_error(message(file, line, found, expected, wording)),
        file_(file),
        line_(line),
        found_(found),
        expected_(expected),
        symbol_(symbol),
        wording_(wording) {}

  static std::string message(const std::string& file, int line, const std::string& found,
                             const std::string& expected, Wording wording) {
    std::string text = file;
    if (!file.empty() && line > 0) text.append(":").append(std::to_string(line));
    if (!file.empty()) text.append(": ");
    if (wording == Wording::kStatement) return text.append(found).append("; ").append(expected);
    return text.append("found ").append(found).append(", expected ").append(expected);
  }

  std::string file_;
  int line_;
  std::string found_, expected_;
  std::string symbol_;
  Wording wording_;
};

/// A file that cannot be read or written (exit 74).
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A fault of the program itself (exit 70).
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// A mistake in a command line that only the model shows (an unknown motion, for example).
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The compiler refused a text, or its output cannot be loaded. The texts are generated, so this is
/// a fault of the generator or of the installation, never of a model file.
class CompileError : public std::runtime_error {
 public:
  CompileError(const std::string& what, std::string diagnostics, std::string text)
      : std::runtime_error(what), diagnostics_(std::move(diagnostics)), text_(std::move(text)) {}

  [[nodiscard]] const std::string& diagnostics() const noexcept { return diagnostics_; }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  std::string diagnostics_;
  std::string text_;
};

/// No compiler is available: it cannot be opened, or the system cannot start a process for it. The
/// text itself is not at fault.
class NoCompiler : public CompileError {
 public:
  explicit NoCompiler(const std::string& what) : CompileError(what, {}, {}) {}
};

/// A time limit or an interrupt ended the reading of a model: there is no question yet.
class ReadingStopped : public std::runtime_error {
 public:
  explicit ReadingStopped(bool interrupted)
      : std::runtime_error(interrupted ? "it was interrupted while the model was read"
                                       : "the time limit was reached while the model was read") {}
};

}  // namespace regulus
