// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that false claims of a deliberately wrong solver are not verified.
#include <gtest/gtest.h>

#include "runtime/kernel/call.hpp"
#include "runtime/search/solver.hpp"
#include "tests/support/certificates.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;

std::string finished(CertificateWriter& writer) {
  Result result;
  result.verdict = Verdict::kNoSingularity;
  EXPECT_TRUE(writer.finish(result));
  return file_contents(writer.path());
}

/// Returns the certificate of a search that tests nothing: it claims the root, or its halves.
std::string unproved(const ModelOptions& model, bool split) {
  const PreparedSearch preparation = prepare(model, {});
  const TemporaryDirectory directory;
  CertificateWriter writer((directory.path() / "c").string(), certified_question(preparation));
  const Problem problem = preparation.problem();
  writer.on_start(problem, {});
  const OpenBox root{0, 0, problem.outer};
  if (!split) {
    writer.on_leaf(root, Rule::kSecondOrder, {});
    return finished(writer);
  }
  writer.on_split(root, {0, 0, mid(problem.outer[0]), 1});
  writer.on_leaf({1, 1, {}}, Rule::kSecondOrder, {});
  writer.on_leaf({2, 1, {}}, Rule::kDeterminant, {});
  return finished(writer);
}

TEST(AClaimThatWasNeverProved, IsRejectedWhereItIsFalse) {
  for (const bool split : {false, true}) {
    const auto v = verify_text(unproved(robot("robot_1", "wide_40"), split));
    EXPECT_EQ(v.outcome, Outcome::kRejected);
    EXPECT_NE(v.reason.find("opposite signs"), std::string::npos) << v.reason;
  }
}

TEST(AClaimThatWasNeverProved, IsVerifiedWhereTheVerifierProvesIt) {
  EXPECT_EQ(verify_text(unproved(robot("robot_1", "wide_15"), false)).outcome, Outcome::kVerified);
}

TEST(AThresholdThatWasNeverProved, IsRejectedWhereAPointIsBelowIt) {
  ModelOptions model = robot("robot_1", "wide_15");
  model.alpha = "1000";
  const auto v = verify_text(unproved(model, false));
  EXPECT_EQ(v.outcome, Outcome::kRejected);
  EXPECT_NE(v.reason.find("at most alpha"), std::string::npos) << v.reason;
}

/// A kernel that evaluates only the middle of each box, so that its bounds are wrong.
struct BlindKernel {
  regulus_kernel honest{}, blind{};
} g_blind;

const double* middles(const double* boxes) {
  alignas(64) static double thin[2 * 64 * REGULUS_LANES];
  const std::size_t count = g_blind.honest.variables;
  for (std::size_t v = 0; v < count; ++v)
    for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) {
      const std::size_t lo = 2 * v * REGULUS_LANES + lane, hi = lo + REGULUS_LANES;
      // A kernel that rounds upward stores its bounds unchanged; both become the middle.
      thin[lo] = thin[hi] = 0.5 * (boxes[lo] + boxes[hi]);
    }
  return thin;
}

template <regulus_function regulus_kernel::*Function>
unsigned blindly(const double* boxes, const double* points, double* out, const void* context) {
  return (g_blind.honest.*Function)(middles(boxes), points, out, context);
}

TEST(ABrokenBound, LeadsToACertificateThatIsRejected) {
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  search.method = Method::kKjNumeric;
  search.entries = Entries::kNatural;
  PreparedSearch preparation = prepare(robot("planar_3rpr", "crossing"), search);
  Problem problem = preparation.problem();
  g_blind.honest = g_blind.blind = *problem.kernel;
  g_blind.blind.matrix = blindly<&regulus_kernel::matrix>;
  problem.kernel = &g_blind.blind;

  const TemporaryDirectory directory;
  CertificateWriter writer((directory.path() / "c").string(), certified_question(preparation));
  // The corners have both signs. A solver that bounds boxes by their middles does not see this
  // unless it looks for witnesses.
  problem.inner.assign(problem.outer.size(), std::nullopt);
  const Result result = solve(problem, settings_from(search), &writer);
  ASSERT_EQ(result.verdict, Verdict::kNoSingularity) << "the bound was to be wrong";
  ASSERT_TRUE(writer.finish(result));
  const auto v = verify_text(file_contents(writer.path()));
  EXPECT_EQ(v.outcome, Outcome::kRejected);
  EXPECT_NE(v.reason.find("leaf "), std::string::npos) << v.reason;
}

}  // namespace
}  // namespace regulus::detail::test
