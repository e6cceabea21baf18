// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/command/certificate_determinism.hpp"

namespace regulus::detail::test {
namespace {

class ACertificateOfAnyThreads : public ACertificateFile {};

TEST_P(ACertificateOfAnyThreads, DoesNotDependOnWhatTheCacheHolds) {
  const std::string first = written();
  for (const char* threads : {"1", "2", "8"})
    for (const char* engine : {"interpreted", "auto", "jit"})
      expect_whatever_the_cache_holds(engine, threads, first);
}

INSTANTIATE_TEST_SUITE_P(Models, ACertificateOfAnyThreads, testing::ValuesIn(kAskedTwice),
                         name_of_asked);

}  // namespace
}  // namespace regulus::detail::test
