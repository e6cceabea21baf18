// SPDX-License-Identifier: GPL-3.0-or-later
// gnuplot as a child process, without a shell. It receives commands through a socket and writes the
// picture to memory; a file has it when it is known to be whole.
#pragma once

#include <optional>
#include <string>

#include "codegen/support/subprocess.hpp"
#include "runtime/files/atomic_file.hpp"

namespace regulus::detail {

class Gnuplot {
 public:
  /// Makes the file of the picture and starts gnuplot, without the settings of the user. Throws
  /// FileError if either fails.
  explicit Gnuplot(const std::string& picture);
  ~Gnuplot();
  Gnuplot(const Gnuplot&) = delete;
  Gnuplot& operator=(const Gnuplot&) = delete;

  /// Sends the commands, waits for the end and writes the picture; `title` is the name of an SVG.
  /// Throws FileError, with gnuplot's message if gnuplot fails.
  void draw(const std::string& commands, const std::string& title);

  /// Returns an expression for a text: parts in single quotes, inside which nothing but the quote is
  /// special, and the variable of kQuoteCommand for each quote. Removes control characters; a
  /// space of no width parts the end of CDATA, into which gnuplot puts the texts of an SVG file.
  [[nodiscard]] static std::string quoted(const std::string& text);
  /// Comes before every quoted().
  static constexpr const char* kQuoteCommand = "quote = \"\\047\"\n";

 private:
  [[nodiscard]] bool send_all(const std::string& commands) const;
  [[nodiscard]] std::string complaint() const;
  void start();
  [[nodiscard]] std::string drawing() const;
  void close_all() noexcept;

  std::string picture_;
  AtomicFile file_;   ///< of the picture
  int input_ = -1;    ///< our end of its standard input
  int drawing_ = -1;  ///< a memory file for its standard output: it ignores a full disk
  int errors_ = -1;   ///< the same for its standard error
  std::optional<Subprocess> process_;
};

}  // namespace regulus::detail
