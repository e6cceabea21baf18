// SPDX-License-Identifier: GPL-3.0-or-later
// A damaged robot file gives a model, an InputError or a UsageError, and nothing else.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "codegen/import/import.hpp"
#include "codegen/support/errors.hpp"
#include "tests/support/robots/robot_file.hpp"

namespace regulus::test {
namespace {

const std::vector<std::string> kSplices = {"\"",
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

class Damage {
 public:
  explicit Damage(unsigned seed) : random_(seed) {}

  std::string done_to(std::string text) {
    for (std::size_t edits = 1 + pick(3); edits-- > 0;) edit(text);
    return text;
  }

 private:
  std::size_t pick(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }

  void edit(std::string& text) {
    const std::size_t at = pick(text.size()), length = 1 + pick(12);
    const std::string& splice = kSplices[pick(kSplices.size())];
    switch (pick(5)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, splice);
        break;
      case 2:
        text.insert(pick(text.size()), text.substr(at, 8 * length));
        break;
      case 3:
        text[at] = static_cast<char>(pick(256));
        break;
      default:
        text.replace(at, length, splice);
    }
    if (text.empty()) text.assign(1, 'x');
  }

  std::mt19937_64 random_;
};

enum class Answer { kModel, kBadFile, kUsage };

/// Any other exception escapes and fails the test.
Answer answer(const std::string& text) try {
  const Imported imported = import_robot(text, "mutant", {});
  EXPECT_FALSE(imported.model.empty());
  EXPECT_FALSE(imported.report().empty());
  return Answer::kModel;
} catch (const InputError& error) {
  EXPECT_NE(std::string(error.what()).find("mutant"), std::string::npos) << error.what();
  return Answer::kBadFile;
} catch (const UsageError&) {
  return Answer::kUsage;
}

void expect_answers(const std::string& text, unsigned trials) {
  ASSERT_EQ(answer(text), Answer::kModel);
  unsigned models = 0, refused = 0;
  for (unsigned seed = 0; seed < trials; ++seed) {
    const Answer given = answer(Damage(seed).done_to(text));
    models += given == Answer::kModel;
    refused += given == Answer::kBadFile;
  }
  EXPECT_GT(models, trials / 20);
  EXPECT_GT(refused, trials / 20);
}

TEST(DamagedUrdf, IsReadOrRefused) { expect_answers(robot_text("mh5.urdf"), 3000); }

TEST(DamagedMjcf, IsReadOrRefused) { expect_answers(robot_text("arm.mjcf"), 3000); }

TEST(DamagedSdf, IsReadOrRefused) { expect_answers(robot_text("arm.sdf"), 3000); }

TEST(DamagedHexapod, IsReadOrRefused) { expect_answers(robot_text("hexapod.mjcf"), 1000); }

}  // namespace
}  // namespace regulus::test
