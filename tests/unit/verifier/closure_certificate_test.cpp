// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates about closures: genuine ones, and ones that a forger would try.
#include <gtest/gtest.h>

#include <fstream>
#include <utility>

#include "tests/support/closure_cases.hpp"
#include "tests/support/damage.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {
namespace {

TEST(ACertificateOfAClosure, IsVerified) {
  const Verification v = verify_text(bar().text);
  EXPECT_TRUE(is(Outcome::kVerified, v, ""));
  EXPECT_EQ(
      v.claim,
      "the mechanism has exactly one configuration on its branch, and the 2 equations are "
      "defined and regular there, at every pose and value of the 1 uncertain quantities of the "
      "variety");
  EXPECT_GT(v.leaves, 4U);
  EXPECT_EQ(v.links, v.leaves - 1);
  for (const int side : {1, -1}) {
    const ClosureCase wide = four_bar(120, side, 1e-3);
    EXPECT_TRUE(is(Outcome::kVerified, verify_text(Made(wide).text), "")) << side;
    for (const double gap : {0.25, 0.01, 1e-4}) {
      const ClosureCase sheets = two_sheets(gap, side);
      EXPECT_TRUE(is(Outcome::kVerified, verify_text(Made(sheets).text), "")) << gap;
    }
  }
}

/// Returns an example of the section about closures.
std::string example_of_the_page(int number) {
  std::ostringstream page;
  page << std::ifstream(REGULUS_SOURCE_DIR "/runtime/proof/FORMAT.md").rdbuf();
  const std::string text = page.str(), fence = "```\n";
  std::size_t begin = text.find("## Closures"), end = begin;
  for (int count = 0; count < number; ++count) {
    begin = text.find(fence, end) + fence.size();
    end = text.find(fence, begin);
    if (count + 1 < number) end += fence.size();
  }
  return text.substr(begin, end - begin);
}

TEST(ACertificateOfAClosure, IsThatOfThePage) {
  for (const int number : {1, 2, 3, 4}) {
    const Verification v = verify_text(example_of_the_page(number));
    EXPECT_TRUE(is(Outcome::kVerified, v, "")) << number;
    EXPECT_EQ(v.links, 1U);
  }
}

TEST(ACertificateOfAClosure, HasOneAnswerForAnyNumberOfThreads) {
  const ClosureCase sheets = two_sheets(0.01);
  const std::string text = Made(sheets).text;
  verifier::Options several;
  several.threads = 3;
  EXPECT_EQ(describe(verify_text(text)), describe(verify_text(text, several)));
}

TEST(ACertificateOfAClosure, MayHaveOneLeafAndNoVariables) {
  const std::string text =
      with_other(with_other(closure_question(two_sheets(0.01)),
                            "parameter x in -1 : 1\nparameter y in -1 : 1\n", ""),
                 "start 0.5\nstart 0.25\n", "");
  const std::string still =
      with_other(with_other(text, "pose x = x\npose y = y\n", "pose x = 1/2\npose y = 1/4\n"),
                 "the 2", "the 2");
  EXPECT_TRUE(
      is(Outcome::kVerified, verify_text(still + "l 0 tube 0.568 0.505 0.01 0.01\nend 1\n"), ""));
  EXPECT_TRUE(is(Outcome::kRejected,
                 verify_text(still + "l 0 tube -0.568 -0.505 0.01 0.01\nend 1\n"),
                 "another configuration than the start"));
  EXPECT_TRUE(is(Outcome::kRejected, verify_text(still + "l 0 tube 0.3 0.3 0.01 0.01\nend 1\n"),
                 "no configuration"));
}

/// The question about one unknown p near 0 at x = 0.
std::string of_one(const std::string& equation, const std::string& range = "-1 : 1",
                   const std::string& near = "0 +- 1/10", const std::string& start = "0") {
  return "regulus-certificate 1\nverdict NO SINGULARITY\nclaim " +
         format::describe_closure_claim({1, 1}, false) +
         "\nmodel m\nsha256 -\nmotion m\nalpha 0\nparameter x in " + range +
         "\npose x = x\nunknown p = " + near + "\nstart " + start + "\nequation " + equation +
         "\nproof\n";
}

/// The verifier centres a tube anew in each half of a leaf.
TEST(ACertificateOfAClosure, MayHaveLeavesThatTheVerifierSplits) {
  const std::string wave = of_one("p - sin(20*x)/4");
  const Verification v = verify_text(wave + "l 0 tube 9 0 0 0.5\nend 1\n");
  EXPECT_TRUE(is(Outcome::kVerified, v, ""));
  EXPECT_GT(v.boxes, 20U);
  // The sine leaves the tube.
  EXPECT_TRUE(is(Outcome::kRejected, verify_text(wave + "l 0 tube 9 0 0 0.24\nend 1\n"),
                 "no configuration"));
  EXPECT_FALSE(is(Outcome::kVerified, verify_text(wave + "l 0 tube 9 0 0 0.25\nend 1\n"), ""));
}

/// Where an unknown is the same all over the motion, tubes are as thin as rounding lets them be.
TEST(ACertificateOfAClosure, MayHaveAThinTubeAtTheStart) {
  const std::string flat = of_one("p*(2 + x)", "-1 : 1", "0.01 +- 1/10");
  EXPECT_TRUE(is(Outcome::kVerified, verify_text(flat + "l 0 tube 0 0 0 1e-14\nend 1\n"), ""));
  EXPECT_TRUE(is(Outcome::kRejected, verify_text(flat + "l 0 tube 0 1e-13 0 1e-14\nend 1\n"),
                 "no configuration"));
}

TEST(ACertificateOfAClosure, MayHaveConstraintsAndBalls) {
  ClosureCase c = two_sheets(0);
  c.is_outside = [](const std::vector<Interval>& x) {
    return certain_less(sqr(x[0]) + sqr(x[1]), Interval(0x1p-4));
  };
  c.motion = "constraint 1/16 - x^2 - y^2\n";
  const Made ring(c);
  const Verification v = verify_text(ring.text);
  EXPECT_TRUE(is(Outcome::kVerified, v, ""));
  EXPECT_NE(ring.text.find(" outside\n"), std::string::npos);
  // Without the constraint the claim is false.
  EXPECT_FALSE(is(Outcome::kVerified, verify_text(with_other(ring.text, c.motion, "")), ""));
  ClosureCase ball = four_bar(90, 1, 1e-3);
  ball.set = with_other(ball.set, "pose", "ball crank\npose");
  EXPECT_TRUE(is(Outcome::kVerified, verify_text(Made(ball).text), ""));
}

/// Far from a range of one value the equation is another one, even if that is nearer than any double.
TEST(AForgedBranch, WithAStartBesideTheOnlyValueIsNotVerified) {
  const auto with_start = [](const char* start) {
    return verify_text(of_one("p - 1e30*(x - 1/10)", "1/10 : 0.1", "0 +- 1/10", start) +
                       "l 0 tube 0.1 0 0 0.01\nend 1\n");
  };
  EXPECT_TRUE(is(Outcome::kVerified, with_start("0.1"), ""));
  EXPECT_TRUE(is(Outcome::kVerified, with_start("2/20"), ""));
  EXPECT_TRUE(
      is(Outcome::kUnfinished, with_start("0.10000000000000000001"), "the only value of x"));
  EXPECT_TRUE(is(Outcome::kRejected, with_start("0.2"), "not within the range"));
}

TEST(AForgedBranch, OfTheMirrorIsNotVerified) {
  const ClosureCase c = four_bar(100), mirror = four_bar(100, -1);
  const ClosureTree other(mirror);
  ASSERT_TRUE(other.is_made());
  // All tubes of the other branch, and a start on the other branch.
  EXPECT_TRUE(is(Outcome::kRejected, verify_text(bar().question + other.text()),
                 "another configuration than the start"));
  EXPECT_TRUE(is(Outcome::kRejected,
                 verify_text(with_other(bar().text, c.unknowns.substr(0, c.unknowns.find("start")),
                                        mirror.unknowns.substr(0, mirror.unknowns.find("start")))),
                 "another configuration than the start"));
}

TEST(AForgedBranch, WithOneLeafOfTheMirrorIsNotVerified) {
  const ClosureCase c = four_bar(100), mirror = four_bar(100, -1);
  Made made(c);
  std::size_t tried = 0;
  for (std::size_t i = 0; i < made.tree.nodes().size(); ++i) {
    ClosureNode& node = made.tree.nodes()[i];
    if (!node.tube) continue;
    const auto kept = node.tube;
    const auto p = continued(mirror, mirror.start, mirror.start_unknowns, node.tube->at);
    node.tube = tube_about(mirror, node.tube->at, p, node.box);
    if (node.tube) {
      ++tried;
      EXPECT_TRUE(is(Outcome::kRejected, verify_text(made.again()), "configuration")) << i;
      // The mirror's centre with the radius that was there.
      node.tube->radius = kept->radius;
      EXPECT_FALSE(is(Outcome::kVerified, verify_text(made.again()), "")) << i;
    }
    node.tube = kept;
  }
  EXPECT_GT(tried, 4U);
}

/// Half of the tubes are those of one sheet, half of the other: at the cut the sheets are 2√gap apart.
TEST(AForgedBranch, ThatJumpsWhereTwoComeNearIsNotVerified) {
  for (const double gap : {0.25, 0.01, 1e-4}) {
    const ClosureCase c = two_sheets(gap), mirror = two_sheets(gap, -1);
    Made made(c);
    ClosureTree other(mirror);
    ASSERT_TRUE(other.is_made());
    ASSERT_EQ(other.nodes().size(), made.tree.nodes().size());
    for (std::size_t i = 0; i < other.nodes().size(); ++i)
      if (other.nodes()[i].box[0].hi <= 0) made.tree.nodes()[i].tube = other.nodes()[i].tube;
    EXPECT_TRUE(is(Outcome::kRejected, verify_text(made.again()), "different configurations"))
        << gap;
  }
}

/// Each choice of sheets but that of the start's everywhere jumps somewhere, or at the start.
TEST(AForgedBranch, WithAnyChoiceOfSheetsIsNotVerified) {
  const ClosureCase c = two_sheets(0.02), mirror = two_sheets(0.02, -1);
  Made made(c);
  ClosureTree other(mirror);
  ASSERT_TRUE(other.is_made());
  RandomSource random(5);
  std::vector<std::size_t> leaves;
  for (std::size_t i = 0; i < made.tree.nodes().size(); ++i)
    if (made.tree.nodes()[i].tube) leaves.push_back(i);
  const std::vector<ClosureNode> kept = made.tree.nodes();
  for (std::size_t choice = 0; choice < leaves.size() + 30; ++choice) {
    made.tree.nodes() = kept;
    // One leaf alone, then about half of them, then few.
    for (std::size_t l = 0; l < leaves.size(); ++l)
      if (choice < leaves.size() ? l == choice : random.one_in(choice % 2 == 0 ? 2 : 9))
        made.tree.nodes()[leaves[l]].tube = other.nodes()[leaves[l]].tube;
    EXPECT_TRUE(is(Outcome::kRejected, verify_text(made.again()), "configuration")) << choice;
  }
  EXPECT_GT(leaves.size(), 20U);
}

/// The constraint leaves two parts. What the mechanism is on the part without the start is not known.
TEST(AForgedBranch, OnAPartWithoutTheStartIsNotVerified) {
  for (const int side : {1, -1}) {
    const auto in_parts = [](ClosureCase c) {
      c.is_outside = [](const std::vector<Interval>& x) {
        return certain_less(abs(x[0]), Interval(0.6));
      };
      c.motion = "constraint 0.36 - x^2\n";
      return c;
    };
    const ClosureCase c = in_parts(two_sheets(0.01, 1, 0.75));
    const ClosureCase mirror = in_parts(two_sheets(0.01, side, 0.75));
    Made made(c);
    ClosureTree other(mirror);
    ASSERT_TRUE(other.is_made());
    ASSERT_EQ(other.nodes().size(), made.tree.nodes().size());
    for (std::size_t i = 0; i < other.nodes().size(); ++i)
      if (other.nodes()[i].box[0].hi <= 0) made.tree.nodes()[i].tube = other.nodes()[i].tube;
    EXPECT_TRUE(is(Outcome::kUnfinished, verify_text(made.again()), "no chain of neighbours"))
        << side;
    // The start in the part that is excluded.
    EXPECT_TRUE(
        is(Outcome::kRejected,
           verify_text(with_other(made.text, c.unknowns, two_sheets(0.01, 1, 0.25).unknowns)),
           "without a tube"));
  }
}

/// A leaf is outside only if the verifier shows it, whatever the line says.
TEST(AForgedBranch, WithALeafThatIsNotOutsideIsNotVerified) {
  const ClosureCase c = two_sheets(0.02);
  Made made(c);
  std::size_t tried = 0;
  for (ClosureNode& node : made.tree.nodes()) {
    if (!node.tube || ++tried % 7 != 0) continue;
    const auto kept = std::exchange(node.tube, std::nullopt);
    EXPECT_TRUE(is(Outcome::kRejected, verify_text(made.again()), "pose of the variety"));
    node.tube = kept;
  }
  EXPECT_GT(tried, 20U);
}

TEST(AProofAboutAClosure, HasBounds) {
  verifier::Options few;
  few.max_boxes = 4;
  const ClosureCase sheets = two_sheets(0.02);
  const Made made(sheets);
  EXPECT_TRUE(is(Outcome::kUnfinished, verify_text(made.text, few), "boxes"));
  // A split of a split, and so on; the last line is never read.
  std::string deep = made.question;
  deep += "s 0 0 0x0p+0\n";
  for (int i = 0; i < 1000; ++i) {
    char line[64];
    std::snprintf(line, sizeof line, "s %d 0 %a\n", i == 0 ? 2 : 2 * i + 1, std::ldexp(0.5, -i));
    deep += line;
  }
  EXPECT_TRUE(is(Outcome::kUnfinished, verify_text(deep + "end 1\n"), "too deep"));
}

/// The sheets meet at a point. Tubes over all of it hold both, or none for sure.
TEST(AForgedBranch, ThroughASingularPoseIsNotVerified) {
  const ClosureCase c = two_sheets(1e-4);
  const Made made(c);
  for (const char* const gap : {"0", "-1e-9", "1e-30"}) {
    const std::string text = with_other(made.text, "0.0001", gap);
    EXPECT_FALSE(is(Outcome::kVerified, verify_text(text), "")) << gap;
  }
  // Past the pose in which coupler and rocker are in line there is no configuration.
  EXPECT_FALSE(is(
      Outcome::kVerified,
      verify_text(with_other(with_other(bar().text, "-100*", "-140*"), ": 100*", ": 140*")), ""));
}

/// Numbers in a tube: x₀, c, S, r. None of these changes leaves a tube with the solution.
TEST(AForgedBranch, WithAChangedNumberIsNotVerified) {
  const std::vector<std::string> lines = [] {
    std::vector<std::string> result;
    std::istringstream stream(bar().text);
    for (std::string line; std::getline(stream, line);) result.push_back(line);
    return result;
  }();
  std::size_t tried = 0;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    if (lines[l].find(" tube ") == std::string::npos) continue;
    std::vector<std::string> words;
    std::istringstream stream(lines[l]);
    for (std::string word; stream >> word;) words.push_back(word);
    // θ₀, φ and ψ, their slopes by θ, and the radii.
    for (const std::size_t w : {3, 5, 6, 7, 9, 11, 12})
      for (const char* const value : {"0x1.9p+1", "-0x1p-40", "nan", "-0x1p-3"}) {
        auto changed = words;
        changed[w] = value;
        std::string text;
        for (std::size_t i = 0; i < lines.size(); ++i) {
          if (i != l) text += lines[i] + '\n';
          for (std::size_t k = 0; i == l && k < changed.size(); ++k)
            text += changed[k] + (k + 1 < changed.size() ? ' ' : '\n');
        }
        const Verification v = verify_text(text);
        // A small change of x₀, c or S leaves the configuration in the tube.
        const bool may_hold = w < 11 && std::string(value).front() == '-';
        EXPECT_TRUE(may_hold || v.outcome != Outcome::kVerified) << lines[l] << w << value;
        ++tried;
      }
  }
  EXPECT_GT(tried, 100U);
}

