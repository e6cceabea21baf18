// SPDX-License-Identifier: GPL-3.0-or-later
// Every kind of question by several threads has the proofs of one. `make tsan` runs it under
// ThreadSanitizer: each judge of boxes, and the verifier, have several threads here.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "runtime/verifier/input_file.hpp"
#include "runtime/verifier/verify.hpp"
#include "tests/unit/api/claims_in_shards.hpp"

namespace regulus::detail::test::claims_in_shards {
namespace {

constexpr unsigned kSeveral = 3;
constexpr std::size_t kLongestProof = 1 << 24;

class ByThreads : public AClaim {
 protected:
  /// Returns the proofs that the threads write.
  [[nodiscard]] std::map<std::string, std::string> proofs(unsigned threads) const {
    const std::filesystem::path folder = path("by_" + std::to_string(threads));
    std::filesystem::create_directory(folder);
    prove(folder / "proof", 0, threads);
    std::map<std::string, std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      found[entry.path().filename()] = verifier::read_text(entry.path().string(), kLongestProof);
    return found;
  }
};

TEST_P(ByThreads, HasTheProofsOfOne) {
  const std::map<std::string, std::string> all = proofs(kSeveral);
  ASSERT_FALSE(all.empty());
  if (GetParam().claim.is_repeatable) {
    EXPECT_TRUE(proofs(1) == all);
  }
  for (const auto& [name, text] : all) {
    verifier::InputFile bytes(path("by_" + std::to_string(kSeveral)) + '/' + name);
    std::istream file(&bytes);
    verifier::Options options;
    options.threads = kSeveral;
    const verifier::Verification v = verifier::verify(file, options);
    EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << name << ": " << v.reason;
  }
}

std::vector<Case> all_claims() {
  std::vector<Case> all;
  for (const Claim& claim : kClaims)
    for (const bool is_along_way : {false, true}) all.push_back({claim, is_along_way});
  return all;
}

INSTANTIATE_TEST_SUITE_P(OfEachClaim, ByThreads, testing::ValuesIn(all_claims()),
                         [](const auto& which) { return name_of(which.param); });

}  // namespace
}  // namespace regulus::detail::test::claims_in_shards
