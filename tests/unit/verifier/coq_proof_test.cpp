// SPDX-License-Identifier: GPL-3.0-or-later
// The text of a theorem for Coq. The tests of tests/formal let Coq read such texts.
#include "runtime/formal/coq_proof.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "runtime/formal/coq_expression.hpp"
#include "runtime/verifier/expression.hpp"

namespace regulus::detail::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using verifier::coq_comment;
using verifier::coq_expression;
using verifier::coq_identifier;
using verifier::coq_proof;

std::string certificate(const std::string& variables, const std::string& entries,
                        const std::string& uncertain = "", const std::string& verdict = "") {
  const std::string word = verdict.empty() ? "NO SINGULARITY" : "SINGULARITY";
  const std::string claim =
      verdict.empty() ? "is defined and has full rank at every pose" : "is singular at some pose";
  return "regulus-certificate 1\nverdict " + word + "\nclaim the full 1x1 matrix of the model " +
         claim + uncertain +
         " of the variety\nmodel a (* \"model\" *)\nsha256 -\nmotion m\nalpha 0\n" + variables +
         "matrix 1 1\nentry " + entries + "\nproof\n" + verdict;
}

/// The same question about |det| and the threshold 1/2.
std::string with_threshold(std::string text, bool is_singular) {
  const auto replace = [&text](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("claim the full", "claim |det| of the full");
  replace(is_singular ? "is singular" : "is defined and has full rank",
          is_singular ? "is at most alpha" : "exceeds alpha");
  replace("alpha 0\n", "alpha 1/2\n");
  replace("proof\n", "scale 1/(x + 2)\nproof\n");
  return text;
}

std::string written(const std::string& text) {
  std::istringstream file(text);
  return coq_proof(file);
}

TEST(ACoqExpression, KeepsWhatIsWrittenAndOnlySeparatesWordsOfCoq) {
  const verifier::CoqNames names = {{"x", "_x"}, {"in", "_in"}, {"e1", "_e1"}};
  EXPECT_EQ(coq_expression("2*x^2 + sin(in)/e1", names), "2 * _x^2 + sin(_in)/_e1");
  EXPECT_EQ(coq_expression("-(-x)", names), "- (- _x)");
  EXPECT_EQ(coq_expression("x*(x)*-x", names), "_x * (_x) * - _x");
  EXPECT_EQ(coq_expression("atan2(x, e1)", names), "atan2(_x, _e1)");
  EXPECT_EQ(coq_expression("x - e1 - -x", names), "_x - _e1 - - _x");
  EXPECT_EQ(coq_expression("1e-3*.5 + 2.", names), "1e-3 * 0.5 + 2");
}

TEST(ACoqIdentifier, IsNoWordOfCoq) {
  EXPECT_EQ(coq_identifier("psi"), "_psi");
  EXPECT_EQ(coq_identifier("forall"), "_forall");
}

TEST(ACoqComment, EndsWhereItsTextEnds) {
  EXPECT_EQ(coq_comment("a *) b (* c (*) \"d"), "a * ) b ( * c ( * ) 'd");
}

TEST(ATheorem, StatesTheQuestionInTheOrderOfTheCertificate) {
  const std::string text =
      written(certificate("parameter x in 1 : 2*pi\nconstant a = 3\n"
                          "pose y = x + 1\nlet e1 = a*y\n",
                          "e1 + 1"));
  EXPECT_THAT(text, HasSubstr("model   a ( * 'model' * )\n"));
  EXPECT_THAT(text, HasSubstr("Definition _x := Name 0.\nDefinition _a := Name 1.\n"
                              "Definition _y := Name 2.\nDefinition _e1 := Name 3.\n"));
  EXPECT_THAT(text, HasSubstr("[(* _x *) (1, 2 * pi)]\n"
                              "  [(* _a *) 3;\n   (* _y *) _x + 1;\n   (* _e1 *) _a * _y]\n"
                              "  []\n  []\n  [[_e1 + 1]]\n  1.\n"));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : no_singularity the_question.\n"));
}

TEST(ATheorem, HasControlErrorsInTheMatrixAndBallsAsConstraints) {
  const std::string text =
      written(certificate("parameter x in 1 : 2\nuncertain a = 3 +- 1/20\nuncertain b = 4 +- 1/20\n"
                          "ball a b\npose x = x +- 1/100\n",
                          "x + a", " and value of the 3 uncertain quantities"));
  EXPECT_THAT(text, HasSubstr("Definition _x'commanded := Name 0.\nDefinition _a := Name 1.\n"
                              "Definition _b := Name 2.\nDefinition _x'error := Name 3.\n"
                              "Definition _x := Name 4.\n"));
  EXPECT_THAT(text, HasSubstr("(* _x'error *) within 0 (1/100)]"));
  EXPECT_THAT(text, HasSubstr("(* _x *) _x'commanded + _x'error"));
  EXPECT_THAT(text, HasSubstr("(* ball *) (_a - (3)) ^ 2 + (_b - (4)) ^ 2 - (1/20) ^ 2"));
}

TEST(ATheorem, OfASingularityHasItsTwoPoints) {
  const std::string text = written(
      certificate("parameter x in -1 : 1\npose x = x\n", "x", "",
                  "reason opposite-signs\npoint + 0x1p-1\npoint - -0.5\npath segment\nend\n"));
  EXPECT_THAT(text, HasSubstr("negative : coordinates :=\n  [(-0x1p-1)]%float."));
  EXPECT_THAT(text, HasSubstr("positive : coordinates :=\n  [0x1p-1]%float."));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : singularity the_question.\n"));
  EXPECT_THAT(text, Not(HasSubstr("no_singularity")));
}

TEST(ATheorem, AboutAThresholdHasItsScales) {
  const std::string text =
      written(with_threshold(certificate("parameter x in 1 : 2\npose x = x\n", "x"), false));
  EXPECT_THAT(text, HasSubstr("Definition the_scales : list expression :=\n  [1/(_x + 2)].\n"
                              "Definition the_threshold : expression := 1/2.\n"));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : determinant_above the_question the_scales "
                              "the_threshold.\n"));
  EXPECT_THAT(text, HasSubstr("apply (check_determinant_correct the_question the_scales "
                              "the_threshold the_method)."));
}

