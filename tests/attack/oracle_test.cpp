// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the oracle: evaluating the text of each model must confirm what its family states.
#include <gtest/gtest.h>

#include <set>

#include "tests/attack/families/builder.hpp"
#include "tests/attack/families/families.hpp"
#include "tests/attack/oracle/confirm.hpp"
#include "tests/attack/oracle/evaluate.hpp"
#include "tests/attack/runner/outcome.hpp"

namespace regulus::detail::attack {

void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }

namespace {

constexpr std::uint64_t kSeeds = 60;

class EveryFamily : public testing::TestWithParam<Family> {};

TEST_P(EveryFamily, IsTrueOfItsModels) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Attack attack = GetParam().make(seed);
    const int samples = attack.model.hexapod ? 20 : seed == 0 ? 1000 : 60;
    EXPECT_EQ(refute_truth(attack, samples).value_or(""), "")
        << attack.family << ":" << seed << '\n'
        << attack.model.text();
  }
}

TEST_P(EveryFamily, SpellsItsRanges) {
  for (std::uint64_t seed = 0; seed < 4 * kSeeds; ++seed) {
    const Attack attack = GetParam().make(seed);
    EXPECT_EQ(refute_axes(attack).value_or(""), "") << attack.family << ":" << seed << '\n'
                                                    << attack.model.text();
  }
}

TEST_P(EveryFamily, IsTheSameForTheSameSeed) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Attack once = GetParam().make(seed), again = GetParam().make(seed);
    EXPECT_EQ(once.model.text(), again.model.text());
    EXPECT_EQ(once.options, again.options);
  }
  EXPECT_NE(GetParam().make(1).model.text(), GetParam().make(2).model.text());
}

/// The judge must detect a command that always gives the same answer.
TEST_P(EveryFamily, ContradictsALiar) {
  std::set<int> found_out;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed)
    for (const int lie : {0, 1}) {
      Outcome outcome;
      outcome.exit_code = lie;
      if (judge(GetParam().make(seed), outcome) == Judgement::kContradiction) found_out.insert(lie);
    }
  EXPECT_TRUE(found_out.contains(0)) << "NO SINGULARITY is never wrong";
}

/// Moves the planted point a little; the oracle must no longer confirm the singularity.
TEST_P(EveryFamily, IsNotConfirmedAtAnotherPoint) {
  if (std::string_view(GetParam().name) == "identity") GTEST_SKIP() << "singular everywhere";
  int doubts = 0, tried = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Attack attack = GetParam().make(seed);
    if (attack.truth != Truth::kSingular || attack.planted.empty()) continue;
    for (auto& [name, text] : attack.planted) text = "(" + text + ")*(1 + 1e-80) + 1e-80";
    for (Axis& axis : attack.axes) {
      axis.lo -= Rational(1);
      axis.hi += Rational(1);
    }
    ++tried;
    doubts += refute_truth(attack, 1) ? 1 : 0;
  }
  // Some models are singular everywhere.
  EXPECT_GE(4 * doubts, tried > 0 ? 1 : 0);
}

INSTANTIATE_TEST_SUITE_P(, EveryFamily, testing::ValuesIn(families().begin(), families().end()),
                         [](const auto& family) { return std::string(family.param.name); });

ListedSolutions listed(const std::string& verdict, std::vector<std::pair<double, double>> ends) {
  ListedSolutions list{verdict, {}};
  for (const auto& one : ends) list.solutions.push_back({{"x", one}});
  return list;
}

TEST(Lists, AreFalseIfTheyLackASolutionOrHaveAnother) {
  SolveTruth truth;
  truth.known = {{{"x", Rational(1, 3)}}, {{"x", Rational(2)}}};
  const std::pair<double, double> third{0.3333333, 0.3333334}, two{2, 2};
  EXPECT_FALSE(refute_list(truth, listed("complete", {third, two})));
  EXPECT_FALSE(refute_list(truth, listed("complete", {third, two, {5, 6}})));
  EXPECT_FALSE(refute_list(truth, listed("incomplete", {third})));
  EXPECT_TRUE(refute_list(truth, listed("complete", {third})));
  EXPECT_TRUE(refute_list(truth, listed("complete", {{0.33333334, 0.3334}, two})));
  EXPECT_TRUE(refute_list(truth, listed("none", {})));
  EXPECT_TRUE(refute_list(truth, listed("incomplete", {third, third})));
  EXPECT_TRUE(refute_list(truth, listed("incomplete", {{0, 3}})));
  truth.count = 2;
  EXPECT_TRUE(refute_list(truth, listed("complete", {third, two, {5, 6}})));
  EXPECT_TRUE(refute_list(truth, listed("incomplete", {{5, 6}})));
  truth.is_degenerate = true;
  EXPECT_TRUE(refute_list(truth, listed("complete", {third, two})));
}

