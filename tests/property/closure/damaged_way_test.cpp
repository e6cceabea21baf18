// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of branches along way-points that were damaged: none is verified.
#include <gtest/gtest.h>

#include "tests/property/closure/checked_ways.hpp"

namespace regulus::detail::test {
namespace {

using verifier::Outcome;

/// The square root of x + iy, with a tolerance.
const std::string kModel =
    "regulus = 1\nname = \"root\"\n[pose]\nx = \"m\"\ny = \"m\"\n[geometry]\n"
    "a = { value = 1, tolerance = 0.001, group = \"a\" }\n[closure]\n"
    "unknowns = { p = \"m\", q = \"m\" }\nequations = [\"p^2 - q^2 - a*x\", \"2*p*q - y\"]\n"
    "start = { x = 1, y = 0, p = 1, q = 0 }\n[motion.m]\nx = [-2, 2]\ny = [-2, 2]\n"
    "error = { x = 0.001 }\n";
const std::string kWay = "x,y\n1,0\n1,1\n-1,1\n1,1\n1,0\n1,-1\n";
/// The third segment goes through 0, to within the error.
const std::string kThrough = "x,y\n1,0\n1,1\n1,0\n-1,0\n";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

/// A certificate in parts: the lines `piece`, the trees, and what is around them.
struct Parts {
  std::string before, between;
  std::vector<std::string> pieces, trees;

  explicit Parts(const std::string& certificate) {
    for (const std::string& line : lines_of(certificate)) {
      if (line.starts_with("piece "))
        pieces.push_back(line + '\n');
      else if (line == "tree")
        trees.push_back(line + '\n');
      else if (line.starts_with("end "))
        continue;
      else
        (!trees.empty() ? trees.back() : pieces.empty() ? before : between) += line + '\n';
    }
  }
  [[nodiscard]] std::string text() const {
    std::string all = before;
    for (const std::string& piece : pieces) all += piece;
    all += between;
    std::size_t leaves = 0;
    for (const std::string& tree : trees) {
      all += tree;
      for (const std::string& line : lines_of(tree)) leaves += line.starts_with("l ") ? 1 : 0;
    }
    return all + "end " + std::to_string(leaves) + '\n';
  }
};

/// The tubes of −p, −q: of the other branch of the same equations.
std::string mirrored(const std::string& tree) {
  constexpr std::size_t kVariables = 3, kUnknowns = 2;
  std::vector<std::string> lines = lines_of(tree);
  for (std::string& line : lines) {
    if (!line.starts_with("l ")) continue;
    std::istringstream words(line);
    std::string word, changed;
    const std::size_t first = 3 + kVariables, last = first + kUnknowns + kUnknowns * kVariables;
    for (std::size_t i = 0; words >> word; ++i) {
      const bool turns = i >= first && i < last;
      if (turns) word = word.starts_with('-') ? word.substr(1) : "-" + word;
      changed += (i == 0 ? "" : " ") + word;
    }
    line = changed;
  }
  return text_of(lines);
}

class ADamagedWay : public testing::Test {
 protected:
  WayFile file_{kWay};
  const std::string certificate_ = certified_way(check_way_text(kModel, file_.path()));

