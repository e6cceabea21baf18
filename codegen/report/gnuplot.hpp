// SPDX-License-Identifier: GPL-3.0-or-later
// gnuplot as a child process: no shell, its commands through a socket, its picture into a file that
// we open.
#pragma once

#include <sys/types.h>

#include <string>

namespace regulus::inline report {

class Gnuplot {
 public:
  /// Opens the picture and starts gnuplot. Throws FileError when either fails.
  explicit Gnuplot(const std::string& picture);
  ~Gnuplot();
  Gnuplot(const Gnuplot&) = delete;
  Gnuplot& operator=(const Gnuplot&) = delete;

  /// Sends the commands, waits for the end and writes the picture. Throws FileError, with gnuplot's
  /// words where it is that which fails.
  void draw(const std::string& commands);

  /// A text as gnuplot reads it: in single quotes, where nothing has a meaning but the quote
  /// itself. Control characters are left out.
  [[nodiscard]] static std::string quoted(const std::string& text);

 private:
  [[nodiscard]] bool send_all(const std::string& commands) const;
  [[nodiscard]] int wait_for_end();
  [[nodiscard]] std::string complaint() const;
  void write_picture();
  void close_all() noexcept;

  std::string picture_;
  int file_ = -1;                ///< of the picture
  bool leaves_nothing_ = false;  ///< the file was made for the picture, which is not in it yet
  int input_ = -1;               ///< our end of its standard input
  int drawing_ = -1;  ///< a file in memory that takes its standard output: it would not notice a
                      ///< disk that is full
  int errors_ = -1;   ///< the same for its standard error
  pid_t process_ = -1;
};

}  // namespace regulus::inline report
