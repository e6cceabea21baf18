// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/terminal_width.hpp"

#include <sys/ioctl.h>

namespace regulus::detail {

std::size_t columns_of_terminal(int file) noexcept {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  const bool is_known = ::ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_known ? size.ws_col : kUsual;
}

}  // namespace regulus::detail
