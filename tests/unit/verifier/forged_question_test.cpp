// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates whose claims are true, about another question than that of the model file: the
// verifier's own readers tell them apart.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/certificate_texts.hpp"

namespace regulus::detail::test {
namespace {

using testing::HasSubstr;
using verifier::Outcome;
using verifier::Verification;

/// A model file of one row, and a certificate about it.
struct Pair {
  std::string rows = "x + 3", robot, geometry, motion = "x = [0, 1]", more;
  std::string head = kFullRank1, quantities, entry = "x + 3", after_entry, proof = kOneLeaf;
  std::string range = "0 : 1", name = "only";

  [[nodiscard]] std::string model() const {
    return "regulus = 1\nname = \"m\"\n[pose]\nx = \"m\"\n[geometry]\n" + geometry +
           "\n[matrix]\nrows = [[\"" + rows + "\"]]\n" + robot + "\n[motion.only]\n" + motion +
           "\n" + more;
  }
  [[nodiscard]] std::string certificate() const {
    return "regulus-certificate 1\n" + head + "model m\nsha256 -\nmotion " + name +
           "\nalpha 0\nparameter x in " + range + "\n" + quantities +
           "pose x = x\nmatrix 1 1\nentry " + entry + "\n" + after_entry + proof;
  }
};

Verification verify(const Pair& p, bool with_model = true) {
  verifier::Options options;
  options.model_name = "model.toml";
  if (with_model) options.model_text = p.model();
  return verify_text(p.certificate(), options);
}

void expect_verified(const Pair& p) {
  const Verification v = verify(p);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << v.reason << p.certificate();
}

/// The claim is true, so that the certificate is verified without a model.
void expect_forged(const Pair& p, Outcome outcome, const std::string& reason) {
  const Verification alone = verify(p, false);
  EXPECT_EQ(alone.outcome, Outcome::kVerified) << alone.reason << p.certificate();
  const Verification v = verify(p);
  EXPECT_EQ(v.outcome, outcome) << v.reason << p.certificate();
  EXPECT_THAT(v.reason, HasSubstr(reason));
}

void expect_rejected(const Pair& p, const std::string& reason) {
  expect_forged(p, Outcome::kRejected, reason);
}

/// No fixed set of points decides: these are the points of an earlier version.
TEST(AForgedEntry, DiffersByAPolynomialThatVanishesAtSomePoints) {
  Pair p;
  expect_verified(p);
  p.entry = "x + 3 + (x - 13/97)*(x - 42/97)*(x - 71/97)*(x - 3/97)";
  expect_rejected(p, "x + 3");
  p.rows = "x + 3 + (x - 13/97)*(x - 42/97)*(x - 71/97)*(x - 3/97)";
  expect_verified(p);
  p.entry = "x + 3";
  expect_rejected(p, "is 'x + 3 + (x - 13/97)");
  p.entry = "x + 3 + sin(x)*cos(x)*(x - 1/2)/10";
  p.rows = "x + 3";
  expect_rejected(p, "sin(x)");
}

TEST(AForgedEntry, IsUnfinishedIfAtomsMayDepend) {
  Pair p;
  // They are equal, by a relation that the algebra does not know.
  p.rows = "exp(log(x + 1)) + 2", p.after_entry = "defined log(x + 1)\n";
  expect_forged(p, Outcome::kUnfinished, "algebra does not decide");
}

TEST(AForgedSet, IsABallWhereTheFileHasABox) {
  Pair p;
  p.rows = "x + 3 + p_1 + p_2", p.entry = "x + 3 + p_1 + p_2";
  p.head.replace(p.head.find("pose of"), 7, "pose and value of the 2 uncertain quantities of");
  p.quantities = "uncertain p_1 = 0 +- 1/10\nuncertain p_2 = 0 +- 1/10\n";
  const std::string ball = p.quantities + "ball p_1 p_2\n";
  p.geometry = "p = { value = [0, 0], tolerance = 0.1 }";
  expect_verified(p);
  p.quantities = ball;
  expect_rejected(p, "a line 'ball' with p_1");
  p.geometry = "p = { value = [0, 0], radius = 0.1 }";
  expect_verified(p);
  p.quantities.erase(p.quantities.find("ball"));
  expect_rejected(p, "declares a ball with p_1");
}

TEST(AForgedSet, HasAToleranceThatTheFileDoesNotDeclare) {
  Pair p;
  p.rows = "x + 3 + u", p.entry = "x + 3 + u";
  p.geometry = "u = { value = 0, tolerance = 0.1 }";
  p.quantities = "constant u = 0\n";
  expect_rejected(p, "geometry.u.tolerance is '0.1', but the certificate has '0'");
  p.geometry = "u = 0";
  expect_verified(p);
  p.head.replace(p.head.find("pose of"), 7, "pose and value of the 1 uncertain quantities of");
  p.quantities = "uncertain u = 0 +- 1/10\n";
  expect_rejected(p, "is '0', but the certificate has '1/10'");
}

/// Only the entries are those of the file: the force is 10 times as large.
TEST(AForgedScale, IsMissingInAClaimAboutForces) {
  Pair p;
  p.rows = "1", p.entry = "1", p.robot = R"(row_scale = ["1/10"]
twist = ["v_x"])";
  p.more = "[actuators]\nforce = [-1.01, 1.01]\n[load.push]\nwrench = [[-1, 1]]\n";
  p.head =
      "verdict FEASIBLE\nclaim at every pose of the variety, the full 1x1 matrix of the model is "
      "defined, and forces within the limits hold every wrench of the load\n";
  p.after_entry = "load push\nwrench 0 +- 1\nlimits -101/100 : 101/100\n";
  p.proof = "proof\nl 0 feasible\nend 1\n";
  expect_rejected(p, "matrix.row_scale[0] is '1/10', but the certificate has no line 'scale 0'");
  p.robot = R"(twist = ["v_x"])";
  expect_verified(p);
  p.after_entry.insert(0, "scale 2\n");
  expect_rejected(p, "states 'scale' '2', which the file does not have");
  p.after_entry.erase(0, 8);
  p.more = "[load.push]\nwrench = [[-1, 1]]\n";
  expect_rejected(p, "states 'least'");
}

TEST(AForgedScale, IsMissingInABoundOfAForceOrADeterminant) {
  Pair p;
  p.rows = "1", p.entry = "1", p.robot = R"(row_scale = ["1/10"])";
  p.more = "[load.push]\nwrench = [1]\n";
  p.head = "verdict NO SINGULARITY\nclaim |det J^-1| > 1/2 at every pose of the variety\n";
  p.after_entry = "quantity determinant\nside least\nreference 0\nbound 1/2\n";
  expect_rejected(p, "no line 'scale 0'");
  p.head =
      "verdict NO SINGULARITY\nclaim |force in row 1 under the load push| < 101/100 at every pose "
      "of "
      "the variety and every vector of it\n";
  p.after_entry =
      "quantity force\nside absolute\nrow 1\nload push\nwrench 1 +- 0\nreference 0\nbound "
      "101/100\n";
  expect_rejected(p, "no line 'scale 0'");
  p.robot = "";
  expect_verified(p);
}

/// x/x means nothing at 0, and x = 0 is a pose.
TEST(AForgedClaim, HasNoConditionThatTheFileNeeds) {
  Pair p;
  p.rows = "x/x", p.motion = "x = [-1, 1]";
  p.entry = "1", p.range = "-1 : 1";
  expect_forged(p, Outcome::kUnfinished,
                "matrix.rows[0][0], line 8 has a division by an expression that may be 0");
  p.motion = "x = [1, 2]", p.range = "1 : 2", p.after_entry = "defined 1/(2*x)\n";
  expect_verified(p);
  p.rows = "1";
  expect_forged(p, Outcome::kUnfinished, "'defined 1/(2*x)', follows from no expression");
}

TEST(AForgedClaim, NeedsTheConditionsOfEveryKindOfOperation) {
  for (const char* part : {"sqrt(x)", "x^0.5", "log(x)", "asin(x)", "acos(x)", "tan(x)", "1/x",
                           "x^(-2)", "x^(1/3)", "x^0.25", "atan2(x - 1, x)"}) {
    Pair p;
    p.rows = "1 + 0*" + std::string(part);
    p.entry = "1", p.motion = "x = [0.25, 0.5]", p.range = "1/4 : 1/2";
    expect_forged(p, Outcome::kUnfinished, "no line 'defined'");
    p.rows = "1", p.motion += "\nconstraints = [\"-1 + 0*" + std::string(part) + "\"]";
    p.after_entry = "constraint -1\n";
    expect_forged(p, Outcome::kUnfinished, "no line 'defined'");
  }
  Pair p;
  p.rows = "1", p.entry = "1", p.robot = R"(row_scale = ["x + 1"])";
  p.after_entry = "scale x + 1\n";
  expect_forged(p, Outcome::kUnfinished,
                "matrix.row_scale[0] has a logarithm, a power or a factor");
  p.after_entry += "defined log(x + 1)\n";
  expect_verified(p);
}

TEST(AForgedSet, HasAConstraintThatCutsTheSingularPoseAway) {
  Pair p;
  p.rows = "x - 1/2", p.entry = "x - 1/2";
  p.after_entry = "constraint 3/4 - x\n";
  p.proof = "proof\ns 0 0 0x1.4p-1\nl 1 outside\nl 2 mean-value\nend 2\n";
  expect_rejected(p, "states 'constraint' '3/4 - x', which the file does not have");
  p.motion = "x = [0, 1]\nconstraints = [\"0.75 - x\"]";
  expect_verified(p);
  p.motion = "x = [0, 1]\nconstraints = [\"0.75 - x\", \"x - 9\"]";
  expect_rejected(p, "constraints[1] is 'x - 9', but the certificate has no such constraint");
}

TEST(AForgedSet, IsThatOfAMotionThatTheFileDoesNotHave) {
  Pair p;
  p.name = "other";
  expect_rejected(p, "the file has no motion 'other'");
  p.more = "[motion.other]\nx = [0, 2]\n";
  expect_rejected(p, "motion.other.x[1] is '2', but the certificate has '1'");
  p.more = "[motion.other]\nx = [0, 1]\n";
  expect_verified(p);
}

/// A label is a key of the file, and no part of a longer one.
TEST(AForgedSet, IsThatOfAPartOfAMotionOrOfALoad) {
  Pair p;
  p.motion = "x = [0, 2]\nerror = { x = 0.5 }", p.name = "only.error";
  p.range = "0 : 1";
  EXPECT_THAT(verify(p).reason, HasSubstr("the file has no motion 'only.error'"));
  p = {};
  p.rows = "1", p.entry = "1", p.robot = "twist = [\"v_x\"]";
  p.more = "[actuators]\nforce = [-1, 1]\n[load.push]\nforce = [[-9, 9]]\n";
  p.head =
      "verdict FEASIBLE\nclaim at every pose of the variety, the full 1x1 matrix of the model is "
      "defined, and forces within the limits hold every wrench of the load\n";
  p.after_entry = "load push.force\nwrench 0 +- 0\nlimits -1 : 1\n";
  p.proof = "proof\nl 0 feasible\nend 1\n";
  expect_rejected(p, "it has no load 'push.force'");
}

TEST(AForgedSet, HasAParameterAnErrorOrAPoseOfItsOwn) {
  Pair p;
  p.quantities = "parameter T in 0 : 1\n";
  expect_rejected(p, "states 'lower' '0', which the file does not have");
  p.quantities = "pose y = 2\n";
  expect_rejected(p, "states 'pose' '2', which the file does not have");
  p.quantities = "constant c = 2\n";
  expect_forged(p, Outcome::kUnfinished, "states 'value' '2', with which no value");
  p.quantities = "";
  p.motion += "\nerror = { x = 0.1 }";
  expect_rejected(p, "motion.only.error.x is '0.1', but the certificate has '0'");
}

/// A factor of a determinant changes no rank, but the number that is claimed.
TEST(AForgedClaim, IsABoundOfTheMatrixOfAnArm) {
  verifier::Options options;
  options.model_name = "arm.toml";
  options.model_text =
      "regulus = 1\nname = \"arm\"\n[serial]\njoints = [{ name = \"q1\" }, { name = \"q2\", xyz = "
      "[1, 0, 0] }, { name = \"q3\", xyz = [1, 0, 0] }]\n[motion.only]\nq1 = 0\nq2 = [1, 2]\nq3 = "
      "0\n";
  const auto certificate = [](const std::string& head, const std::string& quantity) {
    return "regulus-certificate 1\n" + head +
           "model arm\nsha256 -\nmotion only\nalpha 0\nparameter q2 in 1 : 2\npose q1 = 0\npose q2 "
           "= "
           "q2\npose q3 = 0\nmatrix 3 3\nentry 5*sin(q2)\nentry 0\nentry 0\nentry 0\nentry "
           "1\nentry "
           "0\nentry 0\nentry 0\nentry 1\n" +
           quantity + kOneLeaf;
  };
  const std::string regular = certificate(
      "verdict NO SINGULARITY\nclaim the full 3x3 matrix of the model is defined and has full rank "
      "at "
      "every pose of the variety\n",
      "");
  EXPECT_EQ(verify_text(regular, options).outcome, Outcome::kVerified);
  const std::string verdict = "verdict NO SINGULARITY\nclaim ";
  for (const std::string& bound :
       {certificate(verdict + "|det J^-1| > 3 at every pose of the variety\n",
                    "quantity determinant\nside least\nreference 0\nbound 3\n"),
        certificate(verdict +
                        "largest singular value of J^-1 with the factors of its columns < 9 at "
                        "every pose of the variety\n",
                    "quantity sigma-max\nside largest\nfactor 1\nfactor 1\nfactor 1\nreference "
                    "0\nbound 9\n")}) {
    EXPECT_EQ(verify_text(bound).outcome, Outcome::kVerified) << verify_text(bound).reason;
    const Verification v = verify_text(bound, options);
    EXPECT_EQ(v.outcome, Outcome::kUnfinished) << v.reason;
    EXPECT_THAT(v.reason, HasSubstr("only expressions of an arm can be bounded"));
  }
}

/// A `let` that nothing uses must not make a pose one out of reach.
TEST(AForgedSet, LeavesOutPosesByARootThatTheFileDoesNotHave) {
  Pair p;
  p.rows = "x - 1/2", p.motion = "x = [0, 1]\nwhere = \"reachable\"";
  p.entry = "x - 1/2", p.quantities = "";
  p.after_entry = "reach x - 3/4\n";
  p.head.replace(p.head.find("every pose"), 10, "every reachable pose");
  p.proof = "proof\ns 0 0 0x1.4p-1\nl 1 outside\nl 2 mean-value\nend 2\n";
  std::string text = p.certificate();
  text.insert(text.find("matrix 1 1"), "let e1 = sqrt(x - 3/4)\n");
  EXPECT_EQ(verify_text(text).outcome, Outcome::kVerified) << verify_text(text).reason;
  verifier::Options options;
  options.model_name = "model.toml", options.model_text = p.model();
  const Verification v = verify_text(text, options);
  EXPECT_EQ(v.outcome, Outcome::kUnfinished) << v.reason;
  EXPECT_THAT(v.reason, HasSubstr("states 'reach' 'x - 3/4'"));
}

TEST(AForgedModel, HasKeysThatTheReaderDoesNotKnow) {
  for (const char* more : {"[else]\na = 1\n", "[motion.only.x_more]\na = 1\n"}) {
    Pair p;
    p.more = more;
    EXPECT_EQ(verify(p).outcome, Outcome::kUnfinished) << more;
  }
}

/// An option can make an error larger, never smaller.
TEST(AnOverride, ExcusesOnlyWhatOptionsCanChange) {
  Pair p;
  p.motion += "\nerror = { x = 0.1 }";
  verifier::Options options;
  options.model_name = "model.toml", options.model_text = p.model();
  options.all_overridden = true;
  const Verification smaller = verify_text(p.certificate(), options);
  EXPECT_EQ(smaller.outcome, Outcome::kRejected);
  EXPECT_THAT(smaller.reason, HasSubstr("a smaller one"));
  p.motion = "x = [0, 2]";
  options.model_text = p.model();
  const Verification range = verify_text(p.certificate(), options);
  EXPECT_EQ(range.outcome, Outcome::kVerified) << range.reason;
  EXPECT_EQ(range.differences.size(), 1U);
  p.rows = "x + 4";
  options.model_text = p.model();
  EXPECT_EQ(verify_text(p.certificate(), options).outcome, Outcome::kRejected);
}

}  // namespace
}  // namespace regulus::detail::test
