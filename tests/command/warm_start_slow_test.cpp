// SPDX-License-Identifier: GPL-3.0-or-later
// For every motion of every model that is compiled, the report of a warm run is that of the cold
// run.
#include <gtest/gtest.h>

#include "codegen/model/file/model_file.hpp"
#include "tests/support/cached_command.hpp"
#include "tests/support/parameter_name.hpp"

namespace regulus::detail::test {
namespace {

struct Question {
  std::string model, motion;
};

std::ostream& operator<<(std::ostream& out, const Question& q) {
  return out << q.model << ' ' << q.motion;
}

std::vector<Question> every_question() {
  std::vector<Question> questions;
  for (const auto& file : std::filesystem::directory_iterator(REGULUS_SOURCE_DIR "/models")) {
    if (file.path().extension() != ".toml") continue;
    const Model model = load_model(file.path());
    if (model.closure) continue;  // nothing is compiled for it
    for (const Motion& motion : model.motions)
      if (!motion.has_no_pose()) questions.push_back({file.path(), motion.name});
  }
  return questions;
}

class EveryMotion : public testing::TestWithParam<Question> {};

TEST_P(EveryMotion, HasTheSameReportWarmAsCold) {
  const CachedCommand command;
  const std::vector<std::string> words = {"check", GetParam().model, GetParam().motion};
  const nlohmann::json cold = command.report(words);
  EXPECT_EQ(cold["cache"], "miss");
  ASSERT_EQ(command.problems().size(), 1U);
  const nlohmann::json warm = command.report(words);
  EXPECT_EQ(warm["cache"], "hit");
  EXPECT_EQ(warm["seconds"]["program"], 0.0);
  EXPECT_EQ(timeless(warm), timeless(cold));
  const std::string warm_lines = timeless(command.run(words).errors);
  command.forget_forms();
  EXPECT_EQ(warm_lines, timeless(command.run(words).errors));
}

INSTANTIATE_TEST_SUITE_P(Models, EveryMotion, testing::ValuesIn(every_question()),
                         [](const auto& question) {
                           return name_of_words(
                               question.param.model.substr(question.param.model.rfind('/') + 1) +
                               ' ' + question.param.motion);
                         });

}  // namespace
}  // namespace regulus::detail::test
