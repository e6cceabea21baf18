// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the tests of a suite, which are the same in every run.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <string>

namespace regulus::detail::test {

/// Returns the text with only what may stand in a test's name.
[[nodiscard]] inline std::string name_of_words(std::string text) {
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return text;
}

/// Names a test by the number and the text of its parameter, which has an operator<<.
inline constexpr auto parameter_name = [](const auto& info) {
  return std::to_string(info.index) + "_" + name_of_words(testing::PrintToString(info.param));
};

}  // namespace regulus::detail::test