TEST(ATheorem, AboutASmallDeterminantHasItsPoint) {
  const std::string point = "reason small-determinant\npoint 0 lower -0x1p-3\nend\n";
  const std::string text = written(with_threshold(
      certificate("parameter x in -1 : 1\nparameter y in -1 : 1\npose x = x\npose y = y\n", "x", "",
                  point),
      true));
  EXPECT_THAT(text, HasSubstr("Definition the_point : coordinates :=\n  [neg_infinity;\n"
                              "   (-0x1p-3)]%float."));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : determinant_not_above the_question the_scales "
                              "the_threshold.\n"));
}

TEST(ATheorem, AboutAThresholdMayHaveTwoPoints) {
  const std::string points =
      "reason opposite-signs\npoint + 0x1p-1\npoint - -0.5\npath segment\nend\n";
  const std::string text = written(
      with_threshold(certificate("parameter x in -1 : 1\npose x = x\n", "x", "", points), true));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : determinant_not_above the_question the_scales "
                              "the_threshold.\n"));
  EXPECT_THAT(text, HasSubstr("apply (check_crossing_correct the_question the_scales "
                              "the_threshold negative positive)."));
}

TEST(ATheorem, OfATrajectoryIsAboutEachPiece) {
  const std::string text = written(
      certificate("parameter T in 0 : 1\nconstant b = 7\npiecewise start slope\npiece 1 | 1/2\n"
                  "piece 3/2 | -1/4\npose y = start + slope*T\n",
                  "y + b"));
  EXPECT_THAT(text, HasSubstr("Definition the_question (piece : list expression) : question"));
  EXPECT_THAT(text, HasSubstr("[(* _b *) 7;\n   (* _start *) nth 0 piece no_entry;\n"
                              "   (* _slope *) nth 1 piece no_entry;\n"
                              "   (* _y *) _start + _slope * _T]"));
  EXPECT_THAT(text, HasSubstr("  [[1;\n    1/2];\n   [3/2;\n    - 1/4]].\n"));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : Forall (fun piece => no_singularity "
                              "(the_question piece)) pieces.\n"));
}

TEST(ATheorem, OfATrajectoryWithAThresholdIsAboutEachPiece) {
  const std::string text = written(with_threshold(
      certificate("parameter T in 0 : 1\npiecewise start\npiece 1\npiece 2\npose x = start + T\n",
                  "x"),
      false));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : Forall (fun piece => determinant_above "
                              "(the_question piece) the_scales the_threshold) pieces.\n"));
  EXPECT_THAT(text, HasSubstr("apply (check_determinant_pieces_correct the_question the_scales "
                              "the_threshold the_method pieces)."));
}

TEST(ATheorem, IsRefusedWhereTheLibraryHasNone) {
  const std::string variables = "parameter x in -1 : 1\npose x = x\n";
  EXPECT_THROW(
      (void)written(certificate(variables, "x", "", "reason always-singular\npoint 0 0\nend\n")),
      verifier::Unfinished);
  EXPECT_THROW(
      (void)written(certificate(variables, "x", "", "reason opposite-signs\npoint + 1 2\n")),
      verifier::Rejection);
  EXPECT_THROW((void)written(certificate(variables, "x + y")), verifier::Rejection);
  EXPECT_THROW((void)written("no certificate\n"), verifier::Rejection);
}

