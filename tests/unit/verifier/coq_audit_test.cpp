// SPDX-License-Identifier: GPL-3.0-or-later
// Files that look like a theorem and are none. tests/formal/audit.cmake gives such files to Coq.
#include "runtime/formal/coq_audit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/formal/coq_proof.hpp"
#include "runtime/formal/coq_theorem.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::detail::test {
namespace {

using ::testing::HasSubstr;
using verifier::check_assumptions;
using verifier::read_plain_theorem;

std::string plain_theorem(const std::string& pieces = "") {
  std::istringstream certificate(
      "regulus-certificate 1\nverdict NO SINGULARITY\nclaim the full 1x1 matrix of the model is "
      "defined and has full rank at every pose of the variety\nmodel Zü*)(*\xE4\xB8\xAD\"\nsha256 "
      "-\nmotion m\nalpha 0\nparameter x in 1 : 2\n" +
      pieces + "pose y = x + 1e-3\nlet e1 = sin(y)^2 + 1\nmatrix 1 1\nentry e1 - 0.5\nproof\n");
  return verifier::coq_proof(certificate);
}

constexpr const char* kRobot =
    "\nFrom Regulus Require Import Geometry.\n\nDefinition legs : list leg :=\n"
    "  [((-9, 9, 0.5), (-3, 7, 0)); ((9, 9, 1e-2), (3, 7, 0))].\n\n"
    "Definition the_set (x _T : R) (a1 : point) : Prop :=\n"
    "  -15*deg <= x <= 15*deg /\\ near 0.1 (sin (2*pi*_T)) x /\\ in_ball 1 (1, 2, 3) a1.\n\n"
    "Theorem the_robot : forall (x _T : R) (a1 : point), the_set x _T a1 ->\n"
    "  full_column_rank 6 6 (gough legs (x, 0, 0) (euler_zxz 0 0 x)).\nProof.\n"
    "  intros x _T a1 S.\n  by_geometry the_claim [x; first a1 - (1)] 1 S.\nQed.\n\n"
    "Theorem the_set_is_inhabited : exists (x _T : R) (a1 : point), the_set x _T a1.\nProof.\n"
    "  exists 0, ((0 + 1)/2), (1, 2, 3).\n  by_point.\nQed.\n";

constexpr const char* kArm =
    "\nFrom Regulus Require Import Arms.\n\nDefinition arm (_q1 : R) : list part :=\n"
    "  [shift_by (0, 0, 0.5); revolute 1 (opposite z_axis) (_q1*deg);\n   along_x 0.1 (-pi/2)].\n\n"
    "Definition the_set (_q1 _q1'commanded : R) : Prop :=\n  0 <= _q1 <= 1.\n\n"
    "Theorem the_robot : forall (_q1 _q1'commanded : R), the_set _q1 _q1'commanded ->\n"
    "  full_column_rank 6 1 (jacobian (arm _q1)).\nProof.\n  intros _q1 _q1'commanded S.\n"
    "  by_arm the_claim [_q1] no_quantities 2 (0, 0, 0) [5] 1 S.\nQed.\n\n"
    "Theorem the_set_is_inhabited : exists (_q1 _q1'commanded : R), the_set _q1 _q1'commanded.\n"
    "Proof.\n  exists 0, 0.\n  by_point.\nQed.\n";

constexpr const char* kMatrix =
    "\nFrom Regulus Require Import Matrices.\n\n"
    "Definition the_matrix (_L _x : R) : nat -> nat -> R :=\n"
    "  let _a := 0.5 in\n  let _e1 := _x - _a in\n"
    "  matrix_of\n    [[_e1; _L];\n     [sqrt _e1; -1]].\n\n"
    "Definition the_set (_L _x : R) : Prop :=\n  near 0.1 3 _L /\\ 1 <= _x <= 2.\n\n"
    "Theorem the_robot : forall (_L _x : R), the_set _L _x ->\n"
    "  full_column_rank 2 2 (the_matrix _L _x).\nProof.\n  intros _L _x S.\n"
    "  at_point the_claim [_x; _L] S.\n  name_lets the_matrix.\n"
    "  by_matrix the_claim [(unnamed, 0); ((-1)*_e1, 1)] [[0; 0]; [1; 0]] S.\nQed.\n\n"
    "Theorem the_set_is_inhabited : exists (_L _x : R), the_set _L _x.\n"
    "Proof.\n  exists 3, 1.\n  by_point.\nQed.\n";

constexpr const char* kLegs =
    "\nFrom Regulus Require Import Legs.\n\nDefinition legs : list robot_leg :=\n"
    "  [RUS (1, 2, 0) (3, 4, 0) (0, -1, 0) 36 125 (-1); delta (1, 2, 0) (3, 4, 0) (0, 1, 0) 1 2 "
    "1].\n\n"
    "Definition the_set (_x : R) : Prop :=\n  0 <= _x <= 1.\n\n"
    "Theorem the_robot : forall (_x : R), the_set _x ->\n"
    "  full_column_rank 3 6 (in_space legs (_x, 0, 0) fixed).\nProof.\n  intros _x S.\n"
    "  at_point the_claim [_x] S.\n  open_legs.\n  name_leg as _1.\n  close_legs.\n"
    "  by_matrix the_claim [(unnamed, 0); ((-1)*_e_1_x, 1)] [[0; 0]; [1; 0]] S.\nQed.\n\n"
    "Theorem the_set_is_inhabited : exists (_x : R), the_set _x.\n"
    "Proof.\n  exists 0.\n  by_point.\nQed.\n";

/// The message for a text with `to` in the place of `from`; "" if it is found to be plain.
std::string refusal_of(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  try {
    (void)read_plain_theorem(text);
    return "";
  } catch (const verifier::Rejection& why) {
    return why.what();
  }
}

/// The same for the plain file.
std::string refusal(const std::string& from, const std::string& to) {
  return refusal_of(plain_theorem(), from, to);
}

/// The same for a plain file with theorems about a robot.
std::string refusal_of_robot(const std::string& from, const std::string& to) {
  return refusal_of(plain_theorem() + kRobot, from, to);
}

TEST(AnAudit, StatesTheClaimByWholePaths) {
  const auto theorem = read_plain_theorem(plain_theorem());
  EXPECT_EQ(refusal("", ""), "");
  EXPECT_EQ(theorem.statement, "no_singularity the_question");
  EXPECT_EQ(theorem.type, "Regulus.Questions.no_singularity RegulusAudited.audited.the_question");
  EXPECT_EQ(read_plain_theorem(plain_theorem("piecewise start\npiece 1\npiece 2\n")).type,
            "Coq.Lists.List.Forall (fun piece => Regulus.Questions.no_singularity ( "
            "RegulusAudited.audited.the_question piece)) RegulusAudited.audited.pieces");
}

constexpr const char* kOtherSentences[] = {
    "Notation no_singularity := (fun _ => True).",
    "Definition check_correct (q : question) (m : method) : true = true -> True := fun _ => I.",
    "Infix \"-\" := Add.",
    "Notation \"a - b\" := (Add a b) : expression_scope.",
    "Local Notation sin := Cos.",
    "Definition sin := Cos.",
    "Definition Name := Name.",
    "Definition _a : nat := Name 0.",
    "Definition _a := Pi.",
    "Definition the_question := 1.",
    "Let sin := Cos.",
    "Fixpoint f (n : nat) := n.",
    "Inductive False := .",
    "Set Bullet Behavior \"None\".",
    "Unset Guard Checking.",
    "Unset Universe Checking.",
    "#[bypass_check(guard)] Definition _a := Name 0.",
    "Load evil.",
    "Declare ML Module \"evil\".",
    "Axiom _a : no_singularity the_question.",
    "Parameter a : nat.",
    "Module Regulus.",
    "Module List.",
    "End List.",
    "Section s.",
    "Include Questions.",
    "Export Questions.",
    "Import Reals.",
    "Require Import evil.",
    "From Regulus Require Import Questions.",
    "Open Scope R_scope.",
    "Close Scope nat.",
    "Arguments Question {ranges}.",
    "Coercion a : b >-> c.",
    "Hint Resolve a.",
    "Add LoadPath \".\".",
    "Cd \"/\".",
    "Redirect \"f\" Print nat.",
    "Drop.",
    "Eval compute in 1.",
    "Reserved Notation \"a\".",
    "Number Notation expression f g : expression_scope.",
    "Bind Scope nat with expression.",
    "Delimit Scope nat with expression.",
    "Tactic Notation \"apply\" := idtac.",
    "Ltac apply := idtac.",
    "Canonical a.",
    "Existing Instance a.",
    "Ltac2 x := 1.",
    "Goal True.",
    "Lemma a : True.",
    "Example the_claim : True.",
    "Extraction a.",
    "From Coq Require Import List.",
    ". ."};

TEST(AnAudit, RefusesEverySentenceThatGivesAWordAnotherMeaning) {
  const std::string before = "(** The names";
  for (const char* sentence : kOtherSentences)
    EXPECT_NE(refusal(before, std::string(sentence) + "\n" + before), "") << sentence;
}

TEST(AnAudit, RefusesOtherImports) {
  EXPECT_NE(refusal("From Coq Require Import List.\n", ""), "");
  EXPECT_NE(refusal("From Coq Require Import List.", "From Evil Require Import List."), "");
  EXPECT_NE(refusal("From Regulus Require Import Notations.", "Require Import Notations."), "");
  EXPECT_NE(refusal("Import ListNotations.", "Import ListNotations Evil."), "");
}

TEST(AnAudit, RefusesOtherTheoremsAndProofs) {
  EXPECT_NE(refusal("no_singularity the_question.", "True."), "");
  EXPECT_NE(refusal("no_singularity the_question.", "no_singularity the_question \\/ True."), "");
  EXPECT_NE(refusal("the_claim : no", "the_claim : forall the_question, no"), "");
  EXPECT_NE(refusal("Theorem the_claim", "Theorem another"), "");
  EXPECT_NE(refusal("Qed.", "Admitted."), "");
  EXPECT_NE(refusal("Qed.", "Defined."), "");
  EXPECT_NE(refusal("Qed.", "Abort."), "");
  EXPECT_NE(refusal("vm_cast", "admit. vm_cast"), "");
  EXPECT_NE(refusal("apply (", "exact (fun _ => I"), "");
  EXPECT_NE(refusal("Qed.\n", "Qed.\nTheorem the_claim : True. Proof. exact I. Qed.\n"), "");
  EXPECT_NE(refusal("Qed.\n", "Qed"), "");
}

TEST(AnAudit, StatesTheTheoremsAboutARobot) {
  const auto theorem = read_plain_theorem(plain_theorem() + kRobot);
  ASSERT_EQ(theorem.geometry.size(), 2U);
  EXPECT_EQ(theorem.geometry[0].name, "the_robot");
  EXPECT_EQ(theorem.geometry[0].statement,
            "forall ( x _T : R ) ( a1 : point ) , the_set x _T a1 -> full_column_rank 6 6 ( gough "
            "legs ( x , 0 , 0 ) ( euler_zxz 0 0 x ) )");
  EXPECT_THAT(theorem.definitions, HasSubstr("Definition the_set ( x _T : R ) ( a1 : point ) :"));
  EXPECT_FALSE(theorem.may_be_empty);
  std::string shorter = plain_theorem() + kRobot;
  shorter.erase(shorter.find("Theorem the_set_is"));
  EXPECT_TRUE(read_plain_theorem(shorter).may_be_empty);
}

TEST(AnAudit, RefusesEverySentenceBesideTheTheoremsAboutARobot) {
  for (const char* before :
       {"From Regulus Require Import Geometry.", "Definition legs", "Definition the_set",
        "Theorem the_robot", "  intros x", "  by_geometry", "Theorem the_set_is", "  by_point"})
    for (const char* sentence : kOtherSentences)
      EXPECT_NE(refusal_of_robot(before, std::string(sentence) + "\n" + before), "") << sentence;
  for (const char* sentence : kOtherSentences)
    EXPECT_NE(refusal_of_robot("by_point.\nQed.", "by_point.\nQed.\n" + std::string(sentence)), "");
}

TEST(AnAudit, RefusesWordsWithoutAMeaningForARobot) {
  EXPECT_EQ(refusal_of_robot("", ""), "");
  EXPECT_NE(refusal_of_robot("(x, 0, 0)", "(y, 0, 0)"), "");
  EXPECT_NE(refusal_of_robot("[((-9", "[((_x"), "");
  EXPECT_NE(refusal_of_robot("[((-9", "[((x"), "");
  EXPECT_NE(refusal_of_robot("near 0.1", "close 0.1"), "");
  EXPECT_NE(refusal_of_robot("/\\ near", "\\/ near"), "");
  EXPECT_NE(refusal_of_robot("legs : list leg", "gough : list leg"), "");
  EXPECT_NE(refusal_of_robot("the_set (x _T : R)", "the_set (x sin : R)"), "");
  EXPECT_NE(refusal_of_robot("the_set (x _T : R)", "the_set (x x : R)"), "");
  EXPECT_NE(refusal_of_robot("forall (x _T : R)", "forall (_T x : R)"), "");
  EXPECT_NE(refusal_of_robot("the_set x _T a1 ->", "True ->"), "");
  EXPECT_NE(refusal_of_robot("full_column_rank 6", "the_question 6"), "");
  EXPECT_NE(refusal_of_robot("by_geometry", "admit; by_geometry"), "");
  EXPECT_NE(refusal_of_robot("by_point.\nQed.", "by_point.\nAdmitted."), "");
  EXPECT_NE(refusal_of_robot("Import Geometry.", "Import Geometry Evil."), "");
}

TEST(AnAudit, ReadsTheTheoremAboutAnArm) {
  const auto theorem = read_plain_theorem(plain_theorem() + kArm);
  ASSERT_EQ(theorem.geometry.size(), 2U);
  EXPECT_EQ(theorem.geometry_import, "From Regulus Require Import Arms.\n");
  EXPECT_THAT(theorem.definitions, HasSubstr("Definition arm ( _q1 : R ) : list part := ["));
}

TEST(AnAudit, RefusesWhatIsNoArm) {
  const auto refusal_of_arm = [](const std::string& from, const std::string& to) {
    return refusal_of(plain_theorem() + kArm, from, to);
  };
  for (const char* before : {"From Regulus Require Import Arms.", "Definition arm",
                             "Definition the_set", "Theorem the_robot", "  by_arm"})
    for (const char* sentence : kOtherSentences)
      EXPECT_NE(refusal_of_arm(before, std::string(sentence) + "\n" + before), "") << sentence;
  EXPECT_NE(refusal_of_arm("Import Arms.", "Import Arms Evil."), "");
  EXPECT_NE(refusal_of_arm("Import Arms.", "Import Geometry."), "");
  EXPECT_NE(refusal_of_arm("list part", "list leg"), "");
  EXPECT_NE(refusal_of_arm("arm (_q1 : R)", "arm (revolute : R)"), "");
  EXPECT_NE(refusal_of_arm("arm (_q1 : R)", "jacobian (_q1 : R)"), "");
  EXPECT_NE(refusal_of_arm("(_q1*deg)", "(_q2*deg)"), "");
  EXPECT_NE(refusal_of_arm("shift_by", "twist_of"), "");
  EXPECT_NE(refusal_of_arm("jacobian (arm _q1)", "gough (arm _q1)"), "");
  EXPECT_NE(refusal_of_arm("jacobian (arm _q1)", "legs (arm _q1)"), "");
  EXPECT_NE(refusal_of_arm("  by_arm", "  admit; by_arm"), "");
  EXPECT_NE(refusal_of_arm("0 <= _q1 <= 1", "arm _q1 <= 1"), "");
}

TEST(AnAudit, ReadsTheTheoremAboutAMatrix) {
  const auto theorem = read_plain_theorem(plain_theorem() + kMatrix);
  ASSERT_EQ(theorem.geometry.size(), 2U);
  EXPECT_EQ(theorem.geometry_import, "From Regulus Require Import Matrices.\n");
  EXPECT_THAT(theorem.definitions, HasSubstr("let _a := 0.5 in let _e1 := _x - _a in matrix_of ["));
  EXPECT_EQ(theorem.geometry[0].statement,
            "forall ( _L _x : R ) , the_set _L _x -> full_column_rank 2 2 ( the_matrix _L _x )");
}

TEST(AnAudit, RefusesWhatIsNoMatrix) {
  const auto refusal_of_matrix = [](const std::string& from, const std::string& to) {
    return refusal_of(plain_theorem() + kMatrix, from, to);
  };
  for (const char* before :
       {"From Regulus Require Import Matrices.", "Definition the_matrix", "Definition the_set",
        "Theorem the_robot", "  at_point", "  by_matrix"})
    for (const char* sentence : kOtherSentences)
      EXPECT_NE(refusal_of_matrix(before, std::string(sentence) + "\n" + before), "") << sentence;
  EXPECT_NE(refusal_of_matrix("Import Matrices.", "Import Matrices Evil."), "");
  EXPECT_NE(refusal_of_matrix("Import Matrices.", "Import Geometry."), "");
  EXPECT_NE(refusal_of_matrix("nat -> nat -> R :=", "nat -> nat -> nat :="), "");
  EXPECT_NE(refusal_of_matrix("the_matrix (_L _x : R)", "matrix_of (_L _x : R)"), "");
  EXPECT_NE(refusal_of_matrix("the_matrix (_L _x : R)", "the_matrix (_L sin : R)"), "");
  EXPECT_NE(refusal_of_matrix("let _a :=", "let sin :="), "");
  EXPECT_NE(refusal_of_matrix("let _a :=", "let _ :="), "");
  EXPECT_NE(refusal_of_matrix("let _e1 :=", "let _a :="), "");
  EXPECT_NE(refusal_of_matrix("let _e1 :=", "let _x :="), "");
  EXPECT_NE(refusal_of_matrix("let _e1 := _x", "let _e1 := _e1"), "");
  EXPECT_NE(refusal_of_matrix("let _a := 0.5 in", "let _a := let _b := 1 in _b in"), "");
  EXPECT_NE(refusal_of_matrix("let _a := 0.5 in", "let _a : R := 0.5 in"), "");
  EXPECT_NE(refusal_of_matrix("let _a := 0.5 in", "let _a := the_set in"), "");
  EXPECT_NE(refusal_of_matrix("[[_e1; _L]", "[[_y; _L]"), "");
  EXPECT_NE(refusal_of_matrix("matrix_of\n", "full_column_rank\n"), "");
  EXPECT_NE(refusal_of_matrix("(the_matrix _L _x)", "(the_inverse_jacobian _L _x)"), "");
  EXPECT_NE(refusal_of_matrix("(the_matrix _L _x)", "(scaled [] (the_matrix _L _x))"), "");
  EXPECT_NE(refusal_of_matrix("  by_matrix", "  admit; by_matrix"), "");
}

TEST(AnAudit, ReadsTheTheoremAboutLegs) {
  const auto theorem = read_plain_theorem(plain_theorem() + kLegs);
  ASSERT_EQ(theorem.geometry.size(), 2U);
  EXPECT_EQ(theorem.geometry_import, "From Regulus Require Import Legs.\n");
  EXPECT_EQ(theorem.geometry[0].statement,
            "forall ( _x : R ) , the_set _x -> full_column_rank 3 6 ( in_space legs ( _x , 0 , 0 ) "
            "fixed )");
}

TEST(AnAudit, RefusesWhatIsNoLeg) {
  const auto refusal_of_legs = [](const std::string& from, const std::string& to) {
    return refusal_of(plain_theorem() + kLegs, from, to);
  };
  for (const char* before : {"From Regulus Require Import Legs.", "Definition legs",
                             "Definition the_set", "Theorem the_robot", "  open_legs"})
    for (const char* sentence : kOtherSentences)
      EXPECT_NE(refusal_of_legs(before, std::string(sentence) + "\n" + before), "") << sentence;
  EXPECT_NE(refusal_of_legs("Import Legs.", "Import Legs Evil."), "");
  EXPECT_NE(refusal_of_legs("Import Legs.", "Import Geometry."), "");
  EXPECT_NE(refusal_of_legs("list robot_leg", "list leg"), "");
  EXPECT_NE(refusal_of_legs("Definition legs :", "Definition delta :"), "");
  EXPECT_NE(refusal_of_legs("[RUS (1", "[crank_vector (1"), "");
  EXPECT_NE(refusal_of_legs("[RUS (1", "[RUS (_x"), "");
  EXPECT_NE(refusal_of_legs("in_space legs", "gough legs"), "");
  EXPECT_NE(refusal_of_legs("in_space legs", "in_space rows_of"), "");
  EXPECT_NE(refusal_of_legs("  by_matrix", "  admit; by_matrix"), "");
}

TEST(AnAudit, RefusesTextThatIsNotReadAsItLooks) {
  EXPECT_THAT(refusal("(** The names", "(* \" *) Axiom a. (* \" *) (** The names"),
              HasSubstr("quotation mark"));
  EXPECT_THAT(refusal("(** The names", "(** The \xE2\x80\xAE names"), HasSubstr("hide text"));
  EXPECT_NE(refusal("(** The names", "(** The \x0C names"), "");
  EXPECT_NE(refusal("(** The names", "(** (* The names"), "");
  EXPECT_NE(refusal("_e1 - 0.5", "_e1 \xE2\x88\x92 0.5"), "");  // a minus sign
  EXPECT_NE(refusal("_e1 - 0.5",
                    "_\xD0\xB5"
                    "1 - 0.5"),
            "");  // a Cyrillic letter
  EXPECT_NE(refusal("_e1 - 0.5", "_e1\t- 0.5"), "");
  EXPECT_NE(refusal("_e1 - 0.5", "_e1 - 0.5\r"), "");
  EXPECT_NE(refusal("_e1 - 0.5", "_e1 - ltac:(exact 1)"), "");
  EXPECT_NE(refusal("_e1 - 0.5", "let x := 1 in _e1"), "");
  EXPECT_NE(refusal("_e1 - 0.5", "_e1 - 2_e1"), "");
  EXPECT_NE(refusal("_e1 - 0.5", "_e2"), "");
  EXPECT_NE(refusal("_e1 - 0.5", "_"), "");
  EXPECT_NE(refusal("_e1 - 0.5", "the_claim"), "");
  EXPECT_NE(refusal("_e1 - 0.5", "Add 1 2"), "");
  EXPECT_NE(refusal("Definition _y :=", "Definition _x :="), "");
}

TEST(AnAudit, AllowsTheAxiomsOfTheLibraryAlone) {
  EXPECT_NO_THROW(check_assumptions("Closed under the global context\n"));
  EXPECT_NO_THROW(
      check_assumptions("Axioms:\nPrimFloat.add : a\n  -> b\nClassical_Prop.classic\n  : c\n"));
  for (const char* answer : {"", "Axioms:\nRegulusAudited.audited.a : False\n",
                             "Axioms:\nClassical_Prop.classical : c\n", "PrimFloat.add : a\n",
                             "Axioms:\nthe_claim is assumed to be guarded.\n",
                             "Axioms:\nPrimFloat.add : a\nfalse : False\n"})
    EXPECT_THROW(check_assumptions(answer), verifier::Rejection) << answer;
}

}  // namespace
}  // namespace regulus::detail::test
