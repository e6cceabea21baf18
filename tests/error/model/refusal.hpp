// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "codegen/model/file/model_file.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/example_model.hpp"

namespace regulus::detail::test {

/// Expects that the model is refused at that line, and that the two parts of the message contain
/// the given words.
inline void expect_refused(const std::string& text, int line, const std::string& found,
                           const std::string& expected) {
  try {
    (void)parse_model(text, "m.toml");
    ADD_FAILURE() << "accepted; expected: found " << found << ", expected " << expected;
  } catch (const InputError& error) {
    const std::string message = error.what();
    const std::string place = "m.toml:" + std::to_string(line) + ": ";
    EXPECT_EQ(error.file(), "m.toml");
    EXPECT_EQ(error.line(), line) << message;
    EXPECT_THAT(error.found(), testing::HasSubstr(found));
    EXPECT_THAT(error.expected(), testing::HasSubstr(expected));
    EXPECT_THAT(message,
                testing::AnyOf(place + "found " + error.found() + ", expected " + error.expected(),
                               place + error.found() + "; " + error.expected()));
  }
}

/// A change of a model that makes it one that is refused.
struct RefusedChange {
  const char* name;
  std::string from, to;  ///< without `from`, `to` is the whole text
  int line;
  std::string found, expected;
};
inline void PrintTo(const RefusedChange& change, std::ostream* out) { *out << change.name; }
inline std::string name_of_change(const testing::TestParamInfo<RefusedChange>& info) {
  return info.param.name;
}
inline void expect_refused(const RefusedChange& c, const std::string& model) {
  expect_refused(c.from.empty() ? c.to : changed(model, c.from, c.to), c.line, c.found, c.expected);
}

/// Expects the same for the example with one change.
inline void expect_refused_change(const std::string& from, const std::string& to, int line,
                                  const std::string& found, const std::string& expected) {
  expect_refused(changed(kExample, from, to), line, found, expected);
}

inline void expect_refused_gough(const std::string& from, const std::string& to, int line,
                                 const std::string& found, const std::string& expected) {
  expect_refused(changed(kExampleGough, from, to), line, found, expected);
}

}  // namespace regulus::detail::test
