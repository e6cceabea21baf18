// SPDX-License-Identifier: GPL-3.0-or-later
// The head of a certificate that somebody has changed is compared with its model file: the change
// is refused, or it is a named change that an option may make, or the head states the same values.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <optional>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/model_comparison.hpp"
#include "tests/support/certificates.hpp"
#include "tests/support/files.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {
namespace {

struct Asked {
  std::string name;
  ModelOptions model;
  std::size_t differences;  ///< of the certificate as it was written
};

ModelOptions planar(const std::string& motion, const std::string& tolerance = "",
                    const std::string& alpha = "") {
  ModelOptions model = robot("planar_3rpr", motion, tolerance);
  model.alpha = alpha;
  return model;
}

/// A head states these numbers at one place of its set: "range x", "entry 3".
using Values = std::map<std::string, double>;

/// Returns a place in a range that depends on the name alone.
double share(const std::string& name) {
  return double(std::hash<std::string>()(name) % 1000) / 1000;
}

class HeadReading {
 public:
  explicit HeadReading(const verifier::Question& question) : q_(question) {
    for (const verifier::Variable& v : q_.variables) {
      const double lo = value(v.lo), hi = value(v.hi);
      values_["lower of " + v.name] = lo, values_["upper of " + v.name] = hi;
      values_["kind of " + v.name] = double(v.kind);
      const double at = lo + share(v.name) * (hi - lo);
      place_.emplace_back(verifier::Interval{at, at}, 128);
    }
    for (const auto& ball : q_.balls) {
      std::string names;
      for (const std::size_t i : ball.members) names += q_.variables[i].name + ' ';
      values_["ball of " + names] = value(ball.radius);
    }
    for (const auto& [key, stated] : q_.stated)
      if (!key.starts_with("defined ") && !key.starts_with("motion-defined ") &&
          !(key.starts_with("spread ") && value(stated.node) == 0))
        values_[key] = value(stated.node);
  }
  [[nodiscard]] const Values& values() const { return values_; }

 private:
  [[nodiscard]] double value(verifier::NodeId node) const {
    const auto found = evaluate(q_.graph, {node}, place_, 128);
    return found ? arf_get_d(arb_midref((*found)[0].get()), ARF_RND_NEAR) : std::nan("");
  }

  const verifier::Question& q_;
  std::vector<verifier::Ball> place_;
  Values values_;
};

struct Found {
  std::string refusal;
  std::vector<std::string> differences;
  Values values;
};

class AChangedHead : public testing::TestWithParam<Asked> {
 protected:
  AChangedHead() : lines_(lines_of(certify(GetParam().model).text)) {
    while (lines_[end_] != "proof") ++end_;
    lines_.resize(end_ + 1);
    options_.model_name = GetParam().model.path;
    options_.model_text = file_contents(options_.model_name);
    options_.all_overridden = true;
    model_ = verifier::read_model_values(options_.model_text);
    written_ = read(lines_);
  }

  [[nodiscard]] Found read(const std::vector<std::string>& lines) const {
    std::istringstream file(joined(lines));
    verifier::Lines head(file);
    verifier::Question question;
    verifier::Verification found;
    try {
      read_question(head, question);
      question.graph.end_of_file();
      compare_with_file(question, model_, options_, found);
    } catch (const verifier::Rejection& why) {
      return {why.what(), {}, {}};
    } catch (const verifier::Unfinished& why) {
      return {why.what(), {}, {}};
    }
    return {"", found.differences, HeadReading(question).values()};
  }
  void expect_noticed(const std::vector<std::string>& changed, std::size_t line) {
    const Found found = read(changed);
    ++(found.refusal.empty() ? taken_ : refused_);
    if (!found.refusal.empty() || found.differences != written_.differences) return;
    ASSERT_EQ(found.values.size(), written_.values.size()) << lines_[line] << '\n' << changed[line];
    for (const auto& [key, value] : written_.values) {
      const auto now = found.values.find(key);
      ASSERT_NE(now, found.values.end()) << key << '\n' << changed[line];
      EXPECT_NEAR(now->second, value, 1e-12 * std::fabs(value)) << key << '\n' << changed[line];
    }
  }

  /// The first line is the name of the format.
  static constexpr std::size_t kBegin = 1;
  std::vector<std::string> lines_;
  std::size_t end_ = 0;  ///< the line `proof`
  verifier::Options options_;
  verifier::WrittenValues model_;
  Found written_;
  int taken_ = 0, refused_ = 0;
};

TEST_P(AChangedHead, IsTakenAsItWasWritten) {
  EXPECT_EQ(written_.refusal, "");
  EXPECT_EQ(written_.differences.size(), GetParam().differences);
  EXPECT_GT(written_.values.size(), 10U);
}

TEST_P(AChangedHead, IsRefusedWithALineLeftOutOrTwice) {
  for (std::size_t line = kBegin; line < end_; ++line) {
    auto without = lines_;
    without.erase(without.begin() + std::ptrdiff_t(line));
    expect_noticed(without, line);
    auto twice = lines_;
    twice.insert(twice.begin() + std::ptrdiff_t(line), lines_[line]);
    expect_noticed(twice, line);
  }
  EXPECT_GT(refused_, 5 * taken_);
}

TEST_P(AChangedHead, IsRefusedWithLinesInAnotherOrder) {
  RandomSource random(20261126);
  for (int swap = 0; swap < 60; ++swap) {
    auto changed = lines_;
    const std::size_t one = kBegin + random.below(end_ - kBegin),
                      other = kBegin + random.below(end_ - kBegin);
    std::swap(changed[one], changed[other]);
    if (changed != lines_) expect_noticed(changed, one);
  }
  EXPECT_GT(refused_, taken_);
}

TEST_P(AChangedHead, IsRefusedWithAnotherDigit) {
  RandomSource random(20261127);
  for (std::size_t line = kBegin; line < end_; ++line) {
    std::vector<std::size_t> digits;
    for (std::size_t i = lines_[line].find(' '); i < lines_[line].size(); ++i)
      if (std::isdigit(static_cast<unsigned char>(lines_[line][i])) != 0) digits.push_back(i);
    for (int change = 0; change < 2 && !digits.empty(); ++change) {
      auto changed = lines_;
      char& digit = changed[line][digits[random.below(digits.size())]];
      digit = char('0' + (digit - '0' + 1 + int(random.below(9))) % 10);
      expect_noticed(changed, line);
    }
  }
  EXPECT_GT(refused_, 3 * taken_);
}

TEST_P(AChangedHead, IsRefusedWithAnotherByte) {
  RandomSource random(20261128);
  static const std::string kBytes = "0123456789.-+*/^() abcdefpxyz_:=";
  for (int change = 0; change < 200; ++change) {
    const std::size_t line = kBegin + random.below(end_ - kBegin);
    auto changed = lines_;
    changed[line][random.below(changed[line].size())] = kBytes[random.below(kBytes.size())];
    if (changed != lines_) expect_noticed(changed, line);
  }
  EXPECT_GT(refused_, 10 * taken_);
}

INSTANTIATE_TEST_SUITE_P(Models, AChangedHead,
                         testing::Values(Asked{"Exact", planar("regular"), 0},
                                         Asked{"Errors", planar("circle"), 0},
                                         Asked{"Constraints", planar("reach"), 0},
                                         Asked{"Options", planar("regular", "1/10", "1/100"), 7},
                                         Asked{"Platform", robot("robot_2", "table5_20", "20"), 2}),
                         [](const auto& asked) { return asked.param.name; });

}  // namespace
}  // namespace regulus::detail::test
