// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/command.hpp"

namespace regulus::detail::test {

/// Address randomisation changes the order of GiNaC's terms; the text of a kernel must not depend on
/// it.
inline void expect_same_text(const std::string& model, const char* motion, const char* method,
                             int processes) {
  const std::vector<std::string> words{"explain", model_path(model), motion, "--stage",
                                       "text",    "--method",        method};
  const std::string first = regulus(words).output;
  EXPECT_NE(first, "");
  for (int process = 1; process < processes; ++process)
    ASSERT_EQ(regulus(words).output, first) << model << ", process " << process;
}

}  // namespace regulus::detail::test
