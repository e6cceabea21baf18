// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of pavings of one variable, which tests read and forge.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "codegen/answer/certificate/proof_status.hpp"
#include "tests/property/closure/checked_closures.hpp"

namespace regulus::detail::test {

/// Returns what `certify` writes; empty if it writes nothing.
template <class Certify>
std::string written(const Certify& certify) {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "certificate").string();
  const ProofStatus status = certify(path);
  std::ostringstream text;
  if (status.is_written()) text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Returns the text with another part in the place of one that it has.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

struct PavedLeaf {
  std::size_t line = 0;
  double lo = 0, hi = 0;
  std::string word;
  std::vector<double> tube;  ///< x₀, c, S, r; empty: none
};

/// A tree of boxes of one variable as text.
class PavedTreeText {
 public:
  /// The tree of a certificate, over this range. `tree`: of a way, from 0.
  PavedTreeText(const std::string& certificate, double lo, double hi, std::size_t tree = 0)
      : lo_(lo), hi_(hi) {
    std::istringstream text(certificate);
    for (std::string line; std::getline(text, line);) lines_.push_back(line);
    std::vector<std::size_t> trees;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (lines_[i] == "proof") first_ = i + 1;
      if (lines_[i] == "tree") trees.push_back(i + 1);
    }
    if (!trees.empty()) first_ = trees.at(tree);
    last_ = first_;
    while (last_ < lines_.size() && lines_[last_] != "tree" && !lines_[last_].starts_with("end "))
      ++last_;
  }

  [[nodiscard]] std::vector<PavedLeaf> leaves() const {
    std::map<std::size_t, std::pair<double, double>> boxes{{0, {lo_, hi_}}};
    std::vector<PavedLeaf> leaves;
    std::size_t next = 1;
    for (std::size_t i = first_; i < last_; ++i) {
      std::istringstream words(lines_[i]);
      std::string kind, number;
      std::size_t box = 0, variable = 0;
      words >> kind >> box;
      if (kind == "s") {
        words >> variable >> number;
        const double at = std::strtod(number.c_str(), nullptr);
        boxes[next++] = {boxes[box].first, at};
        boxes[next++] = {at, boxes[box].second};
      } else if (kind == "l") {
        PavedLeaf leaf{i, boxes[box].first, boxes[box].second, "", {}};
        words >> leaf.word;
        while (words >> number) leaf.tube.push_back(std::strtod(number.c_str(), nullptr));
        leaves.push_back(leaf);
      }
    }
    return leaves;
  }

  [[nodiscard]] double length(const std::string& word) const {
    double sum = 0;
    for (const PavedLeaf& leaf : leaves()) sum += leaf.word == word ? leaf.hi - leaf.lo : 0;
    return sum;
  }

  /// Returns the certificate with another claim of a leaf.
  [[nodiscard]] std::string with(const PavedLeaf& leaf, const std::string& word,
                                 const std::vector<double>& tube) const {
    std::vector<std::string> lines = lines_;
    std::string& line = lines[leaf.line];
    line = line.substr(0, line.find(' ', 2) + 1) + word;
    for (const double x : tube) line += fmt::format(" {:a}", x);
    return joined(lines);
  }

  /// Returns the certificate with another tree.
  [[nodiscard]] std::string with_tree_of(const PavedTreeText& other) const {
    std::vector<std::string> lines(lines_.begin(), lines_.begin() + std::ptrdiff_t(first_));
    lines.insert(lines.end(), other.lines_.begin() + std::ptrdiff_t(other.first_),
                 other.lines_.begin() + std::ptrdiff_t(other.last_));
    lines.insert(lines.end(), lines_.begin() + std::ptrdiff_t(last_), lines_.end());
    std::size_t count = 0;
    for (const std::string& line : lines) count += line.starts_with("l ") ? 1 : 0;
    lines.back() = fmt::format("end {}", count);
    return joined(lines);
  }

  [[nodiscard]] std::size_t splits() const { return cuts().size(); }
  /// Moves a cut by a part of the width of the smaller of its halves.
  [[nodiscard]] std::string with_cut_moved(std::size_t split, double part) const {
    const auto [line, width] = cuts().at(split);
    std::vector<std::string> lines = lines_;
    std::istringstream words(lines[line]);
    std::string kind, box, variable, number;
    words >> kind >> box >> variable >> number;
    lines[line] = fmt::format("s {} {} {:a}", box, variable,
                              std::strtod(number.c_str(), nullptr) + part * width);
    return joined(lines);
  }

 private:
  /// The lines of splits, with the widths of the narrowest leaf of each side.
  [[nodiscard]] std::vector<std::pair<std::size_t, double>> cuts() const {
    std::vector<std::pair<std::size_t, double>> cuts;
    for (std::size_t i = first_; i < last_; ++i) {
      if (!lines_[i].starts_with("s ")) continue;
      const double at = std::strtod(lines_[i].substr(lines_[i].rfind(' ')).c_str(), nullptr);
      double width = INFINITY;
      for (const PavedLeaf& leaf : leaves())
        if (leaf.lo == at || leaf.hi == at) width = std::fmin(width, leaf.hi - leaf.lo);
      cuts.emplace_back(i, width);
    }
    return cuts;
  }
  static std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + '\n';
    return text;
  }

  double lo_, hi_;
  std::vector<std::string> lines_;
  std::size_t first_ = 0, last_ = 0;  ///< the lines of the tree
};

}  // namespace regulus::detail::test
