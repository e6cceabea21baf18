// SPDX-License-Identifier: GPL-3.0-or-later
// A model from a pipe, which can be read only once, has the answer of the file.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/command.hpp"

namespace regulus::detail::test {
namespace {

std::string answer_of(const std::string& shown, const std::string& model, const std::string& rest) {
  const std::size_t space = rest.find(' ');
  return run_command({"/bin/sh", "-c",
                      shown + "'" REGULUS_BINARY_DIR "/bin/regulus' " + rest.substr(0, space) +
                          ' ' + model + rest.substr(space)})
      .output;
}

TEST(PipedModel, HasTheAnswerOfTheFile) {
  const std::string robots = REGULUS_SOURCE_DIR "/models/";
  for (const auto& [name, words] :
       {std::pair<std::string, std::string>{"four_bar", "check inside"},
        {"planar_3rpr", "check regular"},
        {"planar_3rpr", "bound regular determinant --gap 0.5"},
        {"planar_3rpr", "margin regular --tolerance base=0:0.1 --gap 0.5"}}) {
    const std::string file = robots + name + ".toml";
    const std::string read = answer_of("", file, words);
    EXPECT_FALSE(read.empty()) << words;
    EXPECT_EQ(answer_of("cat '" + file + "' | ", "/dev/stdin", words), read) << words;
  }
}

}  // namespace
}  // namespace regulus::detail::test
