// SPDX-License-Identifier: GPL-3.0-or-later
// The head of a certificate that somebody has changed is compared with its model file: the change
// is refused, or it is a named change that an option may make.
#include "codegen/answer/certificate/certified_model.hpp"

#include <gtest/gtest.h>

#include <cctype>

#include "tests/support/certificates.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::test {
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

bool is_condition(const std::string& line) {
  return line.starts_with("defined") || line.starts_with("motion-defined");
}

class ACertifiedModel : public testing::TestWithParam<Asked> {
 protected:
  ACertifiedModel() : lines_(lines_of(certify(GetParam().model).text)) {
    while (lines_[end_] != "proof") ++end_;
  }

  [[nodiscard]] ModelConfirmation confirm(const std::vector<std::string>& lines) const {
    std::istringstream file(joined(lines));
    return confirm_model(CertificateHead(file), GetParam().model.path);
  }
  void expect_noticed(const std::vector<std::string>& changed, std::size_t line) const {
    const ModelConfirmation found = confirm(changed), before = confirm(lines_);
    EXPECT_TRUE(!found.refusal.empty() || found.differences != before.differences)
        << lines_[line] << '\n'
        << changed[line];
  }

  /// The verifier checks verdict and claim, in the lines before this one, against the rest.
  static constexpr std::size_t kBegin = 3;
  std::vector<std::string> lines_;
  std::size_t end_ = 0;  ///< the line `proof`
};

TEST_P(ACertifiedModel, IsConfirmedAsItWasWritten) {
  const ModelConfirmation found = confirm(lines_);
  EXPECT_EQ(found.refusal, "");
  EXPECT_EQ(found.differences.size(), GetParam().differences);
}

TEST_P(ACertifiedModel, IsNotConfirmedWithALineLeftOutOrTwice) {
  for (std::size_t line = kBegin; line < end_; ++line) {
    auto without = lines_;
    without.erase(without.begin() + std::ptrdiff_t(line));
    expect_noticed(without, line);
    // Repeating a condition does not change the question.
    if (is_condition(lines_[line])) continue;
    auto twice = lines_;
    twice.insert(twice.begin() + std::ptrdiff_t(line), lines_[line]);
    EXPECT_NE(confirm(twice).refusal, "") << lines_[line];
  }
}

TEST_P(ACertifiedModel, IsNotConfirmedWithLinesInAnotherOrder) {
  RandomSource random(20261126);
  for (int swap = 0; swap < 60; ++swap) {
    auto changed = lines_;
    const std::size_t one = kBegin + random.below(end_ - kBegin),
                      other = kBegin + random.below(end_ - kBegin);
    std::swap(changed[one], changed[other]);
    // The order of conditions does not matter.
    if (changed == lines_ || (is_condition(lines_[one]) && is_condition(lines_[other]))) continue;
    EXPECT_NE(confirm(changed).refusal, "") << lines_[one] << '\n' << lines_[other];
  }
}

TEST_P(ACertifiedModel, IsNotConfirmedWithAnotherDigit) {
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
}

TEST_P(ACertifiedModel, IsNotConfirmedWithAnotherByte) {
  RandomSource random(20261128);
  static const std::string kBytes = "0123456789.-+*/^() abcdefpxyz_:=";
  for (int change = 0; change < 200; ++change) {
    const std::size_t line = kBegin + random.below(end_ - kBegin);
    auto changed = lines_;
    changed[line][random.below(changed[line].size())] = kBytes[random.below(kBytes.size())];
    if (changed != lines_) expect_noticed(changed, line);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, ACertifiedModel,
                         testing::Values(Asked{"Exact", planar("regular"), 0},
                                         Asked{"Errors", planar("circle"), 0},
                                         Asked{"Constraints", planar("reach"), 0},
                                         Asked{"Options", planar("regular", "1/10", "1/100"), 3},
                                         Asked{"Platform", robot("robot_2", "table5_20", "20"), 2}),
                         [](const auto& asked) { return asked.param.name; });

}  // namespace
}  // namespace regulus::test