TEST(Lists, CompareAnglesByTurnsAndRotationsByTheirSigns) {
  SolveTruth truth;
  truth.known = {{{"x", pi()}}};
  truth.periods["x"] = "2*pi";
  EXPECT_FALSE(refute_list(truth, listed("complete", {{-3.1415927, -3.1415926}})));
  EXPECT_TRUE(refute_list(truth, listed("complete", {{3.2, 3.3}})));
  truth.known = {{{"qw", Rational(3, 5)}, {"qx", Rational(-4, 5)}}};
  truth.has_opposites = true;
  EXPECT_FALSE(refute_list(truth, {"complete", {{{"qw", {-0.61, -0.59}}, {"qx", {0.79, 0.81}}}}}));
  EXPECT_TRUE(refute_list(truth, {"complete", {{{"qw", {-0.61, -0.59}}, {"qx", {-0.81, -0.79}}}}}));
}

TEST(Lists, LackWhatNewtonsMethodFinds) {
  SolveTruth truth;
  truth.near = {{{"x", 2}}};
  EXPECT_TRUE(refute_list(truth, listed("complete", {{1, 1}})));
  EXPECT_FALSE(refute_list(truth, listed("complete", {{1, 1}, {2, 2}})));
}

TEST(Families, AreAtLeastFifteenWithDifferentNames) {
  std::set<std::string> names;
  for (const Family& family : families()) names.insert(family.name);
  EXPECT_EQ(names.size(), families().size());
  EXPECT_GE(names.size(), 15U);
}

TEST(Families, HaveEveryTruth) {
  std::set<Truth> truths;
  for (const Family& family : families())
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) truths.insert(family.make(seed).truth);
  EXPECT_EQ(truths.size(), 6U);
}

TEST(Spelling, IsReadBackExactly) {
  Builder b("spelling", 1);
  for (int i = 0; i < 5000; ++i) {
    const Rational value = i % 3 == 0   ? Rational(b.random.between(-100000, 100000))
                           : i % 3 == 1 ? b.number()
                                        : b.excess();
    const std::string expression = spell_expression(value, b.random);
    EXPECT_EQ(evaluate(expression, {}).exact(), value) << expression;
    if (const auto bare = spell_bare(value, b.random)) {
      EXPECT_EQ(toml_number(*bare), value) << *bare;
    }
  }
}

TEST(Spelling, UsesEveryBaseAndSign) {
  Builder b("spelling", 2);
  std::string all;
  for (int i = 0; i < 2000; ++i)
    all += spell_bare(Rational(b.random.between(-500, 500)), b.random).value_or("") + " ";
  for (const char* part : {"0x", "0o", "0b", "_", "e", "E", " -", " +", ".0"})
    EXPECT_NE(all.find(part), std::string::npos) << part;
}

TEST(Evaluation, AgreesWithKnownValues) {
  const auto value = [](const char* text) { return evaluate(text, {}); };
  EXPECT_EQ(value("-2^2").exact(), Rational(-4));
  EXPECT_EQ(value("2^-3").exact(), Rational(1, 8));
  EXPECT_EQ(value("2^3^2").exact(), Rational(512));
  EXPECT_EQ(value("1 - 2 - 3").exact(), Rational(-4));
  EXPECT_EQ(value("12/3/2").exact(), Rational(2));
  EXPECT_EQ(value("1.5e-1").exact(), Rational(3, 20));
  EXPECT_EQ(value("(27/8)^(2/3)").exact(), Rational(9, 4));
  EXPECT_EQ(value("sqrt(1/4)").exact(), Rational(1, 2));
  EXPECT_TRUE(value("sin(pi)").is_zero_to(Rational(1)));
  EXPECT_TRUE((value("180*deg") - value("4*atan(1)")).is_zero_to(Rational(1)));
  for (const char* undefined :
       {"1/0", "0/0", "log(0)", "sqrt(-1e-300)", "asin(1 + 1e-300)", "tan(pi/2)", "atan2(0, -1)",
        "atan2(0, 0)", "(-8)^(1/3)", "0*log(0)", "0^(-1)", "1 + 1/(1 - 1)"})
    EXPECT_FALSE(value(undefined).defined()) << undefined;
}

