// SPDX-License-Identifier: GPL-3.0-or-later
// The text of a theorem about forces: a load and its limits, and bounds along pieces. The test
// formal.loads lets Coq prove such texts.
#include "runtime/formal/coq_load.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "runtime/formal/coq_audit.hpp"
#include "runtime/formal/coq_proof.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::detail::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string proof_of(const std::string& text) {
  std::istringstream file(text);
  return verifier::coq_proof(file);
}

constexpr const char* kFeasible =
    "at every pose of the variety, the full 2x2 matrix of the model is defined, and forces within "
    "the limits hold every wrench of the load";
constexpr const char* kLimits = "limits -1/2 : 1/2\nlimits 0 : 2*pi\n";

/// A certificate about the load `set` on a robot with one parameter.
std::string load_certificate(const std::string& set, const std::string& limits = kLimits,
                             const std::string& more = "", const std::string& scales = "",
                             const std::string& verdict = "FEASIBLE",
                             const std::string& claim = kFeasible) {
  return "regulus-certificate 1\nverdict " + verdict + "\nclaim " + claim +
         "\nmodel m\nsha256 -\nmotion way\nalpha 0\nparameter x in 1 : 2\n" + more +
         "pose x = x\nlet load_a_2 = x^2\nmatrix 2 2\nentry x\nentry load_a_2\nentry 0\nentry 1\n" +
         scales + "load a\n" + set + limits + "proof\n";
}

TEST(ATheoremAboutALoad, HasItsScalesComponentsAndLimits) {
  const std::string text = proof_of(
      load_certificate("wrench 3 +- 1/2\nwrench 0 +- 0\n", kLimits, "", "scale 1/x\nscale 2\n"));
  EXPECT_THAT(text, HasSubstr("Forces Limits.\n"));
  EXPECT_THAT(text, HasSubstr("claim   at every pose of the variety, the full 2x2 matrix"));
  EXPECT_THAT(text, HasSubstr("  [(* _x *) (1, 2);\n   (* _load_a_1 *) within (3) (1/2)]\n"));
  EXPECT_THAT(text, HasSubstr("the_scales : list expression :=\n  [1/_x;\n   2].\n"));
  EXPECT_THAT(text, HasSubstr("the_load : list expression :=\n  [_load_a_1;\n   0].\n"));
  EXPECT_THAT(text, HasSubstr("Definition the_limits : list (expression * expression) :=\n"
                              "  [(- 1/2, 1/2);\n   (0, 2 * pi)].\n"));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : forces_within_limits the_question the_scales "
                              "the_load the_limits.\n"));
  EXPECT_THAT(text, HasSubstr("apply (check_limits_correct the_question the_scales the_load "
                              "the_limits the_method)."));
}

TEST(ATheoremAboutALoad, HasAQuantityForEachPartOfTheLoad) {
  const std::string text =
      proof_of(load_certificate("wrench 3 +- 1/2\nwrench 1 +- 0\nwrench-ball 5 in 1 2\n"
                                "wrench-ball 7 in 1\n"));
  EXPECT_THAT(text, HasSubstr("(* _load_a_1 *) within (0) (1/2);\n"
                              "   (* _load_a_1_ball_1 *) within (0) (5);\n"
                              "   (* _load_a_1_ball_2 *) within (0) (7);\n"
                              "   (* _load_a_2_ *) within (1) (5)]\n"));
  EXPECT_THAT(text, HasSubstr("(* ball *) (_load_a_1_ball_1 - (0)) ^ 2 + (_load_a_2_ - (1)) ^ 2 - "
                              "(5) ^ 2;\n   (* ball *) (_load_a_1_ball_2 - (0)) ^ 2 - (7) ^ 2]"));
  EXPECT_THAT(text, HasSubstr("the_load : list expression :=\n"
                              "  [((3) + _load_a_1 + _load_a_1_ball_1 + _load_a_1_ball_2);\n"
                              "   _load_a_2_].\n"));
  EXPECT_THAT(text, HasSubstr("the_scales : list expression :=\n  [1;\n   1].\n"));
}

TEST(ATheoremAboutALoad, IsAboutEachPiece) {
  const std::string text = proof_of(load_certificate("wrench 3 +- 1/2\nwrench 0 +- 0\n", kLimits,
                                                     "piecewise start\npiece 1\npiece 2\n"));
  EXPECT_THAT(text, HasSubstr("(* _start *) nth 0 piece no_entry"));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : Forall (fun piece => forces_within_limits "
                              "(the_question piece) the_scales the_load the_limits) pieces.\n"));
  EXPECT_THAT(text, HasSubstr("apply (check_limits_pieces_correct the_question the_scales the_load "
                              "the_limits the_method pieces)."));
  EXPECT_EQ(verifier::read_plain_theorem(text).type,
            "Coq.Lists.List.Forall (fun piece => Regulus.Limits.forces_within_limits ( "
            "RegulusAudited.audited.the_question piece) RegulusAudited.audited.the_scales "
            "RegulusAudited.audited.the_load RegulusAudited.audited.the_limits) "
            "RegulusAudited.audited.pieces");
}

