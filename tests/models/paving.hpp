// SPDX-License-Identifier: GPL-3.0-or-later
// A slice of two parameters, paved by `regulus locate`, is compared with a function that vanishes
// exactly at the singular poses of the robot.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "tests/models/shipped_model.hpp"

namespace regulus::detail::test {

using Function = std::function<double(double, double)>;

struct Rectangle {
  double left, right, bottom, top;

  [[nodiscard]] bool holds(double p, double q) const {
    return left <= p && p <= right && bottom <= q && q <= top;
  }
  /// Returns a rectangle grown by this part of its size on each side; smaller if negative.
  [[nodiscard]] Rectangle grown(double part) const {
    const double dp = part * (right - left), dq = part * (top - bottom);
    return {left - dp, right + dp, bottom - dq, top + dq};
  }
};

/// Returns the least and the largest value of f on an 8 × 8 grid.
inline std::pair<double, double> sampled_range(const Function& f, const Rectangle& r) {
  double least = INFINITY, largest = -INFINITY;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const double value =
          f(r.left + (r.right - r.left) * i / 7, r.bottom + (r.top - r.bottom) * j / 7);
      least = std::min(least, value);
      largest = std::max(largest, value);
    }
  return {least, largest};
}

class Paving {
 public:
  /// `words` name the motion and fix all parameters except p and q.
  Paving(const ShippedModel& model, std::vector<std::string> words, std::string p, std::string q)
      : p_(std::move(p)), q_(std::move(q)) {
    words.insert(words.begin(), {REGULUS_BINARY_DIR "/bin/regulus", "locate", model.path()});
    words.insert(words.end(), {"--output", "-"});
    std::istringstream lines(run_command(words).output);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with('{')) add(nlohmann::json::parse(line));
  }

  [[nodiscard]] std::size_t count(const std::string& kind) const {
    return std::size_t(
        std::count_if(boxes_.begin(), boxes_.end(), [&](const Box& b) { return b.kind == kind; }));
  }
  [[nodiscard]] double fraction(const std::string& kind) const {
    return summary_[kind]["fraction"][0];
  }
  [[nodiscard]] bool is_free(double p, double q) const {
    return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& b) {
      return b.kind == "free" && b.range.grown(-1e-9).holds(p, q);
    });
  }

  /// Free boxes: f has one sign. Singular boxes: f differs in sign at the two points of the proof.
  /// Undecided boxes: f changes its sign there, or at most one box size away.
  void expect_to_agree_with(const Function& f) const {
    ASSERT_FALSE(boxes_.empty());
    for (const Box& b : boxes_) {
      SCOPED_TRACE(b.text);
      if (b.kind == "free") expect_one_sign(f, b.range.grown(-1e-9));
      if (b.kind == "singular") expect_a_change_of_sign(f, b);
      if (b.kind == "undecided") expect_both_signs(f, b.range.grown(1));
    }
  }

 private:
  struct Box {
    std::string kind, text;
    Rectangle range;
    std::vector<std::array<double, 2>> points;
  };

  void add(const nlohmann::json& line) {
    if (line.contains("summary")) summary_ = line["summary"];
    if (!line.contains("kind")) return;
    const auto& p = line["box"][p_];
    const auto& q = line["box"][q_];
    Box box{line["kind"], line["box"].dump(), {p[0], p[1], q[0], q[1]}, {}};
    if (line.contains("points"))
      for (const auto& point : line["points"])
        box.points.push_back({point["parameters"][p_][0], point["parameters"][q_][0]});
    boxes_.push_back(std::move(box));
  }

  static void expect_one_sign(const Function& f, const Rectangle& r) {
    const auto [least, largest] = sampled_range(f, r);
    EXPECT_GT(least * largest, 0);
  }
  static void expect_both_signs(const Function& f, const Rectangle& r) {
    const auto [least, largest] = sampled_range(f, r);
    EXPECT_LE(least * largest, 0);
  }
  static void expect_a_change_of_sign(const Function& f, const Box& b) {
    ASSERT_EQ(b.points.size(), 2U);
    const auto& [from, to] = std::pair(b.points[0], b.points[1]);
    EXPECT_TRUE(b.range.holds(from[0], from[1]) && b.range.holds(to[0], to[1]));
    // If the points are neighbours, f itself is rounded; then its size is tested instead.
    const double here = f(from[0], from[1]), there = f(to[0], to[1]);
    if (std::hypot(from[0] - to[0], from[1] - to[1]) > 1e-6)
      EXPECT_LE(here * there, 0);
    else
      EXPECT_LE(std::abs(here), 1e-4 * typical_size(f, b.range.grown(1)));
  }
  static double typical_size(const Function& f, const Rectangle& r) {
    const auto [least, largest] = sampled_range(f, r);
    return largest - least;
  }

  std::string p_, q_;
  std::vector<Box> boxes_;
  nlohmann::json summary_;
};

}  // namespace regulus::detail::test
