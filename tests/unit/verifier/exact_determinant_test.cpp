// SPDX-License-Identifier: GPL-3.0-or-later
// Tests cases that need exact algebra: margins near double roots, exact substitution, identities.
#include <gtest/gtest.h>

#include "tests/support/certificate_texts.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;

std::string claim(const std::string& size, bool singular, int uncertain = 0) {
  const std::string values =
      uncertain == 0 ? ""
                     : " and value of the " + std::to_string(uncertain) + " uncertain quantities";
  std::string text = "verdict ";
  text += singular ? "SINGULARITY" : "NO SINGULARITY";
  text += "\nclaim the full " + size + " matrix of the model ";
  text += singular ? "is singular at some pose" : "is defined and has full rank at every pose";
  return text + values + " of the variety\n";
}

/// Returns a question about a matrix; `variables`: the lines from parameter to pose.
std::string question(const std::string& variables, const std::vector<std::string>& entries,
                     bool singular = false, int uncertain = 0) {
  const std::string order = entries.size() == 1 ? "1" : entries.size() == 4 ? "2" : "3";
  std::string text = "regulus-certificate 1\n" + claim(order + "x" + order, singular, uncertain) +
                     "model by hand\nsha256 -\nmotion only\nalpha 0\n" + variables + "matrix " +
                     order + ' ' + order + '\n';
  for (const std::string& entry : entries) text += "entry " + entry + '\n';
  return text;
}

Outcome of(const std::string& text) { return verify_text(text).outcome; }

/// Returns the matrix [[1, y], [x, x·y + e]], whose determinant is e.
std::vector<std::string> around(const std::string& e) {
  std::string last = "x*y + ";
  last += e;
  return {"1", "y", "x", last};
}

std::string range(const std::string& x) {
  return "parameter x in " + x + "\nparameter y in 1 : 3/2\npose x = x\npose y = y\n";
}

TEST(AMarginNextToADoubleRoot, IsSeenHoweverSmall) {
  for (const char* margin : {"1e-6", "1e-12", "1e-17", "1e-60", "1e-300"}) {
    const std::string far = std::string("(x^2 - 246912*x + 15241383936 + ") + margin + ")";
    EXPECT_EQ(of(question(range("123455 : 123457"), {far}) + kOneLeaf), Outcome::kVerified)
        << margin;
    EXPECT_EQ(of(question(range("123455 : 123457"), around(far)) + kOneLeaf), Outcome::kVerified)
        << margin;
    const std::string cubic = std::string("(x^3 - 3*x + 2 + ") + margin + ")";
    EXPECT_EQ(of(question(range("1/2 : 3/2"), around(cubic)) + kOneLeaf), Outcome::kVerified)
        << margin;
  }
}

/// Doubles leave every box across the line x = y + c undecided, because they round the smallest
/// value down.
TEST(AMarginAlongALine, IsSeenHoweverSmall) {
  const std::string line = "(x - y - 1/3)^2", plain = range("1 : 2");
  for (const char* margin : {"1e-16", "4e-22", "1e-100"})
    for (const std::string& f :
         {"log(1 + " + line + ")", "sqrt(1 + " + line + ") - 1", "atan" + line,
          "exp(" + line + ") - 1", "1 - 1/(1 + " + line + ")", std::string("abs(x - y - 1/3)")})
      EXPECT_EQ(of(question(plain, around("(" + f + " + " + margin + ")")) + kOneLeaf),
                Outcome::kVerified)
          << f << margin;
  for (const char* none : {"0", "(-1e-22)"})
    EXPECT_NE(of(question(plain, around("(log(1 + " + line + ") + " + none + ")")) + kOneLeaf),
              Outcome::kVerified);
}

TEST(AnArcCosine, IsThatOfTheOtherAngle) {
  const std::string sum = "(acos(x) + asin(x) - pi/2 + ", plain = range("1/10 : 6/10");
  EXPECT_EQ(of(question(plain, around(sum + "1e-12)")) + kOneLeaf), Outcome::kVerified);
  EXPECT_EQ(of(question(plain, around(sum + "1e-200)")) + kOneLeaf), Outcome::kVerified);
  EXPECT_NE(of(question(plain, around(sum + "0)")) + kOneLeaf), Outcome::kVerified);
  EXPECT_NE(of(question(range("1/10 : 11/10"), around(sum + "1)")) + kOneLeaf), Outcome::kVerified);
  const std::string turned = "(sin(2*acos(x)) - 2*x*sqrt(1 - x^2) + 1e-20)";
  EXPECT_EQ(of(question(plain, around(turned)) + kOneLeaf), Outcome::kVerified);
}

