// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates about forces: what the search shows, the verifier proves; and of those that somebody
// has changed, none is verified for a claim that is false.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <sstream>

#include "codegen/question/load/force_certificate.hpp"
#include "runtime/verifier/verify.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {
namespace {

/// A bead on a rail between two pulleys. J⁻¹ has the rows x + 1 and x − 1.
std::string bead(const std::string& more = "") {
  return R"toml(regulus = 1
name = "bead"
[pose]
x = "m"
[matrix]
twist = ["v_x"]
rows = [["x + 1"], ["x - 1"]]
[load.push]
force = [[-2, 2]]
[actuators]
force = [1, 9]
[motion.m]
x = [-0.5, 0.5]
[motion.wide]
x = [-1.5, 1.5]
)toml" + more;
}

/// Four cables hold a plate in the plane; an anchor is uncertain, and the load has a ball.
constexpr const char* kPlate = R"toml(regulus = 1
name = "plate"
[pose]
x = "m"
y = "m"
[geometry]
a = { value = 3, tolerance = 0.01, group = "a" }
[matrix]
twist = ["v_x", "v_y"]
rows = [["x - a", "y - 3"], ["x + 3", "y - 3"], ["x + 3", "y + 3"], ["x - 3", "y + 3"]]
row_scale = ["1/sqrt((x - a)^2 + (y - 3)^2)", "1/sqrt((x + 3)^2 + (y - 3)^2)",
             "1/sqrt((x + 3)^2 + (y + 3)^2)", "1/sqrt((x - 3)^2 + (y + 3)^2)"]
[load.pull]
wrench = { value = [0, -2], radius = 1 }
[load.more]
wrench = { value = [0, -2], radius = 14 }
[actuators]
force = [1, 10]
[motion.m]
x = [-1, 1]
y = [-1, 1]
constraints = ["x^2 + y^2 - 1"]
)toml";

struct Proof {
  FeasibilityResult result;
  std::string certificate;  ///< empty: none was written
};

Proof proof_of(const std::string& text, const std::string& motion, const std::string& load,
               bool paves) {
  const TemporaryDirectory folder;
  ModelOptions model;
  model.path = "test.toml";
  model.text = text;
  model.motion = motion;
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  PreparedForces prepared = prepare_forces(model, load, search, {});
  FeasibilitySettings settings = settings_of(prepared, nullptr);
  settings.threads = 2;
  settings.paves = paves;
  if (paves) settings.min_relative_width = 1.0 / 32;
  const std::string path = folder.path() / "proof";
  ForceCertificate certificate(path, prepared, paves, 0);
  const auto ignore = [](std::span<const Interval>, ForceClaim) {};
  Proof proof{run_forces(prepared, settings, ignore, certificate.observer()), ""};
  certificate.finish(proof.result);
  std::ifstream file(path);
  std::stringstream contents;
  contents << file.rdbuf();
  proof.certificate = contents.str();
  return proof;
}

verifier::Verification verified(const std::string& certificate, const std::string& model = "") {
  std::istringstream file(certificate);
  verifier::Options options;
  options.max_boxes = 4000;
  options.max_boxes_per_leaf = 500;
  options.max_bits = 256;
  options.model_text = model;
  options.model_name = "test.toml";
  return verifier::verify(file, options);
}

void expect_verified(const Proof& proof, const std::string& model) {
  ASSERT_FALSE(proof.certificate.empty());
  const verifier::Verification v = verified(proof.certificate, model);
  EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << v.reason << proof.certificate;
  EXPECT_TRUE(v.differences.empty());
}

TEST(LoadCertificate, IsVerifiedForEachVerdict) {
  const Proof held = proof_of(bead(), "m", "push", false);
  EXPECT_EQ(held.result.verdict, FeasibilityVerdict::kFeasible);
  expect_verified(held, bead());
  const Proof not_held = proof_of(bead(), "wide", "push", false);
  EXPECT_EQ(not_held.result.verdict, FeasibilityVerdict::kInfeasible);
  expect_verified(not_held, bead());
  expect_verified(proof_of(bead(), "wide", "push", true), bead());
}

