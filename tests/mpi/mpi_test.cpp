// SPDX-License-Identifier: GPL-3.0-or-later
// Tests regulus-mpi as its users meet it: real processes, and the bytes of one thread.
#include "codegen/mpi/agreement.hpp"
#include "tests/mpi/ranks.hpp"

namespace regulus::test {
namespace {

using testing::HasSubstr;

class Ranks : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const {
    return (directory_.path() / name).string();
  }
  const TemporaryDirectory directory_;
};

TEST_F(Ranks, GiveTheCertificateOfOneThread) {
  const CommandResult one =
      run_command(one_thread(joined(long_check(), {"--certificate", file("one")})));
  ASSERT_EQ(one.exit_code, 0) << one.errors;
  const std::string expected = text_of(file("one"));
  for (const int count : {1, 2, 4, 16}) {
    const CommandResult many =
        run_command(ranks(count, joined(long_check(), {"--certificate", file("many")})));
    EXPECT_EQ(many.exit_code, 0) << many.errors;
    EXPECT_EQ(many.output, one.output);
    EXPECT_TRUE(text_of(file("many")) == expected) << count << " ranks";
  }
}

TEST_F(Ranks, WithSeveralThreadsGiveThePavingOfOneThread) {
  const Words locate = {"locate", model("planar_3rpr"), "crossing", "--resolution", "1/100"};
  const CommandResult one = run_command(one_thread(joined(locate, {"--output", file("one")})));
  ASSERT_EQ(one.exit_code, 1) << one.errors;
  const CommandResult many =
      run_command(ranks(3, joined(locate, {"--output", file("many"), "--threads", "2"})));
  EXPECT_EQ(many.exit_code, 1) << many.errors;
  const auto boxes_of = [](const std::string& text) {
    return text.substr(0, text.rfind("{\"summary\""));
  };
  const std::string expected = boxes_of(text_of(file("one")));
  EXPECT_GT(expected.size(), 1'000'000U);
  EXPECT_TRUE(boxes_of(text_of(file("many"))) == expected);
}

TEST_F(Ranks, BracketAsOneThreadDoes) {
  const CommandResult many =
      run_command(ranks(2, {"margin", model("robot_1"), "wide_15", "--tolerance",
                            "base,platform=0:0.05", "--gap", "0.5"}));
  EXPECT_EQ(many.exit_code, 0) << many.errors;
  EXPECT_THAT(many.output, HasSubstr("0.05"));
}

TEST_F(Ranks, ReportAMistakeOnce) {
  const CommandResult result = run_command(ranks(3, {"check", file("none.toml")}));
  const std::string words = "cannot read";
  EXPECT_THAT(result.errors, HasSubstr(words));
  EXPECT_EQ(result.errors.find(words), result.errors.rfind(words)) << result.errors;
  EXPECT_EQ(result.exit_code, 74);
}

TEST_F(Ranks, NameTheCommandsThatTheyRun) {
  const CommandResult result = run_command(ranks(2, {"explain", model("robot_1")}));
  EXPECT_THAT(result.errors, HasSubstr("check, locate and margin run on several ranks"));
  EXPECT_EQ(result.exit_code, 64);
}

TEST_F(Ranks, EndWhenAWordIsWrong) {
  for (const Words& wrong : {Words{"--without", "nothing"}, Words{"--tolerance", "nobody=1"}}) {
    const CommandResult result =
        run_command(ranks(3, joined({"check", model("robot_1"), "wide_15"}, wrong)));
    EXPECT_EQ(result.exit_code, 64) << result.errors;
  }
}

TEST_F(Ranks, RefuseAFilter) {
  const CommandResult result =
      run_command(ranks(2, {"check", model("robot_1"), "wide_15", "--filter", "any.so"}));
  EXPECT_THAT(result.errors, HasSubstr("--filter: a filter runs in one process only"));
  EXPECT_EQ(result.exit_code, 64);
}

TEST_F(Ranks, RefuseACheckpointThatAnotherJobUses) {
  RunningCommand first(
      ranks(2, {"check", model("robot_1"), "table4_5", "--method", "reg", "--checkpoint",
                file("saved"), "--checkpoint-every", "0.1", "--time-limit", "60"}));
  while (!std::filesystem::exists(file("saved"))) ::usleep(10000);
  const CommandResult second =
      run_command(ranks(2, {"check", model("robot_1"), "table4_5", "--method", "reg",
                            "--checkpoint", file("saved")}));
  EXPECT_EQ(second.exit_code, 74) << second.errors;
  EXPECT_THAT(second.errors, HasSubstr("another"));
  ::kill(first.pid(), SIGTERM);
  static_cast<void>(first.wait());
}

TEST(Agreement, IsTheBestSetThatAllHave) {
  const std::vector<RankIdentity> two = {{"a", "build", Isa::kAvx512}, {"b", "build", Isa::kAvx2}};
  EXPECT_EQ(compare(two, std::nullopt).isa, Isa::kAvx2);
  EXPECT_EQ(compare(two, Isa::kPortable).isa, Isa::kPortable);
  EXPECT_EQ(compare(two, Isa::kPortable).refusal, "");
  EXPECT_THAT(compare(two, Isa::kAvx512).refusal,
              HasSubstr("rank 1 on b: this processor cannot run avx512"));
}

TEST(Agreement, NamesARankOfAnotherBuild) {
  const std::vector<RankIdentity> three = {
      {"a", "build", Isa::kAvx2}, {"a", "build", Isa::kAvx2}, {"c", "other", Isa::kAvx2}};
  EXPECT_THAT(compare(three, std::nullopt).refusal,
              HasSubstr("rank 2 on c runs another build of regulus-mpi than rank 0 on a"));
}

}  // namespace
}  // namespace regulus::test