TEST(ATheoremAboutALoad, IsRefusedForNoLoadAndOtherVerdicts) {
  const std::string load = "wrench 3 +- 1/2\nwrench 0 +- 0\n";
  EXPECT_THROW((void)proof_of(load_certificate("wrench 3 +- -1/2\nwrench 0 +- 0\n")),
               verifier::Rejection);
  EXPECT_THROW((void)proof_of(load_certificate(load + "wrench-ball -1 in 1\n")),
               verifier::Rejection);
  EXPECT_THROW((void)proof_of(load_certificate(load, "limits 1 : 0\nlimits 0 : 1\n")),
               verifier::Rejection);
  EXPECT_THROW((void)proof_of(load_certificate(load, "limits 0 : 1\n")), verifier::Rejection);
  EXPECT_THROW((void)proof_of(load_certificate(
                   load, kLimits, "", "", "INFEASIBLE",
                   "at some pose of the variety, no forces within the limits hold some wrench of "
                   "the load")),
               verifier::Rejection);  // it has no pose and direction
  EXPECT_THROW((void)proof_of(load_certificate(load, kLimits, "", "", "FEASIBLE", "it holds")),
               verifier::Rejection);
}

/// A bound of the force in row 1 along pieces.
std::string bound_certificate(const std::string& side, const std::string& claim,
                              const std::string& pieces) {
  return "regulus-certificate 1\nverdict NO SINGULARITY\nclaim " + claim +
         "\nmodel m\nsha256 -\nmotion way\nalpha 0\nparameter x in 1 : 2\n" + pieces +
         "pose x = x\nmatrix 2 2\nentry x\nentry 0\nentry 0\nentry 1\nscale 1/x\nscale 1\n"
         "quantity force\nside " +
         side + "\nrow 1\nload a\nwrench 1 +- 1/2\nwrench 0 +- 0\nreference 0\nbound 7\nproof\n";
}

TEST(ATheoremAboutAForce, IsAboutEachPiece) {
  const std::string place = "at every pose of the variety and every vector of it";
  const std::string text =
      proof_of(bound_certificate("absolute", "|force in row 1 under the load a| < 7 " + place,
                                 "piecewise start\npiece 1\npiece 2\n"));
  EXPECT_THAT(text,
              HasSubstr("the_load : list expression :=\n  [_load_a_1 * _factor_1;\n   0].\n"));
  EXPECT_THAT(text,
              HasSubstr("Definition pieces : list (list expression) :=\n  [[1];\n   [2]].\n"));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : Forall (fun piece => force_within "
                              "(the_question piece) the_row the_load the_limit) pieces.\n"));
  EXPECT_THAT(text, HasSubstr("apply (check_force_within_pieces_correct the_question the_row "
                              "the_load the_limit the_method pieces)."));
  EXPECT_NO_THROW((void)verifier::read_plain_theorem(text));
}

TEST(ATheoremAboutAForce, OfACertificateThatStatesItNeedsNoOption) {
  const std::string place = "at every pose of the variety and every vector of it";
  const std::string text =
      proof_of(bound_certificate("largest", "force in row 1 under the load a < 7 " + place, ""));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : force_below the_question the_row the_load "
                              "the_limit.\n"));
  EXPECT_THAT(text, Not(HasSubstr("pieces")));
}

/// A certificate about the branch of p^2 = x + g, with these lines of a quantity and its words.
std::string branch_certificate(const std::string& claim, const std::string& quantity) {
  return "regulus-certificate 1\nverdict NO SINGULARITY\nclaim on the branch through the start, " +
         claim +
         "\nmodel slider\nsha256 -\nmotion small\nalpha 0\nparameter x in -1/4 : 1/4\nuncertain g "
         "= 1 +- 1/10\npose x = x\nunknown p = 1 +- 1/2\nstart 0\nequation p^2 - x - g\n" +
         quantity +
         "proof\ns 0 1 0x1p+0\nl 1 tube 0 0x1p+0 1 0x1p-1 0x1p-1 0x1p-4\n"
         "l 2 tube 0 0x1p+0 1 0x1p-1 0x1p-1 0x1p-4\nend 2\n";
}

constexpr const char* kPlace =
    " at every pose and value of the 1 uncertain quantities of the variety";