TEST(ATheorem, AboutABoundIsRefusedWithAndWithoutPieces) {
  for (const char* pieces : {"", "piecewise start\npiece 1\npiece 2\n"})
    EXPECT_THROW(
        (void)written("regulus-certificate 1\nverdict NO SINGULARITY\nclaim |det J^-1| > 1/2 "
                      "at every pose of the variety\nmodel m\nsha256 -\nmotion way\nalpha 0\n"
                      "parameter T in 1 : 2\n" +
                      std::string(pieces) +
                      "pose x = T\nmatrix 1 1\nentry x\nscale 1\nquantity determinant\n"
                      "side least\nreference 0\nbound 1/2\nproof\n"),
        verifier::Unfinished)
        << pieces;
}

/// The theorem of the force of row 1, if the certificate is that of a bound of a force.
std::string force_theorem(const std::string& range, const std::string& first_entry,
                          const std::string& more = "") {
  std::istringstream file(
      "regulus-certificate 1\nverdict NO SINGULARITY\nclaim the full 2x2 matrix of the model is "
      "defined and has full rank at every pose and value of the 1 uncertain quantities of the "
      "variety\nmodel r\nsha256 -\nmotion m\nalpha 0\nparameter x in 1 : 2\nparameter r in " +
      range + "\nuncertain w = 0 +- 1\npose x = x\npose r = r\nlet e1 = x^2\n" + more +
      "matrix 2 2\nentry " + first_entry + "\nentry -2*r*w/e1 + 1\nentry 0\nentry x\nproof\n");
  return coq_proof(file, verifier::CoqStatement::kForce);
}

TEST(ATheorem, AboutAForceHasTheMatrixWithoutItsLoad) {
  const std::string text = force_theorem("-1/5 : 1/5", "e1 - (x - 1e-3) - w*r*(1 + e1) - 3*w*r");
  EXPECT_THAT(text, HasSubstr("claim   the absolute force of row 1 is below 5 "));
  EXPECT_THAT(text, HasSubstr("Definition _x := Name 0.\nDefinition _w := Name 1.\n"
                              "Definition _e1 := Name 2.\n"));
  EXPECT_THAT(text, HasSubstr("  [[_e1 - (_x - 1e-3);\n    1];\n   [0;\n    _x]]\n  2.\n"));
  EXPECT_THAT(text, HasSubstr("Definition the_load : list expression :=\n"
                              "  [_w * (1 + _e1) + 3 * _w;\n   2 * _w/_e1].\n"));
  EXPECT_THAT(text, HasSubstr("Definition the_row : nat := 0.\n"
                              "Definition the_limit : expression := 5.\n"));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : force_within the_question the_row the_load "
                              "the_limit.\n"));
  EXPECT_THAT(text, HasSubstr("apply (check_force_within_correct the_question the_row the_load "
                              "the_limit the_method)."));
}

TEST(ATheorem, AboutASignedForceIsOneSided) {
  EXPECT_THAT(force_theorem("0 : 3/7", "r"),
              HasSubstr("Definition the_limit : expression := 7/3."));
  EXPECT_THAT(force_theorem("0 : 2*pi", "1 + r"), HasSubstr("expression := 1/(2 * pi)."));
  EXPECT_THAT(force_theorem("0 : 1", "x + r"),
              HasSubstr("Definition the_load : list expression :=\n  [- 1;"));
  EXPECT_THAT(force_theorem("0 : 1", "x"),
              HasSubstr("Definition the_load : list expression :=\n  [0;"));
  EXPECT_THAT(force_theorem("0 : 1", "-r/x"), HasSubstr("[1/_x;"));
  EXPECT_THAT(force_theorem("0 : 1", "x"),
              HasSubstr("Theorem the_claim : force_below the_question"));
}

TEST(ATheorem, AboutAForceIsRefusedForOtherQuestions) {
  EXPECT_THROW((void)force_theorem("-1/5 : 1/4", "x"), verifier::Unfinished);
  EXPECT_THROW((void)force_theorem("1 : 2", "x"), verifier::Unfinished);
  for (const char* entry : {"x + r^2", "r*r", "x/r", "sin(r)", "(1 + r)*x", "x^r"})
    EXPECT_THROW((void)force_theorem("0 : 1", entry), std::runtime_error) << entry;
  EXPECT_THROW((void)force_theorem("0 : 1", "x", "let e2 = r*x\n"), verifier::Unfinished);
  std::istringstream plain(certificate("parameter x in 1 : 2\npose x = x\n", "x"));
  EXPECT_THROW((void)coq_proof(plain, verifier::CoqStatement::kForce), verifier::Unfinished);
}

}  // namespace
}  // namespace regulus::detail::test
