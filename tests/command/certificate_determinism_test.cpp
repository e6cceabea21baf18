// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/command/certificate_determinism.hpp"

#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

TEST_P(ACertificateFile, HasTheSameBytesInEveryProcess) {
  const std::string first = written();
  EXPECT_NE(first.find("\nproof\n"), std::string::npos);
  for (int process = 0; process < trials(2, 4); ++process) ASSERT_EQ(written(), first);
}

TEST_P(ACertificateFile, DoesNotDependOnWhatTheSearchRanOn) {
  const std::string first = written();
  EXPECT_EQ(written({"--threads", "2"}), first);
  EXPECT_EQ(written({"--isa", "portable"}), first);
  EXPECT_EQ(written({"--engine", "interpreted"}), first);
  EXPECT_EQ(written({"--engine", "jit", "--no-cache"}), first);
  EXPECT_EQ(written({"--engine", "clang"}), first) << "the reference of all others";
}

TEST_P(ACertificateFile, DoesNotDependOnWhatTheCacheHolds) {
  const std::string first = written();
  expect_whatever_the_cache_holds("interpreted", "1", first);
  expect_whatever_the_cache_holds("auto", "8", first);
  expect_whatever_the_cache_holds("jit", "2", first);
}

INSTANTIATE_TEST_SUITE_P(Models, ACertificateFile, testing::ValuesIn(every_second(kAskedTwice, 0)),
                         name_of_asked);
INSTANTIATE_TEST_SUITE_P(NightlyModels, ACertificateFile,
                         testing::ValuesIn(every_second(kAskedTwice, 1)), name_of_asked);

}  // namespace
}  // namespace regulus::detail::test