TEST(LoadCertificate, IsVerifiedWithBallsScalesConstraintsAndTolerances) {
  const Proof held = proof_of(kPlate, "m", "pull", false);
  EXPECT_EQ(held.result.verdict, FeasibilityVerdict::kFeasible);
  expect_verified(held, kPlate);
  const Proof not_held = proof_of(kPlate, "m", "more", false);
  EXPECT_EQ(not_held.result.verdict, FeasibilityVerdict::kInfeasible);
  expect_verified(not_held, kPlate);
  expect_verified(proof_of(kPlate, "m", "more", true), kPlate);
}

TEST(LoadCertificate, CountsTheLeavesOfAPaving) {
  const verifier::Verification v = verified(proof_of(bead(), "wide", "push", true).certificate);
  EXPECT_GT(v.paved[0], 0U);
  EXPECT_GT(v.paved[1], 0U);
  EXPECT_EQ(v.paved[0] + v.paved[1] + v.paved[2] + v.paved[3], v.leaves);
  EXPECT_NE(describe(v).find("paved      "), std::string::npos);
}

TEST(LoadCertificate, IsNotThatOfAnotherLoadOrOtherLimits) {
  const std::string certificate = proof_of(bead(), "m", "push", false).certificate;
  for (const auto& [from, to] : {std::pair("[[-2, 2]]", "[[-3, 2]]"), std::pair("[1, 9]", "[1, 8]"),
                                 std::pair("[1, 9]", "[[1, 9], [2, 9]]")}) {
    std::string other = bead();
    other.replace(other.find(from), std::string_view(from).size(), to);
    const verifier::Verification v = verified(certificate, other);
    EXPECT_EQ(v.outcome, verifier::Outcome::kRejected) << to;
    EXPECT_NE(v.reason.find("the certificate is not about"), std::string::npos) << v.reason;
  }
}

/// A smaller load is another load, even if a line is missing.
TEST(LoadCertificate, IsNotThatOfASmallerLoad) {
  const std::string certificate = proof_of(kPlate, "m", "pull", false).certificate;
  std::string without = certificate;
  const std::size_t ball = without.find("wrench-ball");
  without.erase(ball, without.find('\n', ball) + 1 - ball);
  std::string other_name = certificate;
  other_name.replace(other_name.find("load pull"), 9, "load push");
  for (const std::string& changed : {without, other_name}) {
    EXPECT_EQ(verified(changed).outcome, verifier::Outcome::kVerified);
    const verifier::Verification v = verified(changed, kPlate);
    EXPECT_EQ(v.outcome, verifier::Outcome::kRejected);
    EXPECT_NE(v.reason.find("the certificate is not about"), std::string::npos) << v.reason;
  }
}

/// Without names of columns, they are those of the pose parameters, by their units.
TEST(LoadCertificate, IsComparedWithoutNamesOfColumns) {
  std::string text = bead();
  text.erase(text.find("twist = "), std::string_view("twist = [\"v_x\"]\n").size());
  const std::string certificate = proof_of(text, "m", "push", false).certificate;
  EXPECT_EQ(verified(certificate, text).outcome, verifier::Outcome::kVerified)
      << verified(certificate, text).reason;
  text.replace(text.find("[[-2, 2]]"), 9, "[[-2, 1]]");
  EXPECT_EQ(verified(certificate, text).outcome, verifier::Outcome::kRejected);
}

/// The numbers of a certificate about a bead, and its leaves.
struct Claim {
  std::string verdict;
  double low = 0, high = 0, middle = 0, spread = 0;
  std::vector<std::pair<double, double>> limits;
  std::vector<std::string> rows;
  struct Leaf {
    double low, high;
    std::string word;
  };
  std::vector<Leaf> leaves;
};

