// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of bounds along way-points that were damaged: none is verified.
#include <gtest/gtest.h>

#include "tests/property/closure/checked_way_values.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;

/// Certificates about one linkage, each damaged in one way.
class ADamagedValueOnAWay : public testing::Test {
 protected:
  void SetUp() override {
    const std::string path = (directory_.path() / "end").string();
    const ComponentBound found =
        bound_on_way(model_, file_.path(), {words_of("error"), 0.02, "", path});
    suffix_ = certificate_suffix(found.component);
    safe_ = file_contents(path + suffix_ + ".safe");
    attained_ = file_contents(path + suffix_ + ".singular");
    ASSERT_EQ(outcome(safe_), Outcome::kVerified);
    ASSERT_EQ(outcome(attained_), Outcome::kVerified);
  }
  [[nodiscard]] Outcome outcome(const std::string& text, const std::string& model = "") const {
    return verified_way(text, model.empty() ? model_ : model, file_.path()).outcome;
  }
  static std::string changed(std::string text, const std::string& key, const std::string& line) {
    const std::size_t at = text.find('\n' + key + ' ') + 1;
    EXPECT_NE(at, 0U) << key;
    return text.replace(at, text.find('\n', at) - at, line);
  }
  static std::string line_of(const std::string& text, const std::string& key) {
    const std::size_t at = text.find('\n' + key + ' ') + 1;
    return text.substr(at, text.find('\n', at) - at);
  }
  void expect_refused(const std::string& text, const char* what) const {
    EXPECT_NE(outcome(text), Outcome::kVerified) << what;
    EXPECT_NE(verified(text).outcome, Outcome::kVerified) << what << ", of itself";
  }

  const FourBar linkage_{0.2, 0.35355, 0.25, 0.45};
  const std::string model_ = linkage_.text(0.5, 0, 2) + kDataOfMotors;
  const WayFile file_{theta_table({0.5, 1.2, 0.1, -0.4})};
  const TemporaryDirectory directory_;
  std::string suffix_, safe_, attained_;
};

TEST_F(ADamagedValueOnAWay, IsNotVerifiedAtAnotherPlace) {
  const std::string value = line_of(attained_, "value");
  std::istringstream words(value);
  std::string word, s;
  std::size_t piece = 0;
  words >> word >> piece >> s;
  EXPECT_GE(piece, 1U);
  for (std::size_t other = 0; other <= 5; ++other)
    if (other != piece)
      expect_refused(changed(attained_, "value", fmt::format("value {} {}", other, s)),
                     "on another piece");
  for (const char* const line : {"value", "value 1", "value 1 0x1p-1 0x1p-1", "value 1 -",
                                 "value 1 0x1p+1", "value -1 0x1p-1", "value x 0x1p-1"})
    expect_refused(changed(attained_, "value", line), line);
  std::string without = attained_;
  without.erase(without.find(value), value.size() + 1);
  expect_refused(without, "without its place");
  std::string safe = safe_;
  safe.insert(safe.find("\ntree\n") + 1, value + '\n');
  expect_refused(safe, "with a place");
}

TEST_F(ADamagedValueOnAWay, IsNotVerifiedWithAnotherBound) {
  const auto with_bound = [](std::string text, const std::string& bound) {
    const std::string old = line_of(text, "bound").substr(6);
    for (std::size_t at = text.find(old); at != std::string::npos && at < text.find("\nproof\n");
         at = text.find(old, at + bound.size()))
      text.replace(at, old.size(), bound);
    return text;
  };
  // Weaker claims are true, and proved by the same trees.
  EXPECT_EQ(outcome(with_bound(safe_, "1")), Outcome::kVerified);
  EXPECT_EQ(outcome(with_bound(attained_, "1/1000")), Outcome::kVerified);
  expect_refused(with_bound(safe_, "1/1000"), "a bound that is exceeded");
  expect_refused(with_bound(attained_, "1"), "a bound that is not attained");
  expect_refused(changed(safe_, "column", "column 2"), "another unknown, by the line alone");
}

TEST_F(ADamagedValueOnAWay, IsNotThatOfAnotherModelOrFile) {
  const auto model_with = [&](const std::string& old, const std::string& by) {
    std::string text = model_;
    EXPECT_NE(text.find(old), std::string::npos) << old;
    return text.replace(text.find(old), old.size(), by);
  };
  for (const std::string* const text : {&safe_, &attained_}) {
    EXPECT_EQ(outcome(*text, model_with("error = 0.01", "error = 0.02")), Outcome::kRejected);
    EXPECT_EQ(outcome(*text, model_with("d = \"0.45", "d = \"0.46")), Outcome::kRejected);
    EXPECT_EQ(outcome(*text, model_with("psi = \"1e-4\"", "psi = \"1e-3\"")), Outcome::kRejected);
    for (const std::vector<double>& places :
         std::vector<std::vector<double>>{{0.5, 1.2, 0.1},
                                          {0.5, 1.2, 0.1, -0.4, 0},
                                          {0.5, 1.3, 0.1, -0.4},
                                          {0.4, 1.2, 0.1, -0.4}}) {
      file_.write(theta_table(places));
      EXPECT_EQ(outcome(*text), Outcome::kRejected) << theta_table(places);
    }
    file_.write(theta_table({0.5, 1.2, 0.1, -0.4}));
    EXPECT_EQ(outcome(*text), Outcome::kVerified);
  }
}

TEST_F(ADamagedValueOnAWay, IsNotVerifiedWithOtherTrees) {
  for (const std::string* const text : {&safe_, &attained_}) {
    // One tree is left out, or two change places.
    std::vector<std::string> parts;
    std::size_t at = 0;
    for (std::size_t next = text->find("\ntree\n"); next != std::string::npos;
         next = text->find("\ntree\n", at + 1)) {
      parts.push_back(text->substr(at, next - at));
      at = next;
    }
    const std::size_t end = text->rfind("\nend ");
    parts.push_back(text->substr(at, end - at));
    ASSERT_EQ(parts.size(), 4U);
    const auto joined = [&](const std::vector<std::size_t>& order) {
      std::string all = parts[0];
      for (const std::size_t k : order) all += parts[k];
      std::size_t leaves = 0;
      for (std::size_t l = all.find("\nl "); l != std::string::npos; l = all.find("\nl ", l + 1))
        ++leaves;
      return all + "\nend " + std::to_string(leaves) + '\n';
    };
    EXPECT_EQ(joined({1, 2, 3}), *text);
    for (const std::vector<std::size_t>& order : std::vector<std::vector<std::size_t>>{
             {1, 2}, {2, 3}, {1, 3}, {2, 1, 3}, {1, 3, 2}, {3, 2, 1}, {1, 1, 3}, {1, 2, 3, 3}, {}})
      expect_refused(joined(order), "with other trees");
  }
}

}  // namespace
}  // namespace regulus::detail::test