  [[nodiscard]] verifier::Verification verify(const std::string& certificate) const {
    return verified_way(certificate, kModel, file_.path());
  }
  void expect_not_verified(const std::string& certificate, const char* what) const {
    EXPECT_NE(verified(certificate).outcome, Outcome::kVerified) << what << ", of itself";
    EXPECT_NE(verify(certificate).outcome, Outcome::kVerified) << what;
  }
};

TEST_F(ADamagedWay, WithoutDamageIsVerified) {
  ASSERT_FALSE(certificate_.empty());
  EXPECT_EQ(Parts(certificate_).text(), certificate_);
  EXPECT_EQ(verify(certificate_).outcome, Outcome::kVerified) << describe(verify(certificate_));
  EXPECT_EQ(verified(certificate_).outcome, Outcome::kVerified);
}

TEST_F(ADamagedWay, WithOtherPiecesIsNotVerified) {
  const Parts parts(certificate_);
  ASSERT_EQ(parts.pieces.size(), 5U);
  ASSERT_EQ(parts.trees.size(), 5U);
  for (std::size_t k = 0; k < parts.pieces.size(); ++k) {
    Parts fewer = parts;
    fewer.pieces.erase(fewer.pieces.begin() + std::ptrdiff_t(k));
    fewer.trees.erase(fewer.trees.begin() + std::ptrdiff_t(k));
    EXPECT_NE(verify(fewer.text()).outcome, Outcome::kVerified) << "without piece " << k + 1;
    // Without its last piece, it is a proof about another way.
    if (k + 1 < parts.pieces.size()) expect_not_verified(fewer.text(), "without a piece");
    Parts without_tree = parts;
    without_tree.trees.erase(without_tree.trees.begin() + std::ptrdiff_t(k));
    expect_not_verified(without_tree.text(), "without a tree");
    for (std::size_t j = 0; j < k; ++j) {
      Parts swapped = parts;
      std::swap(swapped.pieces[j], swapped.pieces[k]);
      std::swap(swapped.trees[j], swapped.trees[k]);
      expect_not_verified(swapped.text(), "with two pieces swapped");
      Parts trees = parts;
      std::swap(trees.trees[j], trees.trees[k]);
      if (trees.text() != certificate_) expect_not_verified(trees.text(), "with two trees swapped");
    }
  }
}

TEST_F(ADamagedWay, OnTheOtherBranchIsNotVerified) {
  const Parts parts(certificate_);
  for (std::size_t k = 0; k < parts.trees.size(); ++k) {
    Parts other = parts;
    other.trees[k] = mirrored(parts.trees[k]);
    expect_not_verified(other.text(), "with the mirrored tubes of one piece");
    for (std::size_t j = k + 1; j < parts.trees.size(); ++j)
      other.trees[j] = mirrored(parts.trees[j]);
    expect_not_verified(other.text(), "with the mirrored tubes of all pieces from one on");
    // One tube alone.
    std::vector<std::string> lines = lines_of(parts.trees[k]);
    for (std::string& line : lines)
      if (line.starts_with("l ")) {
        line = mirrored(line).substr(0, mirrored(line).size() - 1);
        break;
      }
    other = parts;
    other.trees[k] = text_of(lines);
    expect_not_verified(other.text(), "with one mirrored tube");
  }
}

TEST_F(ADamagedWay, IsNotThatOfAnotherFileOrStart) {
  for (const char* const table :
       {"x,y\n1,0\n1,1\n-1,1\n1,1\n1,0\n1,-1\n1,0\n", "x,y\n1,0\n1,1\n-1,1\n1,1\n1,0\n",
        "x,y\n1,0\n1,1\n-1,1.0001\n1,1\n1,0\n1,-1\n", "x,y\n1,0\n1,1\n-1,1\n1,1\n1,0\n1,-1.5\n",
        "x,y\n1,0.5\n1,1\n-1,1\n1,1\n1,0\n1,-1\n", "y,x\n1,0\n1,1\n-1,1\n1,1\n1,0\n1,-1\n"}) {
    file_.write(table);
    EXPECT_EQ(verify(certificate_).outcome, Outcome::kRejected) << table;
  }
  file_.write(kWay);
  const auto with = [&](const std::string& old, const std::string& by) {
    std::string text = certificate_;
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return text.replace(at, old.size(), by);
  };
  expect_not_verified(with("\nunknown p = 1 ", "\nunknown p = -1 "), "with another start");
  EXPECT_NE(verify(with("\nstart 0\n", "\nstart 1/2\n")).outcome, Outcome::kVerified);
  expect_not_verified(with("\nstart 0\n", "\nstart 1\n"), "from the end");
  expect_not_verified(with("parameter s in 0 : 1", "parameter s in 0 : 2"), "with a longer piece");
  expect_not_verified(with("parameter s in 0 : 1", "parameter s in 0 : 1/2"), "with a shorter one");
  const std::string model = kModel;
  const std::size_t at = model.find("p = 1, q = 0 }");
  std::string other = model;
  other.replace(at, 14, "p = -1, q = 0 }");
  EXPECT_EQ(verified_way(certificate_, other, file_.path()).outcome, Outcome::kRejected);
}

/// Two pieces would have different equations at their joint.
TEST_F(ADamagedWay, WithTheNumbersOfAPieceInItsEquationsIsUnfinished) {
  for (const char* const equation : {"\nequation a*x", "\nequation 2*p*q", "\nequation "})
    for (const char* const name : {"x_c0", "y_c1"}) {
      std::string changed = certificate_;
      const std::size_t at = changed.find(equation);
      if (at == std::string::npos) continue;
      changed.insert(changed.find('\n', at + 1), std::string(" + 0*") + name);
      const verifier::Verification v = verified(changed);
      EXPECT_EQ(v.outcome, Outcome::kUnfinished) << equation << describe(v);
    }
}

TEST(ADamagedWayToAFold, IsNotVerified) {
  const WayFile file(kThrough);
  EXPECT_NE(check_way_text(kModel, file.path(), few_boxes()).verdict(), Verdict::kNoSingularity);

  const std::string model =
      "regulus = 1\nname = \"slider\"\n[pose]\nx = \"m\"\n[closure]\nunknowns = { p = \"m\" }\n"
      "equations = [\"p^2 - x - 1\"]\nstart = { x = 0, p = 1 }\nradius = { p = 0.5 }\n[motion.m]\n"
      "x = [-2, 1]\n";
  const WayFile way("x\n0\n1\n0.5\n-2\n3\n");
  const CheckedWay reached = check_way_text(model, way.path());
  ASSERT_EQ(reached.verdict(), Verdict::kSingularity) << reached.claim();
  EXPECT_EQ(reached.found.deciding->index, 2U);
  EXPECT_NEAR(mid(reached.found.deciding->fold->place[0]), 0.6, 1e-9);
  const std::string certificate = certified_way(reached);
  const auto outcome = [&](const std::string& text) {
    return verified_way(text, model, way.path()).outcome;
  };
  EXPECT_EQ(outcome(certificate), Outcome::kVerified)
      << certificate << describe(verified_way(certificate, model, way.path()));
  Parts parts(certificate);
  ASSERT_EQ(parts.pieces.size(), 3U);
  ASSERT_EQ(parts.trees.size(), 2U);
  std::vector<std::string> lines = lines_of(certificate);
  // Without the first piece it is a proof from another place.
  std::vector<std::string> fewer;
  bool is_first = true, is_in_first_tree = false;
  for (const std::string& line : lines) {
    if (line == "tree") is_in_first_tree = std::exchange(is_first, false);
    if (line.starts_with("reason ")) is_in_first_tree = false;
    if (line == parts.pieces[0].substr(0, parts.pieces[0].size() - 1) || is_in_first_tree) continue;
    fewer.push_back(line);
  }
  EXPECT_NE(outcome(text_of(fewer)), Outcome::kVerified);
  EXPECT_NE(verified(text_of(fewer)).outcome, Outcome::kVerified);
  // The last piece alone.
  std::vector<std::string> none;
  for (const std::string& line : lines)
    if (line != "tree" && !line.starts_with("s ") && !line.starts_with("l ")) none.push_back(line);
  EXPECT_NE(verified(text_of(none)).outcome, Outcome::kVerified);
  // Another way.
  for (const char* const table : {"x\n0\n1\n0.5\n-0.9\n3\n", "x\n0\n1\n", "x\n0\n1\n0.6\n-2\n"}) {
    way.write(table);
    EXPECT_EQ(outcome(certificate), Outcome::kRejected) << table;
  }
}

}  // namespace
}  // namespace regulus::detail::test
