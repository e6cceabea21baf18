// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace regulus::inline report {

struct OutputOptions {
  bool json = false;
  bool quiet = false;
  int json_indent = 2;  ///< −1: all on one line
};

}  // namespace regulus::report
