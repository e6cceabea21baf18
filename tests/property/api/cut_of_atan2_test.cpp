// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices with atan2 on motions that cross its cut. The truth is known in closed form: on each side of
// the cut the angle runs over an interval, whose ends are at corners of the motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "codegen/answer/ask.hpp"
#include "runtime/verifier/model/cut_sides.hpp"
#include "runtime/verifier/verify.hpp"
#include "tests/support/certificates.hpp"
#include "tests/support/files.hpp"
#include "tests/support/random_source.hpp"
#include "tests/support/temporary_directory.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;

constexpr double kPi = std::numbers::pi;
constexpr double kMargin = 1e-3;

struct Asked {
  Verdict verdict;
  std::string certificate;
};

Asked ask_about(const std::string& model, bool wants_proof = true) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "model.toml", proof = folder.path() / "proof";
  std::ofstream(path) << model;
  AskCheck asked;
  asked.model.path = path;
  asked.search.engine = Engine::kInterpreted;
  asked.search.threads = 1;
  asked.search.max_boxes = 20'000;
  Services services;
  if (wants_proof) services.certificate = proof;
  const Verdict verdict = ask(asked, services)->result.verdict;
  return {verdict, std::filesystem::exists(proof) ? file_contents(proof) : ""};
}

verifier::Verification compare(const std::string& certificate, const std::string& model) {
  verifier::Options options;
  options.model_text = model;
  options.model_name = "model.toml";
  return verify_text(certificate, options);
}

/// An angle of the motion x in [−2, −1], y in [−1, 1], and an entry that is 0 at one angle.
class Entry {
 public:
  explicit Entry(RandomSource& random)
      : slope_(eighths(random, -3, 3)), shift_(eighths(random, -0.75, 0.75) + 1.5 * slope_) {
    double least = 0, largest = 0;
    for (const double x : {-2.0, -1.0})
      for (const double y : {-1.0, 1.0}) {
        const double quotient = (y + slope_ * x + shift_) / -x;
        least = std::min(least, quotient);
        largest = std::max(largest, quotient);
      }
    upper_ = kPi - std::atan(largest);
    lower_ = -kPi - std::atan(least);
    zero_ = std::round(1024 * random.between(-4, 4)) / 1024;
  }

  [[nodiscard]] std::string text() const {
    return "atan2(y + (" + std::to_string(slope_) + ")*x + " + std::to_string(shift_) + ", x) - (" +
           std::to_string(zero_) + ")";
  }
  /// True if the zero is too close to an end of an interval.
  [[nodiscard]] bool is_unclear() const {
    const auto near = [this](double end) { return std::abs(zero_ - end) < kMargin; };
    return near(upper_) || near(kPi) || near(lower_) || near(-kPi);
  }
  [[nodiscard]] bool vanishes() const {
    return (zero_ > upper_ && zero_ < kPi) || (zero_ < lower_ && zero_ > -kPi);
  }

 private:
  static double eighths(RandomSource& random, double lo, double hi) {
    return std::round(8 * random.between(lo, hi)) / 8;
  }
  double slope_, shift_, upper_, lower_, zero_;
};

std::string model_of(const Entry& first, const std::string& second) {
  return "regulus = 1\nname = \"cut\"\n[pose]\nx = \"m\"\ny = \"m\"\n[matrix]\nrows = [[\"" +
         first.text() + "\", \"x\"], [\"0\", \"" + second +
         "\"]]\n[motion.across]\nx = [-2, -1]\ny = [-1, 1]\n";
}

void expect_decided(const std::string& model, bool is_singular) {
  const Asked asked = ask_about(model);
  EXPECT_EQ(asked.verdict, is_singular ? Verdict::kSingularity : Verdict::kNoSingularity) << model;
  const verifier::Verification v = compare(asked.certificate, model);
  EXPECT_EQ(v.outcome, Outcome::kVerified) << v.reason << '\n' << model << asked.certificate;
}

TEST(AJumpOfAtan2, IsDecidedAsTheClosedFormSays) {
  RandomSource random(7);
  int singular = 0, regular = 0;
  for (int trial = 0; trial < trials(40, 150); ++trial) {
    const Entry entry(random);
    if (entry.is_unclear()) continue;
    expect_decided(model_of(entry, "1"), entry.vanishes());
    ++(entry.vanishes() ? singular : regular);
  }
  EXPECT_GT(singular, trials(5, 20));
  EXPECT_GT(regular, trials(5, 20));
}

