// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the theorem of a certificate about finite errors over a branch, as it is printed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "runtime/formal/coq_audit.hpp"
#include "runtime/formal/coq_proof.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::detail::test::coq_distance_test {
namespace {

using testing::HasSubstr;

/// The branch of p^2 = x + g, with errors of g and of the motor, and this verdict.
std::string certificate(const std::string& verdict, const std::string& proof) {
  return "regulus-certificate 1\nverdict " + verdict +
         "\nmodel slider\nsha256 -\nmotion small\nalpha 0\nparameter u in -1/4 : 1/4\nuncertain g "
         "= "
         "1 +- 1/10\npose x = u +- 1/100\nunknown p = 1 +- 1/2\nstart 0\nequation p^2 - x - g\n"
         "quantity finite-error\nside absolute\ncolumn 1\nbound 1/9\nproof\n" +
         proof;
}

std::string safe_certificate() {
  return certificate(
      "NO SINGULARITY\nclaim on the branch through the start, |distance of unknown 1 from its "
      "value "
      "without errors| < 1/9 at every pose and value of the 2 uncertain quantities of the variety",
      "l 0 tube 0 0x1p+0 0 0x1p+0 0x1p+0 0x1p-1 0 0 0 0 0 0x1p-4 0x1p-4\nend 1\n");
}

std::string proof_of(const std::string& text) {
  std::istringstream in(text);
  return verifier::coq_proof(in);
}

TEST(ATheoremAboutAFiniteError, HasTheMechanismOnceAndTubesOfBoth) {
  const std::string text = proof_of(safe_certificate());
  EXPECT_THAT(text, HasSubstr("Closures Tubes Branches Distances.\n"));
  EXPECT_THAT(text, HasSubstr("[(* _u *) (- 1/4, 1/4);\n   (* _g *) within (1) (1/10);\n"));
  EXPECT_THAT(text, HasSubstr("\n  [_p^2 - _x - _g]\n"));
  EXPECT_THAT(text, HasSubstr("Definition the_errors : list nat := [1; 2]%nat.\n"));
  EXPECT_THAT(text, HasSubstr("Definition the_unknown : nat := 0.\n"));
  EXPECT_THAT(text, HasSubstr("Definition the_limit : expression := 1/9.\n"));
  EXPECT_THAT(text, HasSubstr("Method 3 6.\n"));
  EXPECT_THAT(text, HasSubstr("apply (check_finite_error_within_correct the_closure the_errors "
                              "the_unknown the_limit the_method the_tubes)."));
  EXPECT_EQ(verifier::read_plain_theorem(text).type,
            "Regulus.Distances.finite_error_within RegulusAudited.audited.the_closure "
            "RegulusAudited.audited.the_errors RegulusAudited.audited.the_unknown "
            "RegulusAudited.audited.the_limit");
}

TEST(ATheoremAboutAFiniteError, HasNaturalNumbersInItsListAlone) {
  std::string text = proof_of(safe_certificate());
  const std::string limit = "the_limit : expression := 1/9";
  text.replace(text.find(limit), limit.size(), "the_limit : expression := (1)%nat");
  EXPECT_THROW((void)verifier::read_plain_theorem(text), verifier::Rejection);
}

}  // namespace
}  // namespace regulus::detail::test::coq_distance_test
