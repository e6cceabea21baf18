// SPDX-License-Identifier: GPL-3.0-or-later
// The judge of forgeries: what it calls the same question, and what another.
#include "tests/attack/forge/same_question.hpp"

#include <gtest/gtest.h>

namespace regulus::detail::attack {
namespace {

const std::string kRegularity = R"(regulus-certificate 1
verdict NO SINGULARITY
claim full rank
model m
sha256 00
size 2 2
parameter x in 1 : 2
parameter s in 0 : 1
uncertain e1 = 1/2 +- 1/10
constraint x - s
entry x
entry s*e1
entry 0 - s
entry x + e1
defined 1/x
proof
end
)";

const std::string kQuantity = R"(regulus-certificate 1
verdict NO SINGULARITY
claim bound
model m
sha256 00
size 1 1
parameter x in 1 : 2
entry x
quantity force
side largest
row 1
load s
wrench -40 +- 20
reference 0
bound 50
proof
end
)";

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_same(const std::string& verified, const std::string& asked) {
  EXPECT_EQ(difference(verified, asked), "") << verified;
}

void expect_another(const std::string& verified, const std::string& asked) {
  EXPECT_NE(difference(verified, asked), "") << verified;
}

TEST(ASet, IsTheSameWithItsBallsInAnotherOrder) {
  const std::string u = "uncertain e1 = 1/2 +- 1/10\n", v = "uncertain e2 = 0 +- 1/10\n";
  const auto with = [&](const std::string& balls) {
    return changed(kRegularity, u, u + v + balls);
  };
  expect_same(with("ball e1\nball e2\n"), with("ball e2\nball e1\n"));
  expect_another(with("ball e1\nball e2\n"), with("ball e1 e2\n"));
}

TEST(ASet, IsTheSameWithALineReachTwice) {
  const std::string once = changed(kRegularity, "constraint", "reach x + s\nconstraint");
  expect_same(changed(once, "reach x + s\n", "reach x + s\nreach x + s\n"), once);
  expect_another(changed(once, "reach x + s\n", "reach x + s\nreach x - s\n"), once);
  expect_same(kRegularity, once);
  expect_another(once, kRegularity);
}

TEST(SameQuestion, IsTheTextItself) {
  expect_same(kRegularity, kRegularity);
  expect_same(kQuantity, kQuantity);
}

TEST(SameQuestion, HasOtherNames) {
  std::string other = kRegularity;
  for (const auto& [from, to] :
       std::initializer_list<std::pair<const char*, const char*>>{{"parameter s", "parameter e1"},
                                                                  {"uncertain e1", "uncertain s"},
                                                                  {"x - s", "x - e1"},
                                                                  {"s*e1", "e1*s"},
                                                                  {"0 - s", "0 - e1"},
                                                                  {"x + e1", "x + s"}})
    other = changed(other, from, to);
  expect_same(other, kRegularity);
  expect_another(changed(other, "0 - e1", "0 - s"), kRegularity);
  expect_another(changed(kRegularity, "parameter s", "parameter t"), kRegularity);
}

TEST(SameQuestion, HasAnotherOrderOrShorthand) {
  expect_same(changed(kRegularity, "parameter x in 1 : 2\nparameter s in 0 : 1",
                      "parameter s in 0 : 1\nparameter x in 1 : 2"),
              kRegularity);
  expect_same(changed(kRegularity, "entry x\n", "let u = x\nentry u + 0\n"), kRegularity);
  expect_same(changed(kRegularity, "entry 0 - s\nentry x + e1", "entry -2*s\nentry 2*x + 2*e1"),
              kRegularity);
}

TEST(SameQuestion, IsAnotherForEachNumber) {
  for (const auto& [from, to] : std::initializer_list<std::pair<const char*, const char*>>{
           {"in 1 : 2", "in 1 : 2.0000000000000000000000000001"},
           {"in 0 : 1", "in 0 - 1/1000000 : 1"},
           {"+- 1/10", "+- 1/11"},
           {"= 1/2 +-", "= 1/3 +-"},
           {"constraint x - s", "constraint x - s - 1/1000000000"},
           {"constraint x - s\n", ""},
           {"entry x\n", "entry x + x*(x - 1)*(x - 2)*(2*x - 3)\n"},
           {"entry x + e1", "entry x + e1 + sqrt(s^2)"},
           {"entry 0 - s\nentry x + e1", "entry -2*s\nentry x + e1"},
           {"size 2 2", "size 4 1"},
           {"constraint", "reach"},
           {"entry x\n", "alpha 1/100\nentry x\n"}})
    expect_another(changed(kRegularity, from, to), kRegularity);
}

TEST(SameQuestion, KnowsWhatIsProvedToHaveAValue) {
  expect_another(kRegularity, changed(kRegularity, "entry x + e1", "entry x + e1 + 0/(x - 2)"));
  expect_another(changed(kRegularity, "defined 1/x\n", ""), kRegularity);
}