TEST(AnInverseFunctionAtASimpleValue, IsAPartOfPi) {
  const auto at = [](const std::string& x, const std::string& entry) {
    return of(scalar_question(entry, x + " : 1", kSingular1) +
              "proof\nreason small-determinant\npoint 0 " + x + "\nend\n");
  };
  for (const char* entry : {"asin(x) - pi/6", "acos(x) - pi/3", "asin(-x) + pi/6", "acos(2*x)",
                            "acos(-x) - 2*pi/3", "acos(-2*x) - pi", "asin(2*x) - pi/2",
                            "atan(2*x) - pi/4", "atan(-2*x) + pi/4", "acos(x - 1/2) - pi/2"})
    EXPECT_EQ(at("0.5", entry), Outcome::kVerified) << entry;
  for (const char* entry : {"asin(x) - pi/3", "acos(x) - pi/6", "atan(x) - pi/6", "acos(2*x) - pi"})
    EXPECT_NE(at("0.5", entry), Outcome::kVerified) << entry;
}

/// 10^400 and 10^700 are not doubles; their quotient is one, and so is the sum.
TEST(AQuotientOfIntegersBeyondDoubles, KeepsItsValue) {
  const std::string huge = '1' + std::string(400, '0'), larger = '1' + std::string(700, '0');
  const std::string tiny = huge + '/' + larger;
  EXPECT_EQ(of(question(range("1 : 2"), {"x - 1 + " + tiny}) + kOneLeaf), Outcome::kVerified);
  EXPECT_EQ(of(question(range("1 : 2"), {"x + " + larger + '/' + huge + " - 1e300"}) + kOneLeaf),
            Outcome::kVerified);
  EXPECT_NE(of(question(range("1 : 2"), {"x - 1 - " + tiny}) + kOneLeaf), Outcome::kVerified);
  EXPECT_NE(of(question(range("1 : 2"), {"x + 1/(" + tiny + " - " + tiny + ')'}) + kOneLeaf),
            Outcome::kVerified);
}

TEST(ADoubleRoot, IsNotVerifiedWithoutAMargin) {
  for (const char* e :
       {"(x^2 - 246912*x + 15241383936)", "(x^2 - 246912*x + 15241383936 - 1e-300)"})
    EXPECT_NE(of(question(range("123455 : 123457"), around(e)) + kOneLeaf), Outcome::kVerified)
        << e;
  EXPECT_NE(of(question(range("1/2 : 3/2"), around("(x^3 - 3*x + 2)")) + kOneLeaf),
            Outcome::kVerified);
  // A root at an end of the range, rational or not, is in the range.
  EXPECT_NE(of(question(range("1/3 : 1"), around("(3*x - 1)")) + kOneLeaf), Outcome::kVerified);
  EXPECT_NE(of(question(range("sqrt(2) : 2"), around("(x^2 - 2)")) + kOneLeaf), Outcome::kVerified);
}

TEST(AMarginAtAnEndOfARange, IsSeenHoweverSmall) {
  for (const char* margin : {"1e-9", "1e-17", "1e-300"}) {
    const std::string plus = std::string(" + ") + margin + ")";
    EXPECT_EQ(of(question(range("1/3 : 1"), around("(3*x - 1" + plus)) + kOneLeaf),
              Outcome::kVerified);
    EXPECT_EQ(of(question(range("sqrt(2) : 2"), around("(x^2 - 2" + plus)) + kOneLeaf),
              Outcome::kVerified);
    EXPECT_NE(of(question(range("sqrt(2) : 2"), around("(2 - x^2" + plus)) + kOneLeaf),
              Outcome::kVerified);
  }
}

