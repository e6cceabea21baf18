// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/load_prover.hpp"

namespace regulus::verifier {
namespace {

LoadTest::Claim test_of(LeafClaim claim) {
  if (claim == LeafClaim::kInfeasible) return LoadTest::Claim::kNotHeld;
  return claim == LeafClaim::kOutside ? LoadTest::Claim::kOutside : LoadTest::Claim::kHeld;
}

}  // namespace

BoxAnswer LoadProver::decide(const Box& box, LeafClaim claim) {
  return test_.decide(box, test_of(claim));
}

std::string LoadProver::contradiction(const Box& point, LeafClaim claim) {
  if (claim == LeafClaim::kOutside) return "there is a pose of the variety";
  const bool is_held = test_of(claim) == LoadTest::Claim::kHeld;
  const LoadTest::Claim opposite = is_held ? LoadTest::Claim::kNotHeld : LoadTest::Claim::kHeld;
  if (test_.decide(point, opposite) != BoxAnswer::kProved) return "";
  return is_held ? "some wrench is held by no forces" : "every wrench is held";
}

}  // namespace regulus::verifier