TEST(SameQuestion, OfAQuantityHasItsBoundLoadAndSide) {
  expect_same(changed(kQuantity, "reference 0", "reference 7"), kQuantity);
  for (const auto& [from, to] : std::initializer_list<std::pair<const char*, const char*>>{
           {"bound 50", "bound 51"},
           {"side largest", "side least"},
           {"row 1", "row 2"},
           {"load s", "load x"},
           {"-40 +- 20", "-40 +- 21"},
           {"-40 +- 20", "-41 +- 20"},
           {"quantity force", "quantity speed"},
           {"entry x", "entry 2*x"},
           {"entry x", "scale 2\nentry x"}})
    expect_another(changed(kQuantity, from, to), kQuantity);
}

TEST(SameQuestion, HasZeroTimesWhatever) {
  for (const char* zero : {"sqrt((0*x)^2) - 0*x", "0*sqrt(x + 2)", "0*sin(x)", "sqrt(0*cos(x))"})
    expect_same(changed(kRegularity, "entry x\n", "entry x + " + std::string(zero) + '\n'),
                kRegularity);
  expect_another(changed(kRegularity, "entry x\n", "entry x + sqrt(sin(x)^2) - 0.9*sin(x)\n"),
                 kRegularity);
}

TEST(SameQuestion, MayHaveWhatOptionsSet) {
  const std::string low = changed(kRegularity, "entry x\n", "alpha 1/100\nentry x\n"),
                    high = changed(kRegularity, "entry x\n", "alpha 1/10\nentry x\n");
  EXPECT_NE(difference(low, high), "");
  EXPECT_EQ(difference(low, high, {.alpha = true}), "");
  EXPECT_NE(difference(changed(low, "size 2 2", "size 1 4"), high, {.alpha = true}), "");
  const std::string wide = changed(kRegularity, "+- 1/10", "+- 1/5");
  EXPECT_EQ(difference(wide, kRegularity, {.tolerances = true}), "");
}

TEST(SameQuestion, HasPiecesOfTheSamePoses) {
  const std::string pieces =
      changed(changed(kRegularity, "parameter s in 0 : 1",
                      "parameter s in 0 : 1\npiecewise a r w\npiece 1 | 0 | 3\npiece 2 | 1/2 | 4"),
              "entry x\n", "entry x + a + r*cos(w*s)\n");
  expect_same(pieces, pieces);
  expect_same(changed(pieces, "piece 1 | 0 | 3", "piece 1 | 0 | 7"), pieces);
  expect_another(changed(pieces, "piece 2 | 1/2 | 4", "piece 2 | 1/2 | 7"), pieces);
  expect_another(changed(pieces, "piece 1 | 0 | 3", "piece 5/4 | 0 | 3"), pieces);
  expect_another(changed(pieces, "piece 1 | 0 | 3\n", ""), pieces);
  expect_another(
      changed(pieces, "piece 1 | 0 | 3\npiece 2 | 1/2 | 4", "piece 2 | 1/2 | 4\npiece 1 | 0 | 3"),
      pieces);
}

TEST(SameQuestion, OfAClosureHasItsEquationsAndStart) {
  const std::string closure =
      changed(changed(kRegularity, "entry x\nentry s*e1\nentry 0 - s\nentry x + e1\n",
                      "unknown p = 1 +- 1/2\nunknown q = 2 +- 1/2\nstart 1\nstart 0\n"
                      "equation p^2 - x\nequation q - p*s\n"),
              "size 2 2\n", "");
  expect_same(closure, closure);
  expect_same(changed(closure, "q - p*s", "q - s*p"), closure);
  for (const auto& [from, to] : std::initializer_list<std::pair<const char*, const char*>>{
           {"p^2 - x", "p^2 - x + 1/1000000"},
           {"p = 1 +- 1/2", "p = 1 +- 1/3"},
           {"q = 2 +-", "q = 3 +-"},
           {"start 1\nstart 0", "start 0\nstart 1"},
           {"equation q - p*s\n", ""}})
    expect_another(changed(closure, from, to), closure);
}

TEST(EqualFiles, DifferInTheSpellingOfNumbers) {
  EXPECT_TRUE(
      are_equal_files("a = 0\nb = [1.50, \"x1 - 0\"]\n", "a = 0.0\nb = [1.5, \"x1 - (-0)\"]\n"));
  EXPECT_FALSE(are_equal_files("a = 1.5\n", "a = 1.50000001\n"));
  EXPECT_FALSE(are_equal_files("a = x1\n", "a = x01\n"));
}

TEST(SameQuestion, IsNoneWithoutAMeaning) {
  expect_another(changed(kRegularity, "entry x\n", "entry\n"), kRegularity);
  expect_another(changed(kRegularity, "parameter x in 1 : 2", "parameter x"), kRegularity);
}

}  // namespace
}  // namespace regulus::detail::attack