TEST(ATheoremAboutAQuantityOverABranch, HasAVariableForEachMotor) {
  const std::string text = proof_of(branch_certificate(
      std::string("|force of motor 1 under the load a| < 7") + kPlace + " and every vector of it",
      "quantity force\nside absolute\nrow 1\nload a\nwrench 1 +- 1/2\nwrench-ball 3 in 1\nbound "
      "7\n"));
  EXPECT_THAT(text, HasSubstr("Closures Tubes Branches Rates.\n"));
  EXPECT_THAT(text, HasSubstr("claim   on the branch through the start, |force of motor 1"));
  EXPECT_THAT(text, HasSubstr("[(* _x'commanded *) (- 1/4, 1/4);\n   (* _g *) within (1) (1/10);\n"
                              "   (* _x'error *) within 0 (0)]\n"
                              "  [(* _x *) _x'commanded + _x'error]\n"));
  EXPECT_THAT(text, HasSubstr("Definition the_motors : list nat := [2]%nat.\n"));
  EXPECT_THAT(text, HasSubstr("Definition the_measure : measured := Force 0.\n"));
  EXPECT_THAT(text, HasSubstr("Definition the_vectors : vectors := Vectors\n  [(1, 1/2)]\n"
                              "  [(3, [0]%nat)].\n"));
  EXPECT_THAT(text, HasSubstr("Definition the_limit : expression := 7.\n"));
  EXPECT_THAT(text, HasSubstr("Cut 1 0x1p+0\n  (Held (Tube [0x0p+0; 0x1p+0; 0x0p+0] [0x1p+0] "
                              "[[0x1p-1; 0x1p-1; 0x0p+0]] [0x1p-4]))"));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : branch_within the_closure the_motors "
                              "the_measure the_vectors the_limit.\n"));
  EXPECT_THAT(text, HasSubstr("apply (check_branch_within_correct the_closure the_motors "
                              "the_measure the_vectors the_limit the_method the_tubes)."));
  EXPECT_EQ(verifier::read_plain_theorem(text).type,
            "Regulus.Rates.branch_within RegulusAudited.audited.the_closure "
            "RegulusAudited.audited.the_motors RegulusAudited.audited.the_measure "
            "RegulusAudited.audited.the_vectors RegulusAudited.audited.the_limit");
}

TEST(ATheoremAboutAQuantityOverABranch, HasNaturalNumbersInItsListsAlone) {
  std::string text = proof_of(branch_certificate(
      std::string("|force of motor 1 under the load a| < 7") + kPlace + " and every vector of it",
      "quantity force\nside absolute\nrow 1\nload a\nwrench 1 +- 1/2\nbound 7\n"));
  EXPECT_NO_THROW((void)verifier::read_plain_theorem(text));
  const std::string limit = "the_limit : expression := 7";
  text.replace(text.find(limit), limit.size(), "the_limit : expression := (7)%nat");
  EXPECT_THROW((void)verifier::read_plain_theorem(text), verifier::Rejection);
}

TEST(ATheoremAboutAQuantityOverABranch, KnowsErrorsAndLimits) {
  const std::string error = proof_of(branch_certificate(
      std::string("|error to first order of unknown 1 by the errors of the motors| < 1/35") +
          kPlace,
      "quantity error\nside absolute\ncolumn 1\nmotor-error 1/100\nbound 1/35\n"));
  EXPECT_THAT(error,
              HasSubstr("Definition the_measure : measured := Motion 0.\n"
                        "Definition the_vectors : vectors := Vectors\n  [(0, 1/100)]\n  [].\n"
                        "Definition the_limit : expression := 1/35.\n"));
  const std::string limits = proof_of(branch_certificate(
      std::string("the forces of all motors under the load a are within their limits") + kPlace +
          " and every vector of it",
      "quantity force-limits\nload a\nwrench 1 +- 1/2\nlimits -3 : 4\n"));
  EXPECT_THAT(limits, HasSubstr("the_limits : list (expression * expression) := [(- 3, 4)].\n"));
  EXPECT_THAT(limits, HasSubstr("Theorem the_claim : branch_within_limits the_closure the_motors "
                                "the_vectors the_limits.\n"));
  EXPECT_NO_THROW((void)verifier::read_plain_theorem(limits));
}

TEST(ATheoremAboutAQuantityOverABranch, IsRefusedForOtherQuantitiesAndNoLoad) {
  const std::string force =
      std::string("|force of motor 1 under the load a| < 7") + kPlace + " and every vector of it";
  EXPECT_THROW(
      (void)proof_of(branch_certificate(
          force, "quantity force\nside absolute\nrow 1\nload a\nwrench 1 +- -1/2\nbound 7\n")),
      verifier::Rejection);
  EXPECT_THROW((void)proof_of(branch_certificate(std::string("|det| > 1/2") + kPlace,
                                                 "quantity determinant\nside least\nbound 1/2\n")),
               std::runtime_error);
}

}  // namespace
}  // namespace regulus::detail::test