TEST(Evaluation, KnowsDeterminants) {
  const auto v = [](long x) { return Value(Rational(x)); };
  EXPECT_EQ(determinant({{v(2), v(3)}, {v(4), v(5)}}).exact(), Rational(-2));
  EXPECT_EQ(determinant({{v(0), v(1), v(0)}, {v(1), v(0), v(0)}, {v(0), v(0), v(7)}}).exact(),
            Rational(-7));
  EXPECT_EQ(determinant({{v(1), v(2), v(3)}, {v(4), v(5), v(6)}, {v(7), v(8), v(9)}}).exact(),
            Rational(0));
}

Outcome exit_with(int code) {
  Outcome outcome;
  outcome.exit_code = code;
  return outcome;
}

TEST(AJudge, ContradictsWhatIsFalse) {
  struct Case {
    Truth truth;
    Judgement safe, singular, open, refused;
  };
  using enum Judgement;
  for (const Case& c :
       {Case{Truth::kSingular, kContradiction, kTrue, kOpen, kCrash},
        Case{Truth::kRegular, kTrue, kContradiction, kOpen, kCrash},
        Case{Truth::kUndefined, kContradiction, kContradiction, kOpen, kCrash},
        Case{Truth::kUndefinedOrSingular, kContradiction, kTrue, kOpen, kCrash},
        Case{Truth::kEmpty, kContradiction, kContradiction, kOpen, kCrash},
        Case{Truth::kRefused, kContradiction, kContradiction, kContradiction, kTrue}}) {
    Attack attack;
    attack.truth = c.truth;
    EXPECT_EQ(judge(attack, exit_with(0)), c.safe) << name(c.truth);
    EXPECT_EQ(judge(attack, exit_with(1)), c.singular) << name(c.truth);
    EXPECT_EQ(judge(attack, exit_with(2)), c.open) << name(c.truth);
    EXPECT_EQ(judge(attack, exit_with(65)), c.refused) << name(c.truth);
    EXPECT_EQ(judge(attack, exit_with(70)), kCrash) << name(c.truth);
    EXPECT_EQ(judge(attack, exit_with(74)), kCrash) << name(c.truth);
  }
}

TEST(AJudge, LetsAClaimThatMayBeAboutNoPoseBeWhereTheReportSaysSo) {
  Attack attack;
  attack.truth = Truth::kEmpty;
  Outcome outcome = exit_with(0);
  outcome.may_be_vacuous = true;
  EXPECT_EQ(judge(attack, outcome), Judgement::kOpen);
  outcome = exit_with(1);
  outcome.may_be_vacuous = true;
  EXPECT_EQ(judge(attack, outcome), Judgement::kContradiction);
  attack.truth = Truth::kSingular;
  outcome = exit_with(0);
  outcome.may_be_vacuous = true;
  EXPECT_EQ(judge(attack, outcome), Judgement::kContradiction);
}

TEST(AJudge, TellsCrashesFromSlowModels) {
  Attack attack;
  Outcome outcome;
  outcome.ending = Ending::kCrashed;
  EXPECT_EQ(judge(attack, outcome), Judgement::kCrash);
  outcome.ending = Ending::kSlow;
  EXPECT_EQ(judge(attack, outcome), Judgement::kSlow);
  attack.decidable = true;
  EXPECT_EQ(judge(attack, exit_with(2)), Judgement::kMissed);
  outcome.proof = Proof::kBroken;
  EXPECT_TRUE(proof_failed(outcome));
}

}  // namespace
}  // namespace regulus::detail::attack
