// SPDX-License-Identifier: GPL-3.0-or-later
// The text of a theorem about singular values, with and without pieces, and over a branch. The tests
// formal.spectra, formal.rates and formal.ways let Coq prove such texts.
#include "runtime/formal/coq_spectrum.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "runtime/formal/coq_audit.hpp"
#include "runtime/formal/coq_proof.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::detail::test::coq_spectrum_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string proof_of(const std::string& text) {
  std::istringstream file(text);
  return verifier::coq_proof(file);
}

/// A certificate about a matrix with two columns, with these lines of a quantity and its words.
std::string certificate(const std::string& claim, const std::string& quantity,
                        const std::string& scales = "scale 1/x\nscale 2\n",
                        const std::string& verdict = "NO SINGULARITY",
                        const std::string& pieces = "") {
  return "regulus-certificate 1\nverdict " + verdict + "\nclaim " + claim +
         "\nmodel m\nsha256 -\nmotion way\nalpha 0\nparameter x in 1 : 2\n" + pieces +
         "pose x = x\nmatrix 2 2\nentry x\nentry x^2\nentry 0\nentry 1\n" + scales + quantity +
         "proof\n";
}

constexpr const char* kPlace = " at every pose of the variety";
constexpr const char* kRatio =
    "condition number in the 2-norm of J^-1 with the factors of its columns < 7";
constexpr const char* kRatioLines =
    "quantity condition-2\nside largest\nfactor 1\nfactor 1/10\nreference 0\nbound 7\n";

TEST(ATheoremAboutSingularValues, HasTheScalesFactorsAndLimit) {
  const std::string text = proof_of(certificate(std::string(kRatio) + kPlace, kRatioLines));
  EXPECT_THAT(text, HasSubstr("Forces SingularValues.\n"));
  EXPECT_THAT(text, HasSubstr("claim   condition number in the 2-norm of J^-1"));
  EXPECT_THAT(text, HasSubstr("the_scales : list expression :=\n  [1/_x;\n   2].\n"));
  EXPECT_THAT(text, HasSubstr("the_factors : list expression :=\n  [1;\n   1/10].\n"));
  EXPECT_THAT(text, HasSubstr("Definition the_limit : expression := 7.\n"));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : condition_2_below the_question the_scales "
                              "the_factors the_limit.\n"));
  EXPECT_THAT(text, HasSubstr("apply (check_condition_2_below_correct the_question the_scales "
                              "the_factors the_limit the_method)."));
  EXPECT_EQ(verifier::read_plain_theorem(text).type,
            "Regulus.SingularValues.condition_2_below RegulusAudited.audited.the_question "
            "RegulusAudited.audited.the_scales RegulusAudited.audited.the_factors "
            "RegulusAudited.audited.the_limit");
}

TEST(ATheoremAboutSingularValues, SaysThatTheyAreAboveOrBelow) {
  const std::string least = proof_of(certificate(
      std::string("least singular value of J^-1 with the factors of its columns > 1/2") + kPlace,
      "quantity sigma-min\nside least\nfactor 1\nfactor 1\nreference 0\nbound 1/2\n", ""));
  EXPECT_THAT(least, HasSubstr("the_scales : list expression :=\n  [1;\n   1].\n"));
  EXPECT_THAT(least, HasSubstr("Theorem the_claim : singular_values_above the_question"));
  const std::string largest = proof_of(certificate(
      std::string("largest singular value of J^-1 with the factors of its columns < 9") + kPlace,
      "quantity sigma-max\nside largest\nfactor 1\nfactor 1\nreference 0\nbound 9\n"));
  EXPECT_THAT(largest, HasSubstr("Theorem the_claim : singular_values_below the_question"));
  EXPECT_NO_THROW((void)verifier::read_plain_theorem(largest));
}

TEST(ATheoremAboutSingularValues, IsAboutEachPiece) {
  const std::string text =
      proof_of(certificate(std::string(kRatio) + kPlace, kRatioLines, "", "NO SINGULARITY",
                           "piecewise start\npiece 1\npiece 2\n"));
  EXPECT_THAT(text,
              HasSubstr("Definition pieces : list (list expression) :=\n  [[1];\n   [2]].\n"));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : Forall (fun piece => condition_2_below "
                              "(the_question piece) the_scales the_factors the_limit) pieces.\n"));
  EXPECT_NO_THROW((void)verifier::read_plain_theorem(text));
}

TEST(ATheoremAboutSingularValues, DoesNotSayThatOneIsAttained) {
  EXPECT_THROW((void)proof_of(certificate("condition number in the 2-norm of J^-1 with the "
                                          "factors of its columns >= 7 at some pose of the variety",
                                          kRatioLines, "", "SINGULARITY")),
               verifier::Unfinished);
}

TEST(ATheoremAboutSingularValues, OverABranchHasFactorsAndNoMotors) {
  const std::string text = proof_of(
      "regulus-certificate 1\nverdict NO SINGULARITY\nclaim on the branch through the start, "
      "|condition number in the 2-norm of the equations' derivatives by the unknowns with the "
      "factors of its columns| < 7 at every pose of the variety\nmodel slider\nsha256 -\nmotion "
      "small\nalpha 0\nparameter x in -1/4 : 1/4\npose x = x\nunknown p = 1 +- 1/2\nstart "
      "0\nequation p^2 - x - 1\nquantity condition-2\nside absolute\nfactor 3\nbound 7\nproof\n"
      "l 0 tube 0 1 0x1p-1 0x1p-4\nend 1\n");
  EXPECT_THAT(text, HasSubstr("Closures Tubes Branches Rates Slopes.\n"));
  EXPECT_THAT(text, HasSubstr("Definition the_factors : list expression := [3].\n"));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : branch_condition_2 the_closure the_factors "
                              "the_limit.\n"));
  EXPECT_THAT(text, Not(HasSubstr("the_motors")));
  EXPECT_EQ(verifier::read_plain_theorem(text).type,
            "Regulus.Slopes.branch_condition_2 RegulusAudited.audited.the_closure "
            "RegulusAudited.audited.the_factors RegulusAudited.audited.the_limit");
}

}  // namespace
}  // namespace regulus::detail::test::coq_spectrum_test