TEST(ADoubleRootInTwoVariables, IsSeenByConvexity) {
  const std::string square = "(x^2 - 2/3*x + 1/9 + y^2 - 5/2*y + 25/16";
  EXPECT_EQ(of(question(range("0 : 1"), {square + " + 1e-300)"}) + kOneLeaf), Outcome::kVerified);
  EXPECT_NE(of(question(range("0 : 1"), {square + ")"}) + kOneLeaf), Outcome::kVerified);
  EXPECT_NE(of(question(range("0 : 1"), {square + " - 1e-300)"}) + kOneLeaf), Outcome::kVerified);
}

TEST(AParameterOfOneValue, IsReplacedByItExactly) {
  const auto thin = [](const std::string& x) { return range(x + " : " + x); };
  EXPECT_EQ(of(question(thin("1/3"), around("(3*x - 1 + 1e-17)")) + kOneLeaf), Outcome::kVerified);
  EXPECT_NE(of(question(thin("1/3"), around("(3*x - 1)")) + kOneLeaf), Outcome::kVerified);
  EXPECT_EQ(of(question(thin("sqrt(2)"), around("(x^2 - 2 + 1e-300)")) + kOneLeaf),
            Outcome::kVerified);
  EXPECT_NE(of(question(thin("sqrt(2)"), around("(x^2 - 2)")) + kOneLeaf), Outcome::kVerified);
}

TEST(AnIdentityOfAngles, IsApplied) {
  for (const char* e :
       {"sin(x)^2 + cos(x)^2 - 1", "sin(2*x) - 2*sin(x)*cos(x)",
        "cos(x + y) - cos(x)*cos(y) + sin(x)*sin(y)", "tan(x)*cos(x) - sin(x)",
        "sin(x + pi/6) - sqrt(3)/2*sin(x) - cos(x)/2", "exp(x + y) - exp(x)*exp(y)"}) {
    const std::string inside = std::string("(") + e;
    EXPECT_EQ(of(question(range("0 : 1"), around(inside + " + 1e-30)")) + kOneLeaf),
              Outcome::kVerified)
        << e;
    EXPECT_NE(of(question(range("0 : 1"), around(inside + ")")) + kOneLeaf), Outcome::kVerified)
        << e;
  }
}

TEST(AProofWithoutVariables, IsVerifiedOrNot) {
  const std::string none = "pose x = 1/3\npose y = sqrt(2)\n";
  EXPECT_EQ(of(question(none, around("(3*x - 1 + 1e-100)")) + kOneLeaf), Outcome::kVerified);
  EXPECT_EQ(of(question(none, around("(y^2 - 2)")) + kOneLeaf), Outcome::kUnfinished);
  EXPECT_EQ(of(question(none, {"0"}) + kOneLeaf), Outcome::kUnfinished);
  const std::string point = "proof\nreason always-singular\npoint 0\nend\n";
  EXPECT_EQ(of(question(none, around("(y^2 - 2)"), true) + point), Outcome::kVerified);
  EXPECT_EQ(of(question(none, around("(y^2 - 2 + 1e-300)"), true) + point), Outcome::kUnfinished);
}

TEST(ASingularityEverywhere, IsProvedByExactAlgebra) {
  const auto everywhere = [](const std::vector<std::string>& entries) {
    return of(question(range("0 : 3"), entries, true) +
              "proof\nreason always-singular\npoint 0 0x1p+0 0x1p+0\nend\n");
  };
  EXPECT_EQ(everywhere({"x - x"}), Outcome::kVerified);
  EXPECT_EQ(everywhere({"x", "2*x", "y", "2*y"}), Outcome::kVerified);
  EXPECT_EQ(everywhere({"sin(x)^2", "1 - cos(x)", "1 + cos(x)", "1"}), Outcome::kVerified);
  EXPECT_EQ(everywhere({"sqrt(x)", "x", "1", "sqrt(x)"}), Outcome::kVerified);
  EXPECT_EQ(everywhere({"1/(x + y)", "1/(x + 2*y)", "x + 2*y", "x + y"}), Outcome::kVerified);
}

