// SPDX-License-Identifier: GPL-3.0-or-later
// The proofs by compiled kernels do not depend on the number of threads. (The expressions at the
// head of a certificate may be in another order each time a model is read.)
#include <gtest/gtest.h>

#include "tests/support/certificates.hpp"

namespace regulus::detail::threads {
namespace {

std::string proof(const ModelOptions& model, unsigned threads, Verdict verdict) {
  SearchOptions search;
  search.threads = threads;
  const test::Certified certified = test::certify(model, search);
  EXPECT_EQ(certified.result.verdict, verdict);
  return certified.text.substr(certified.text.find("\nproof\n"));
}

void expect_the_same(const ModelOptions& model, Verdict verdict) {
  const std::string one = proof(model, 1, verdict);
  for (const unsigned threads : {2U, 5U})
    EXPECT_TRUE(proof(model, threads, verdict) == one) << threads << " threads";
}

TEST(Threads, WriteTheSameProofWhereDearTestsAreLearnt) {
  expect_the_same(test::robot("robot_1", "table6_15_15", "0.1"), Verdict::kNoSingularity);
}

TEST(Threads, WriteTheSameWitness) {
  expect_the_same(test::robot("robot_1", "wide_40"), Verdict::kSingularity);
}

}  // namespace
}  // namespace regulus::detail::threads