double number(std::string text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return std::stod(text);
  return std::stod(text.substr(0, slash)) / std::stod(text.substr(slash + 1));
}

std::pair<double, double> two_numbers(const std::string& text, const std::string& mark) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos) throw std::invalid_argument(text);
  return {number(text.substr(0, at)), number(text.substr(at + mark.size()))};
}

/// Returns nullopt for a text that is not about a bead.
std::optional<Claim> claim_of(const std::string& certificate) try {
  Claim claim;
  std::map<std::size_t, std::pair<double, double>> open;
  std::size_t next = 1;
  std::istringstream lines(certificate);
  for (std::string line; std::getline(lines, line);) {
    const std::string key = line.substr(0, line.find(' '));
    const std::string rest = line.substr(std::min(line.size(), key.size() + 1));
    std::istringstream words(rest);
    if (key == "verdict") claim.verdict = rest;
    if (key == "parameter") {
      std::tie(claim.low, claim.high) = two_numbers(rest.substr(5), " : ");
      open[0] = {claim.low, claim.high};
    }
    if (key == "entry") claim.rows.push_back(rest);
    if (key == "wrench") std::tie(claim.middle, claim.spread) = two_numbers(rest, " +- ");
    if (key == "limits") claim.limits.push_back(two_numbers(rest, " : "));
    if (key == "wrench-ball" || key == "constraint" || key == "scale" || key == "let")
      return std::nullopt;
    if (key == "s") {
      std::size_t box = 0, variable = 0;
      std::string at;
      words >> box >> variable >> at;
      const auto [low, high] = open.at(box);
      open.erase(box);
      open[next++] = {low, std::stod(at)};
      open[next++] = {std::stod(at), high};
    }
    if (key == "l") {
      std::size_t box = 0;
      std::string word;
      words >> box >> word;
      claim.leaves.push_back({open.at(box).first, open.at(box).second, word});
    }
  }
  if (claim.limits.size() != 2 || claim.rows != std::vector<std::string>{"x + 1", "x - 1"})
    return std::nullopt;
  return claim;
} catch (const std::exception&) {
  return std::nullopt;
}

/// How far the worst wrench of the load is from what the forces at x can hold; negative: not held.
double reserve(const Claim& claim, double x) {
  double least = 0, most = 0;
  for (const auto& [row, limits] :
       {std::pair(x + 1, claim.limits[0]), std::pair(x - 1, claim.limits[1])}) {
    least += std::fmin(row * limits.first, row * limits.second);
    most += std::fmax(row * limits.first, row * limits.second);
  }
  return std::fmin(most - claim.middle - claim.spread, claim.middle - claim.spread - least);
}

bool is_held(const Claim& claim, double low, double high, bool everywhere) {
  constexpr int kSamples = 64;
  constexpr double kSlack = 1e-9;
  for (int i = 0; i <= kSamples; ++i) {
    const double r = reserve(claim, low + (high - low) * i / kSamples);
    if (everywhere && r < -kSlack) return false;
    if (!everywhere && r > kSlack) return false;
  }
  return true;
}

bool is_true(const Claim& claim) {
  if (claim.spread < 0) return false;
  for (const auto& [least, largest] : claim.limits)
    if (least > largest) return false;
  if (claim.verdict == format::kFeasible) return is_held(claim, claim.low, claim.high, true);
  if (claim.verdict == format::kInfeasible)
    return !is_held(claim, claim.low, claim.high, true) ||
           std::fmin(reserve(claim, claim.low), reserve(claim, claim.high)) < 1e-9;
  for (const Claim::Leaf& leaf : claim.leaves) {
    if (leaf.word == format::kFeasibleLeaf && !is_held(claim, leaf.low, leaf.high, true))
      return false;
    if (leaf.word == format::kInfeasibleLeaf && !is_held(claim, leaf.low, leaf.high, false))
      return false;
    if (leaf.word == format::kOutsideLeaf) return false;
  }
  return true;
}

