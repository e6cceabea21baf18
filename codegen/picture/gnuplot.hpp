// SPDX-License-Identifier: GPL-3.0-or-later
// gnuplot as a child process, without a shell. It receives commands through a socket and writes the
// picture to a file that we open.
#pragma once

#include <optional>
#include <string>

#include "codegen/support/subprocess.hpp"

namespace regulus::inline picture {

class Gnuplot {
 public:
  /// Opens the picture and starts gnuplot. Throws FileError if either fails.
  explicit Gnuplot(const std::string& picture);
  ~Gnuplot();
  Gnuplot(const Gnuplot&) = delete;
  Gnuplot& operator=(const Gnuplot&) = delete;

  /// Sends the commands, waits for the end and writes the picture. Throws FileError, with gnuplot's
  /// message if gnuplot fails.
  void draw(const std::string& commands);

  /// Returns a text in single quotes for gnuplot; inside them only the quote is special. Removes
  /// control characters.
  [[nodiscard]] static std::string quoted(const std::string& text);

 private:
  [[nodiscard]] bool send_all(const std::string& commands) const;
  [[nodiscard]] std::string complaint() const;
  void write_picture();
  void close_all() noexcept;

  std::string picture_;
  int file_ = -1;                ///< of the picture
  bool leaves_nothing_ = false;  ///< the file was created, and has no picture yet
  int input_ = -1;               ///< our end of its standard input
  int drawing_ = -1;             ///< a memory file for its standard output: it ignores a full disk
  int errors_ = -1;              ///< the same for its standard error
  std::optional<Subprocess> process_;
};

}  // namespace regulus::picture
