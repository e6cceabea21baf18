// SPDX-License-Identifier: GPL-3.0-or-later
// A damaged robot file gives a model, an InputError or a UsageError, and nothing else.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "codegen/model/import/import.hpp"
#include "codegen/support/errors.hpp"
#include "tests/property/import/damage.hpp"
#include "tests/support/robots/robot_file.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

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

void expect_answers(const std::string& text, unsigned files) {
  ASSERT_EQ(answer(text), Answer::kModel);
  unsigned models = 0, refused = 0;
  for (unsigned seed = 0; seed < files; ++seed) {
    const Answer given = answer(damaged_robot(seed, text));
    models += given == Answer::kModel;
    refused += given == Answer::kBadFile;
  }
  EXPECT_GT(models, files / 20);
  EXPECT_GT(refused, files / 20);
}

TEST(DamagedUrdf, IsReadOrRefused) { expect_answers(robot_text("mh5.urdf"), trials(1000, 3000)); }

TEST(DamagedMjcf, IsReadOrRefused) { expect_answers(robot_text("arm.mjcf"), trials(60, 100)); }

TEST(DamagedSdf, IsReadOrRefused) { expect_answers(robot_text("arm.sdf"), trials(1000, 3000)); }

TEST(DamagedHexapod, IsReadOrRefused) { expect_answers(robot_text("hexapod.mjcf"), 1000); }

}  // namespace
}  // namespace regulus::detail::test