/// The identity is wrong, or the matrix has no value at the point.
TEST(ASingularityEverywhere, IsNotVerifiedWhereTheIdentityIsWrong) {
  const auto everywhere = [](const std::vector<std::string>& entries,
                             const std::string& more = "") {
    return of(question(range("0 : 3"), entries, true) + more +
              "proof\nreason always-singular\npoint 0 0x1p+0 0x1p+0\nend\n");
  };
  for (const auto& entries :
       std::vector<std::vector<std::string>>{{"1e-300"},
                                             {"x - x + 1e-300"},
                                             {"x", "2*x", "y", "2*y + 1e-30"},
                                             {"sin(x)^2", "1 - cos(x)", "1 + cos(x)", "1 + 1e-300"},
                                             {"sqrt(x^2) + x"},
                                             {"0*sqrt(x - 2)"},
                                             {"0/(x - 1)"}})
    EXPECT_NE(everywhere(entries), Outcome::kVerified) << entries.back();
  EXPECT_NE(everywhere({"x - x"}, "constraint x - 1/2\n"), Outcome::kVerified);
  EXPECT_NE(everywhere({"x - x"}, "defined log(x - 2)\n"), Outcome::kVerified);
}

TEST(AWitnessAtAnEndThatIsADouble, LiesInTheRange) {
  const std::string variables = "parameter x in 0 : 1\nuncertain u = 0.3 +- 0.05\npose x = x\n";
  const auto at = [&](const std::string& u) {
    return verify_text(question(variables, {"u - 0.25"}, true, 1) +
                       "proof\nreason small-determinant\npoint 0 0x1p-1 " + u + "\nend\n");
  };
  EXPECT_EQ(at("0x1p-2").outcome, Outcome::kVerified);
  const auto outside = at("0x1.fffffffffffffp-3");
  EXPECT_EQ(outside.outcome, Outcome::kRejected);
  EXPECT_NE(outside.reason.find("outside the ranges"), std::string::npos);
}

TEST(APathThatTouchesAConstraintAtItsEnd, LiesInTheVariety) {
  const auto path = [](const std::string& constraint) {
    return of(question(range("-1 : 1"), {"x + 1/2 + 1e-30"}, true) + "constraint " + constraint +
              "\nproof\nreason opposite-signs\npoint + -0x1p-1 0x1p+0\npoint - "
              "-0x1.0000000000001p-1 0x1p+0\npath segment\nend\n");
  };
  EXPECT_EQ(path("1/4 - x^2"), Outcome::kVerified);
  EXPECT_NE(path("1/4 - x^2 + 1e-30"), Outcome::kVerified);
}

TEST(AVarietyWithoutPoses, IsSaidToBeEmpty) {
  const auto v = verify_text(scalar_question("x") + "constraint 1 + x^2\n" + kOneLeaf);
  EXPECT_EQ(v.outcome, Outcome::kUnfinished);
  EXPECT_NE(v.reason.find("no pose remains"), std::string::npos) << v.reason;
  // An old certificate of a variety that may have poses is verified; the note states the doubt.
  const auto open = verify_text(scalar_question("x") + "constraint (x - 4/3)^2\n" + kOneLeaf);
  EXPECT_EQ(open.outcome, Outcome::kVerified);
  EXPECT_NE(open.note.find("no pose was shown"), std::string::npos) << open.note;
  EXPECT_EQ(verify_text(scalar_question("x") + "constraint x - 9/4\n" + kOneLeaf).note, "");
}

TEST(ACommandedPose, MustHaveAValue) {
  const auto posed = [](const std::string& pose) {
    return of("regulus-certificate 1\n" + claim("1x1", false) +
              "model m\nsha256 -\nmotion only\nalpha 0\nparameter T in 0 : 1\npose x = " + pose +
              "\nmatrix 1 1\nentry 1\n" + kOneLeaf);
  };
  EXPECT_EQ(posed("1/(T + 1)"), Outcome::kVerified);
  EXPECT_EQ(posed("1/T"), Outcome::kUnfinished);
  EXPECT_EQ(posed("sqrt(T - 1/2)"), Outcome::kUnfinished);
}

TEST(ATimeLimit, LeavesAProofUnfinished) {
  verifier::Options options;
  options.time_limit = 1e-9;
  const auto v = verify_text(scalar_question("x") + kOneLeaf, options);
  EXPECT_EQ(v.outcome, Outcome::kUnfinished);
  EXPECT_NE(v.reason.find("time limit"), std::string::npos);
}

