// SPDX-License-Identifier: GPL-3.0-or-later
// The text of a theorem about all configurations at one place. The test formal.solutions lets Coq prove
// such texts.
#include "runtime/formal/coq_solutions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "runtime/formal/coq_audit.hpp"
#include "runtime/formal/coq_proof.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::detail::test {
namespace {

using ::testing::HasSubstr;

std::string list_of(const std::string& verdict, const std::string& claim, const std::string& body) {
  std::istringstream file("regulus-certificate 1\nverdict " + verdict + "\nclaim " + claim +
                          "\nmodel m\nsha256 -\nmotion at\n" + body + "proof\nend\n");
  return verifier::coq_proof(file);
}

constexpr const char* kMechanism = "a mechanism with these equations and ranges of its unknowns ";
constexpr const char* kRoots =
    "alpha 0\nconstant a = 2\npose t = 1\nunknown p = 0 +- 4\nequation p^2 - a*t\n";

TEST(ATheoremAboutAllSolutions, HasEachLineInDecimalsAroundIt) {
  const std::string text =
      list_of("COMPLETE",
              std::string(kMechanism) + "has exactly 1 configuration, within the line 'solution'",
              std::string(kRoots) + "solution 0x1.6p+0:0x1.7p+0\n");
  EXPECT_THAT(text, HasSubstr("Search Closures Tubes Branches Solutions.\n"));
  EXPECT_THAT(text, HasSubstr("looked for: within a radius of a value"));
  // 1.375 and 1.4375
  EXPECT_THAT(text, HasSubstr("the_solutions : list line :=\n  [[(1.375, 1.438)]].\n"));
  EXPECT_THAT(text, HasSubstr("Theorem the_claim : all_solutions the_closure the_solutions.\n"));
  EXPECT_EQ(verifier::read_plain_theorem(text).type.substr(0, 33),
            "Regulus.Closures.all_solutions Re");
}

TEST(ATheoremAboutAllSolutions, RoundsEndsOutwardOnBothSidesOfZero) {
  const std::string claim =
      std::string(kMechanism) + "has exactly 2 configurations, one within each line 'solution'";
  const std::string text =
      list_of("COMPLETE", claim,
              std::string(kRoots) + "solution -0x1.7p+0:-0x1.6p+0\nsolution -0x1p-10:0x1.8p-10\n");
  EXPECT_THAT(text, HasSubstr("[[(-1.438, -1.375)];\n   [(-0.001, 0.0015)]].\n"));
}

TEST(ATheoremAboutAllSolutions, OfNoneHasAnEmptyListAndOfSomeAnotherClaim) {
  EXPECT_THAT(list_of("NONE", std::string(kMechanism) + "has no configuration", kRoots),
              HasSubstr("the_solutions : list line :=\n  [].\n"));
  EXPECT_THAT(
      list_of("INCOMPLETE",
              std::string(kMechanism) + "has at least 1 configuration, within the line 'solution'",
              std::string(kRoots) + "solution 0x1.6p+0:0x1.7p+0\n"),
      HasSubstr("Theorem the_claim : some_solutions the_closure the_solutions.\n"));
}

TEST(ATheoremAboutAllSolutions, HasAnEquationForEachLegInThePlane) {
  const std::string text = list_of(
      "COMPLETE",
      "at every value of the 2 uncertain quantities, a platform on three legs in the plane with "
      "these anchors and lengths has exactly 1 pose, within the line 'solution'",
      "constant phi = 3\nuncertain a = 5 +- 1/8\nleg 0 | 0 | 0 | 0 | 9\n"
      "leg a | 0 | phi | 1/2 | 4 +- 1/4\nleg 0 | a | 0 | 2 | 16\n"
      "solution 0x1p+0:0x1.8p+0 0x1p+0:0x1.8p+0 0x1p-1:0x1p+0\n");
  EXPECT_THAT(text, HasSubstr("[(_x)^2 + (_y)^2 - 9;\n   (_x + _phi * cos(_phi_) - (1/2) * "
                              "sin(_phi_) - _a)^2 + (_y + _phi * sin(_phi_) + (1/2) * "
                              "cos(_phi_))^2 - _square_1;\n"));
  EXPECT_THAT(text, HasSubstr("(* _square_1 *) within (4) (1/4)]"));
  EXPECT_THAT(text, HasSubstr("(* _phi_ *) (768/1024, pi)]"));
}

TEST(ATheoremAboutAllSolutions, IsNotWrittenOfSixLegsThatWereSearched) {
  std::string legs;
  for (int leg = 0; leg < 6; ++leg) legs += "leg 0 | 0 | 0 | 0 | 0 | 0 | 1\n";
  EXPECT_THROW(
      static_cast<void>(list_of(
          "NONE", "a platform on six legs with these anchors and lengths has no pose", legs)),
      verifier::Unfinished);
}

}  // namespace
}  // namespace regulus::detail::test
