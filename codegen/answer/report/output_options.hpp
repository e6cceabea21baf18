// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace regulus::detail {

struct OutputOptions {
  bool json = false;
  bool quiet = false;
  int json_indent = 2;  ///< −1: all on one line
  std::string page{};   ///< file of a page of the answer; empty: none
};

}  // namespace regulus::detail