/// Changes a certificate so that it may still be read.
class Damage {
 public:
  explicit Damage(unsigned seed) : random_(seed) {}

  std::string done_to(std::string text) {
    switch (random_() % 4) {
      case 0:
        return with_word(std::move(text));
      case 1:
        return without_line(std::move(text));
      case 2:
        text[random_() % text.size()] = "0123456789-+ .splx"[random_() % 18];
        return text;
      default:
        return with_number(std::move(text));
    }
  }

 private:
  std::string with_word(std::string text) {
    static const std::vector<std::string> kWords{"feasible", "infeasible", "undecided", "outside"};
    const std::string& from = kWords[random_() % kWords.size()];
    const std::size_t proof = text.find("\nproof");
    std::size_t at = text.find(' ' + from + '\n', proof + random_() % (text.size() - proof));
    if (at == std::string::npos) return with_number(std::move(text));
    return text.replace(at + 1, from.size(), kWords[random_() % kWords.size()]);
  }

  std::string without_line(std::string text) {
    const std::size_t at = text.find('\n', random_() % text.size());
    if (at != std::string::npos) text.erase(at, text.find('\n', at + 1) - at);
    return text;
  }

  /// Replaces a number of the question, or of the witness.
  std::string with_number(std::string text) {
    static const std::vector<std::string> kLines{"\nlimits ", "\nwrench ", "\nparameter x in ",
                                                 "\npoint 0 ", "\ndirection "};
    const std::string& line = kLines[random_() % kLines.size()];
    const std::size_t begin = text.find(line);
    if (begin == std::string::npos) return text;
    std::vector<std::size_t> places;  // of the line's numbers
    for (std::size_t at = begin + line.size(); at < text.size() && text[at] != '\n'; ++at)
      if (std::isdigit(static_cast<unsigned char>(text[at])) != 0 &&
          std::string_view(" -\n").find(text[at - 1]) != std::string_view::npos)
        places.push_back(at);
    if (places.empty()) return text;
    const std::size_t at = places[random_() % places.size()];
    return text.replace(at, text.find_first_of(" \n", at) - at, number_text());
  }

  std::string number_text() { return fmt::format("{}/{}", random_() % 40, 1 + random_() % 8); }

  std::mt19937 random_;
};

/// Gives a certificate the verdict and the claim of another one.
std::string with_head_of(const std::string& other, const std::string& text) {
  return other.substr(0, other.find("\nmodel ")) + text.substr(text.find("\nmodel "));
}

TEST(LoadCertificate, IsNeverVerifiedForAFalseClaim) {
  const std::vector<std::string> originals{proof_of(bead(), "m", "push", false).certificate,
                                           proof_of(bead(), "wide", "push", false).certificate,
                                           proof_of(bead(), "wide", "push", true).certificate};
  for (const std::string& original : originals) {
    const auto claim = claim_of(original);
    ASSERT_TRUE(claim && is_true(*claim)) << original;
  }
  int verified_count = 0, false_count = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    const std::string& original = originals[seed % originals.size()];
    const std::string changed = Damage(seed).done_to(
        seed % 16 == 0 ? with_head_of(originals[seed % 48 / 16], original) : original);
    const verifier::Verification v = verified(changed);
    const std::optional<Claim> claim = claim_of(changed);
    false_count += claim && !is_true(*claim);
    if (v.outcome != verifier::Outcome::kVerified) {
      EXPECT_FALSE(v.reason.empty());
      continue;
    }
    ++verified_count;
    if (claim) {
      EXPECT_TRUE(is_true(*claim)) << changed;
    }
  }
  EXPECT_GT(verified_count, 100);
  EXPECT_GT(false_count, 300);
}

}  // namespace
}  // namespace regulus::detail::test
