// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that the words of the command mean on ranks what they mean elsewhere.
#include "tests/mpi/ranks.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;

TEST(WordsOnRanks, VerifyACertificateWithAnInstalledModel) {
  const TemporaryDirectory folder;
  const std::string proof = (folder.path() / "proof").string();
  ASSERT_EQ(run_command({REGULUS_BINARY_DIR "/bin/regulus", "check", "robot_1", "T1",
                         "--certificate", proof})
                .exit_code,
            0);
  for (const Words& option : {Words{"--model", "robot_1"}, Words{"--model=robot_1"}}) {
    const CommandResult result = run_command(ranks(2, joined({"verify", proof}, option)));
    EXPECT_EQ(result.output, "VERIFIED\n") << result.errors;
  }
}

TEST(WordsOnRanks, SayWhichCommandsDoNotRunOnThem) {
  EXPECT_THAT(run_command(ranks(1, {"report", "robot_1"})).errors,
              HasSubstr("the command report does not run on ranks; use regulus report"));
}

}  // namespace
}  // namespace regulus::detail::test
