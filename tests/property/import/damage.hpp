// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/damage.hpp"

namespace regulus::detail::test {

/// Damage inserts these texts into robot files.
inline const std::vector<std::string> kRobotSplices = {"\"",
                                                       "<",
                                                       ">",
                                                       "/>",
                                                       "'",
                                                       "&",
                                                       "&#0;",
                                                       "<!--",
                                                       "-->",
                                                       "<![CDATA[",
                                                       "0",
                                                       "-",
                                                       ".",
                                                       "e9",
                                                       "nan",
                                                       "1e999",
                                                       "${x}",
                                                       " ",
                                                       "\n",
                                                       "\xff",
                                                       "<joint",
                                                       "<link name=\"x\"/>",
                                                       "xyz=\"0 0 0\"",
                                                       "fixed",
                                                       "prismatic",
                                                       "mimic",
                                                       "1e-300",
                                                       "0.1 0.2 0.3",
                                                       "</joint>",
                                                       "base_link",
                                                       "<body>",
                                                       "<joint/>"};

inline std::string damaged_robot(unsigned seed, const std::string& text) {
  return Damage(seed, kRobotSplices).done_to(text);
}

}  // namespace regulus::detail::test
