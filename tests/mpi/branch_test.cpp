// SPDX-License-Identifier: GPL-3.0-or-later
// Ranks share the search over a branch of a closure.
#include "tests/mpi/ranks.hpp"

namespace regulus::test {
namespace {

class RanksOnABranch : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const {
    return (directory_.path() / name).string();
  }
  const TemporaryDirectory directory_;
};

/// Shared after 16 384 boxes.
TEST_F(RanksOnABranch, PaveAsOneThreadDoes) {
  const Words locate = {
      "locate",  model("five_bar_closure"), "wide", "--resolution", "1/400", "--max-boxes", "18000",
      "--output"};
  const auto boxes_of = [this](const std::string& name) {
    const std::string lines = text_of(file(name));
    return lines.substr(0, lines.rfind("{\"summary\""));
  };
  static_cast<void>(run_command(one_thread(joined(locate, {file("one")}))));
  EXPECT_GT(boxes_of("one").size(), 500'000U);
  const CommandResult many = run_command(ranks(2, joined(locate, {file("many")})));
  EXPECT_TRUE(boxes_of("many") == boxes_of("one")) << many.errors;
}

TEST_F(RanksOnABranch, ProveAsOneThreadDoes) {
  const Words check = {"check", model("four_bar"), "inside", "--certificate"};
  ASSERT_EQ(run_command(one_thread(joined(check, {file("one")}))).exit_code, 0);
  const CommandResult many = run_command(ranks(2, joined(check, {file("many")})));
  EXPECT_EQ(many.output, "NO SINGULARITY\n") << many.errors;
  EXPECT_TRUE(text_of(file("many")) == text_of(file("one")));
}

TEST_F(RanksOnABranch, BracketAsOneThreadDoes) {
  const Words margin = {"margin", model("four_bar"), "swing", "--scale", "1:4", "--gap", "0.1"};
  const CommandResult one = run_command(one_thread(margin));
  EXPECT_EQ(run_command(ranks(2, margin)).output, one.output) << one.errors;
}

}  // namespace
}  // namespace regulus::test