/// Algebra beyond its limit of terms, digits or powers stops, and other methods continue.
TEST(AlgebraBeyondItsBudget, StopsWithoutAProof) {
  for (const char* e : {"((x + y + 1)^60*(x - y + 2)^60)", "(x + y)^1000000", "(x^1000000)",
                        "(1e-4000*x)^64", "exp(x*1e4000)", "sqrt(x + y + 1)^99999"}) {
    const std::string last = std::string("(x - y)*") + e;
    EXPECT_NE(of(question(range("0 : 2"), around(last)) + kOneLeaf), Outcome::kVerified) << e;
  }
}

std::string singular_at(const std::string& x, const std::string& e, const std::string& point) {
  return question(range(x), around(e), true) + "proof\nreason small-determinant\npoint 0 " + point +
         "\nend\n";
}

TEST(ASingularityAtAnEndOfARange, IsProvedByExactAlgebra) {
  EXPECT_EQ(of(singular_at("1/3 : 1", "(3*x - 1)", "lower 0x1p+0")), Outcome::kVerified);
  EXPECT_EQ(of(singular_at("0 : 1/3", "(3*x - 1)^3", "upper upper")), Outcome::kVerified);
  EXPECT_EQ(of(singular_at("sqrt(2) : 2", "(x^2 - 2)", "lower lower")), Outcome::kVerified);
}

TEST(ASingularityAtAnEndOfARange, IsNotVerifiedWhereTheMatrixIsRegular) {
  EXPECT_NE(of(singular_at("1/3 : 1", "(3*x - 1 + 1e-300)", "lower 0x1p+0")), Outcome::kVerified);
  EXPECT_NE(of(singular_at("1/3 : 1", "(3*x - 1)", "upper 0x1p+0")), Outcome::kVerified);
  EXPECT_NE(of(singular_at("1/3 : 1", "(3*x - 1)/(3*x - 1)*0", "lower 0x1p+0")),
            Outcome::kVerified);
  const std::string excluded = question(range("1/3 : 1"), around("(3*x - 1)"), true) +
                               "constraint 1/2 - x\nproof\nreason small-determinant\n"
                               "point 0 lower 0x1p+0\nend\n";
  EXPECT_NE(of(excluded), Outcome::kVerified);
}

TEST(ARootOrLogarithmOfAProduct, IsThatOfItsFactorsWhereTheyHaveOne) {
  for (const char* zero : {"sqrt(x)*sqrt(y) - sqrt(x*y)", "log(x*y) - log(x) - log(y)"}) {
    const std::string e = std::string("(") + zero;
    EXPECT_EQ(of(question(range("1/3 : 2"), around(e + " + 1e-20)")) + kOneLeaf),
              Outcome::kVerified)
        << zero;
    EXPECT_NE(of(question(range("1/3 : 2"), around(e + ")")) + kOneLeaf), Outcome::kVerified);
    EXPECT_NE(of(question(range("-2 : -1"), around(e + " + 1e-20)")) + kOneLeaf),
              Outcome::kVerified);
  }
}

/// The constraint cuts the inner circle out of a ring.
Outcome beside_a_hole(const std::string& e) {
  const std::string square =
      "parameter x in -1 : 1\nparameter y in -1 : 1\npose x = x\npose y = y\n";
  return of(question(square, around(e)) + "constraint 1/4 - x^2 - y^2\n" + kOneLeaf);
}

TEST(ADeterminantNextToAConstraint, IsReducedByIt) {
  EXPECT_EQ(beside_a_hole("(x^2 + y^2 - 1/4 + 1e-30)"), Outcome::kVerified);
  EXPECT_EQ(beside_a_hole("(1/4 - 1e-30 - x^2 - y^2)"), Outcome::kVerified);
}

TEST(ADeterminantNextToAConstraint, IsNotReducedByItsNegative) {
  EXPECT_NE(beside_a_hole("(x^2 + y^2 - 1/4)"), Outcome::kVerified);
  EXPECT_NE(beside_a_hole("(x^2 + y^2 - 1/4 - 1e-30)"), Outcome::kVerified);
  EXPECT_NE(beside_a_hole("(1/4 + 1e-30 - x^2 - y^2)"), Outcome::kVerified);
}

}  // namespace
}  // namespace regulus::detail::test