TEST(JumpsOfTwoAngles, AreDecidedAsTheClosedFormSays) {
  RandomSource random(8);
  int singular = 0, regular = 0;
  for (int trial = 0; trial < trials(20, 60); ++trial) {
    const Entry first(random), second(random);
    if (first.is_unclear() || second.is_unclear()) continue;
    const bool is_singular = first.vanishes() || second.vanishes();
    expect_decided(model_of(first, second.text()), is_singular);
    ++(is_singular ? singular : regular);
  }
  EXPECT_GT(singular, trials(2, 10));
  EXPECT_GT(regular, trials(2, 10));
}

constexpr const char* kModel =
    "regulus = 1\nname = \"cut\"\n[pose]\nx = \"m\"\ny = \"m\"\n[geometry]\nu = 0\n[matrix]\n"
    "rows = [[\"atan2(y + u, x)\"]]\n[motion.across]\nx = [-2, -1]\ny = [-1, 1]\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from << '\n' << text;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The sign of the determinant changes across the cut, where it is not 0.
TEST(ADeterminantThatJumpsPast0, IsNotSingular) {
  EXPECT_EQ(ask_about(kModel).verdict, Verdict::kNoSingularity);
}

/// The point where the angle has no value stays one, and so does a limit that no pose attains.
TEST(ACutOfAtan2, IsNotDecidedAtItsEnd) {
  const std::string around = replaced(kModel, "x = [-2, -1]\ny", "x = [-2, 1]\ny");
  EXPECT_EQ(ask_about(replaced(around, "atan2(y + u, x)", "atan2(y + u, x) + 4")).verdict,
            Verdict::kPossibleProblem);
  EXPECT_EQ(ask_about(around).verdict, Verdict::kSingularity);  // at y = 0 and x > 0
  const std::string limit = replaced(kModel, "atan2(y + u, x)", "atan2(y + u, x) + pi");
  EXPECT_EQ(ask_about(limit).verdict, Verdict::kPossibleProblem);
}

/// The sign of an uncertain ordinate is not that of a constraint.
TEST(ACutOfAtan2, IsNotDecidedForAnUncertainOrdinate) {
  const std::string uncertain = replaced(kModel, "u = 0", "u = { value = 0, tolerance = 0.1 }");
  EXPECT_EQ(ask_about(uncertain).verdict, Verdict::kPossibleProblem);
}

TEST(ACertificateOfSides, IsVerifiedForAllSidesAlone) {
  const std::string model = kModel, proof = ask_about(model).certificate;
  EXPECT_EQ(compare(proof, model).outcome, Outcome::kVerified) << compare(proof, model).reason;
  EXPECT_TRUE(compare(proof, model).are_sides);
  const std::string side = "constraint -side_1*(";
  const std::string forged[] = {
      replaced(replaced(replaced(proof, "piece -1\n", ""), "tree\nl 0 h-matrix\n", ""), "end 2",
               "end 1"),
      replaced(proof, "piece -1", "piece 1"),
      replaced(proof, "piece -1", "piece -2"),
      replaced(proof, side, "constraint -side_1*side_1*("),
      replaced(proof, side, "constraint -side_1*(side_1*"),
      replaced(proof, side, "constraint -1*("),
      replaced(proof, side, "constraint -side_1*(1/2 + "),
      replaced(proof, side, "constraint -side_1*(3)*("),
      replaced(proof, side, "constraint y - 1/2\n" + side),
      replaced(proof, "parameter y in -1 : 1", "parameter y in 0 : 1"),
  };
  for (const std::string& text : forged) {
    ASSERT_NE(text, proof);
    EXPECT_NE(compare(text, model).outcome, Outcome::kVerified) << text;
  }
}

TEST(ACertificateOfSides, IsNotOfAnotherModel) {
  const std::string model = kModel, proof = ask_about(model).certificate;
  for (const std::string& other :
       {std::string("atan2(y + u, x) + 0.1"), std::string("atan2(2*(y + u), x)"),
        std::string("atan2(y + u, 2*x)"), std::string("atan(y/x)"),
        std::string("atan2(-y - u, x)")})
    EXPECT_NE(compare(proof, replaced(model, "atan2(y + u, x)", other)).outcome, Outcome::kVerified)
        << other;
}

TEST(SidesOfACut, AreNoneIfTheirOrdinateDependsOnASign) {
  const auto are_sides = [](const std::string& lines) {
    return verifier::end_in_sides(lines + "proof\n", {"s"});
  };
  EXPECT_TRUE(are_sides("constant c = 5\nlet e1 = s*y\nconstraint -s*(c*y)\n"));
  EXPECT_FALSE(are_sides("constraint -s*(s*y)\n"));
  EXPECT_FALSE(are_sides("constant c = 5*s\nconstraint -s*(c*y)\n"));
  EXPECT_FALSE(are_sides("let a = s\nlet b = y*a\nconstraint -s*(b)\n"));
  EXPECT_FALSE(are_sides("constraint -s*(y) + (y)\n"));
}

}  // namespace
}  // namespace regulus::detail::test
