// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates that somebody has changed. If such a certificate is verified, its claim must be
// true: either the question is still the one that was proved, or sampling finds nothing against the
// new one.
#pragma once

#include <gtest/gtest.h>

#include "tests/support/certificates.hpp"
#include "tests/support/claim_refutation.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {

inline verifier::Options little_effort() {
  verifier::Options options;
  options.max_boxes = std::uint64_t(trials(200, 1000));
  options.max_boxes_per_leaf = std::uint64_t(trials(100, 500));
  options.max_bits = 256;
  return options;
}

/// Returns whether the changed certificate was verified.
inline bool judge(const std::string& original, const std::string& changed, RandomSource& random) {
  const verifier::Verification v = verify_text(changed, little_effort());
  if (v.outcome != verifier::Outcome::kVerified) {
    EXPECT_FALSE(v.reason.empty());
    return false;
  }
  const auto question = [](const std::string& text) {
    return text.substr(0, text.find("\nproof"));
  };
  if (question(changed) == question(original)) return true;
  const ClaimRefutation refutation(changed, random);
  EXPECT_EQ(refutation.found(), "") << changed;
  return true;
}

/// Replaces, leaves out or doubles one byte.
inline std::string with_one_byte_changed(std::string text, RandomSource& random) {
  static const std::string kBytes = "0123456789.-+*/^() abcdefpxyz_:=\nsl\x01";
  const std::size_t at = random.below(text.size());
  switch (random.below(4)) {
    case 0:
      text.erase(at, 1);
      break;
    case 1:
      text.insert(at, 1, text[at]);
      break;
    default:
      text[at] = kBytes[random.below(kBytes.size())];
  }
  return text;
}

/// Returns how many of the changed texts were verified.
inline int judge_random_changes(const std::string& original, int changes, RandomSource& random) {
  int verified = 0;
  for (int change = 0; change < changes; ++change)
    verified += judge(original, with_one_byte_changed(original, random), random) ? 1 : 0;
  return verified;
}

}  // namespace regulus::detail::test
