// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs about the branches p = ±√(1 + x + y) of p² = 1 + x + y, in one file and in shards.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tests/support/shards.hpp"

namespace regulus::detail::test {

using Range = std::array<double, 2>;
using Place = std::array<Range, 2>;  ///< x and y

inline constexpr Place kSquare{{{0, 2}, {0, 2}}};

inline std::string leaf(std::size_t number, const Place& at, double sign, double of_pose = 0) {
  const double x = (at[0][0] + at[0][1]) / 2, y = (at[1][0] + at[1][1]) / 2;
  const double p = std::sqrt(1 + of_pose + x + y),
               h = (at[0][1] - at[0][0] + at[1][1] - at[1][0]) / 2;
  return fmt::format("l {} tube {:a} {:a} {:a} {:a} {:a} {:a}\n", number, x, y, sign * p,
                     sign / (2 * p), sign / (2 * p), h * h / (4 * p * p * p) + 1e-6);
}

/// The lines of a proof, and the boxes that wait between two of them.
class BranchLines {
 public:
  explicit BranchLines(const Place& root = kSquare, std::size_t piece = 0)
      : root_(root), piece_(piece) {
    begin_tree();
  }

  [[nodiscard]] std::size_t size() const { return lines_.size(); }
  [[nodiscard]] std::string& line(std::size_t i) { return lines_.at(i); }
  [[nodiscard]] const Place& box(std::size_t number) const { return open_.at(number); }

  /// Returns the number of the lower part.
  std::size_t split(std::size_t number, std::size_t variable, double at) {
    Place lower = open_.at(number), upper = lower;
    lower[variable][1] = upper[variable][0] = at;
    open_.erase(number);
    open_[next_] = lower, open_[next_ + 1] = upper;
    next_ += 2;
    put(fmt::format("s {} {} {:a}\n", number, variable, at));
    return next_ - 2;
  }
  void leave(std::size_t number, double sign, double of_pose = 0) {
    const std::string text = leaf(number, open_.at(number), sign, of_pose);
    open_.erase(number);
    put(text);
  }
  void leave_outside(std::size_t number) {
    open_.erase(number);
    put(fmt::format("l {} outside\n", number));
  }
  void tree() {
    ++piece_;
    begin_tree();
    put("tree\n");
  }
  /// Halves the box and its parts `depth` times, each leaf of the branch that `sign` says.
  template <class Sign>
  void grow(std::size_t number, int depth, const Sign& sign, double of_pose = 0) {
    if (depth == 0) return leave(number, sign(open_.at(number)), of_pose);
    const std::size_t variable = std::size_t(depth) % 2;
    const Range range = open_.at(number)[variable];
    const std::size_t lower = split(number, variable, (range[0] + range[1]) / 2);
    grow(lower, depth - 1, sign, of_pose);
    grow(lower + 1, depth - 1, sign, of_pose);
  }

  /// Returns shards that end after so many lines each, as long as there are lines.
  [[nodiscard]] std::vector<HandmadeShard> cut(const std::vector<std::size_t>& sizes) const {
    std::vector<HandmadeShard> shards;
    for (std::size_t at = 0, i = 0; at < lines_.size(); ++i) {
      HandmadeShard& shard = shards.emplace_back();
      shard.open = heads_[at];
      const std::size_t end = std::min(lines_.size(), at + sizes[i % sizes.size()]);
      for (; at < end; ++at) {
        shard.lines += lines_[at];
        shard.leaves += lines_[at][0] == 'l';
      }
    }
    return shards;
  }
  /// The proof in one file.
  [[nodiscard]] std::string text() const {
    std::string all = piece_ > 0 ? "tree\n" : "";
    unsigned leaves = 0;
    for (const std::string& line : lines_) all += line, leaves += line[0] == 'l';
    return all + fmt::format("end {}\n", leaves);
  }

 private:
  void begin_tree() {
    open_ = {{0, root_}};
    next_ = 1;
    if (lines_.empty()) heads_ = {head()};
  }
  void put(const std::string& line) {
    lines_.push_back(line);
    heads_.push_back(head());
  }
  [[nodiscard]] std::string head() const {
    std::string text = piece_ > 0 ? fmt::format("piece {}\n", piece_) : "";
    text += fmt::format("next {}\n", next_);
    for (const auto& [number, box] : open_) {
      text += fmt::format("open {}", number);
      for (std::size_t k = 0; k < 2; ++k)
        text += fmt::format(" {} {:a} {:a}", k, box[k][0], box[k][1]);
      text += '\n';
    }
    return text;
  }

  const Place root_;
  std::size_t piece_;
  std::vector<std::string> lines_, heads_;  ///< a head before each line, and one after the last
  std::map<std::size_t, Place> open_;
  std::size_t next_ = 1;
};

}  // namespace regulus::detail::test
