// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "codegen/model/file/model_file.hpp"

namespace regulus::detail::test {
namespace {

/// Two axes that are parallel but for a billionth of a radian.
TEST(AnArm, SaysThatItIsNearlySingular) {
  const auto notes = [](const std::string& turn) {
    return parse_model(
               "regulus = 1\nname = \"arm\"\n[serial]\njoints = [{ name = \"q1\" },\n"
               "{ name = \"q2\", axis = [1, 0, 0] }, { name = \"q3\", rpy = [0, 0, " +
                   turn + "], axis = [1, 0, 0] }]\n[motion.zero]\nq1 = 0\nq2 = 0\nq3 = 0\n",
               "arm.toml")
        .matrix_notes;
  };
  const auto near = testing::Contains(testing::HasSubstr("nearly singular at all poses"));
  EXPECT_THAT(notes("1e-9"), near);
  EXPECT_THAT(notes("1e-3"), testing::Not(near));
}

}  // namespace
}  // namespace regulus::detail::test