/// The operations have values and bounded slopes, but the mechanism jumps or has a corner there.
TEST(AForgedBranch, WithAJumpOrAKinkIsNotVerified) {
  const auto with = [](const std::string& equation, const std::string& tube,
                       const std::string& range = "-1 : 1") {
    return verify_text(of_one(equation, range, "1/2 +- 1/10", "1/2") + "l 0 tube " + tube +
                       "\nend 1\n");
  };
  EXPECT_TRUE(is(Outcome::kVerified, with("p - x", "0 0 1 0.5"), ""));
  EXPECT_FALSE(is(Outcome::kVerified, with("p - abs(x)", "0 0.5 0 0.8"), ""));
  EXPECT_FALSE(is(Outcome::kVerified, with("p + abs(p)/4 - x*5/4", "0 0 1 0.9"), ""));
  EXPECT_TRUE(is(Outcome::kVerified, with("p - abs(x)", "0.5 0.5 1 0.4", "0.25 : 1"), ""));
  EXPECT_FALSE(is(Outcome::kVerified, with("p - x + 0*atan2(x, -1)", "0 0 1 0.5"), ""));
  EXPECT_FALSE(is(Outcome::kVerified, with("p - x + atan2(x, -1) - pi", "0 0 1.5 0.9"), ""));
  EXPECT_FALSE(is(Outcome::kVerified, with("p - x + sqrt(x^2)", "0 0 1 3"), ""));
  EXPECT_FALSE(is(Outcome::kVerified, with("p - x + 0/x", "0 0 1 0.5"), ""));
  // p is singular, or there are infinitely many, or nothing depends on p.
  EXPECT_FALSE(is(Outcome::kVerified, with("(p - x)^3", "0 0 1 0.5"), ""));
  EXPECT_FALSE(is(Outcome::kVerified, with("(p - x)*(p - x)", "0 0 1 0.5"), ""));
  EXPECT_FALSE(is(Outcome::kVerified, with("0*p", "0 0 1 0.5"), ""));
  EXPECT_FALSE(is(Outcome::kVerified, with("x - x", "0 0 1 0.5"), ""));
}

/// Whatever is done to the proof of a false claim, it is not verified.
TEST(AForgedBranch, OfAFalseClaimIsNotVerifiedAfterDamage) {
  const ClosureCase c = two_sheets(1e-4), mirror = two_sheets(1e-4, -1);
  Made made(c);
  ClosureTree other(mirror);
  for (std::size_t i = 0; i < other.nodes().size(); ++i)
    if (other.nodes()[i].box[0].hi <= 0) made.tree.nodes()[i].tube = other.nodes()[i].tube;
  // The sheets meet.
  const std::string question = with_other(made.question, "0.0001", "0");
  const std::vector<std::string> splices = {"outside", "tube",         " 0x1p-3",
                                            "l 0",     "s 1 0 0x1p-2", "end"};
  for (unsigned seed = 0; seed < 300; ++seed) {
    const std::string text = question + Damage(seed, splices).done_to(made.tree.text());
    ASSERT_NE(verify_text(text).outcome, Outcome::kVerified) << seed;
  }
}

}  // namespace
}  // namespace regulus::detail::test
