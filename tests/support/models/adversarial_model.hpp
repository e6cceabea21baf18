// SPDX-License-Identifier: GPL-3.0-or-later
// Models with a known determinant: one deliberately hard factor times positive factors. Integer row
// and column operations of determinant 1 hide the triangular matrix that has them.
#pragma once

#include <string>

#include "tests/support/models/model_text.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

class AdversarialModel {
 public:
  explicit AdversarialModel(RandomSource& random) : random_(random) {
    x_ = kRanges[random.below(std::size(kRanges))];
    y_ = kRanges[random.below(std::size(kRanges))];
    text_.geometry =
        "a = { value = \"1/3 + 1/10\", tolerance = \"1/10\" }\nb = { value = 1, "
        "tolerance = 0.5 }\np = { value = [0, 0], radius = \"1/10\" }\n";
    order_ = 2 + random.below(3);
    choose_factor();
    write_matrix();
    write_motion();
  }

  [[nodiscard]] const ModelText& text() const { return text_; }

 private:
  /// A range of x or y, and its position relative to 1/3.
  struct KnownRange {
    const char* text;
    bool holds_third, is_third;
  };
  static constexpr KnownRange kRanges[] = {{"[-1, 1]", true, false},
                                           {"[\"1/3\", \"2/3\"]", true, false},
                                           {"[-0.7, \"1/3\"]", true, false},
                                           {"\"1/3\"", true, true},
                                           {"[\"1/3\", \"1/3\"]", true, true},
                                           // a little less than 1/3, like the nearest double
                                           {"[0, \"0.33333333333333331\"]", false, false},
                                           {"[\"1/3 + 1e-12\", 1]", false, false},
                                           {"[\"1/3 + 1e-30\", 1]", false, false},
                                           {"[\"pi/9\", \"pi/5\"]", false, false},
                                           {"[\"1/3 - 1e-14\", \"1/3 + 1e-14\"]", true, false}};

  std::string pick(const std::vector<std::string>& from) {
    return from[random_.below(from.size())];
  }

  void safe() { text_.never_singular = true; }
  void singular(bool yes) { (yes ? text_.never_safe : text_.never_singular) = true; }
  void neither() { text_.never_safe = text_.never_singular = true; }

  void choose_factor() {
    switch (random_.below(14)) {
      case 0:
        return touch();
      case 1:
        return touch_in_a_point();
      case 2:
        return cross();
      case 3:
        return pole();
      case 4:
        return uncertain();
      case 5:
        return uncertain_product();
      case 6:
        return threshold();
      case 7:
        return scaled();
      case 8:
        return disconnected();
      case 9:
        return trajectory();
      case 10:
        return ball();
      case 11:
        return root();
      case 12:
        return error();
      default:
        return tall();
    }
  }

  void touch() {
    text_.kind = "touch";
    const std::size_t margin = random_.below(2);
    factor_ = margin == 0 ? "(x - 1/3)^2" : "(x - 1/3)^2 + 1e-12";
    singular(x_.holds_third && margin == 0);
  }

  void touch_in_a_point() {
    text_.kind = "point";
    const std::size_t margin = random_.below(2);
    factor_ = std::string("(x - 1/3)^2 + (y - 1/3)^2") + (margin == 0 ? "" : " + 1e-12");
    singular(x_.holds_third && y_.holds_third && margin == 0);
  }

  void cross() {
    text_.kind = "cross";
    factor_ = pick({"x - 1/3", "1/3 - x", "(x - 1/3)^3", "(x - 1/3)*(2 + y)"});
    singular(x_.holds_third);
  }

  void pole() {
    text_.kind = "pole";
    factor_ = pick({"1/(x - 1/3)", "1/(x - 1/3)^2", "(x - 1/3)/(x - 1/3)"});
    x_.holds_third ? neither() : safe();
  }

  void uncertain() {
    text_.kind = "uncertain";
    const std::size_t which = random_.below(4);  // a ∈ [1/3, 1/3 + 2/10]
    constexpr const char* kFactors[] = {"a - 1/3", "a - 1/3 + 1e-12", "a - 1/3 - 1e-12",
                                        "(a - 1/3)^2 + (x - 1/3)^2"};
    factor_ = kFactors[which];
    singular(which == 0 || which == 2 || (which == 3 && x_.holds_third));
  }

  void uncertain_product() {
    text_.kind = "product";
    const std::size_t which = random_.below(3);  // ab ∈ [1/6, 4/5]
    constexpr const char* kFactors[] = {"a*b - 1/6", "a*b - 1/6 + 1e-12", "4/5 - 1e-12 - a*b"};
    factor_ = kFactors[which];
    singular(which != 1);
  }

  void threshold() {
    text_.kind = "threshold";
    const std::size_t which = random_.below(3);
    factor_ = "2 + (x - 1/3)^2";
    constexpr const char* kAlphas[] = {"2", "2 - 1e-12", "2 + 1e-12"};
    alpha_ = kAlphas[which];
    // 2 + (x − 1/3)² reaches 2 + 1e-12 within 1e-6 of 1/3.
    const bool near =
        x_.holds_third || std::string_view(x_.text).find("1e-") != std::string_view::npos;
    singular(which == 0 ? x_.holds_third : which == 2 && (near || is_just_below()));
    plain_ = true;
  }

  [[nodiscard]] bool is_just_below() const {
    return std::string_view(x_.text).find("333333333") != std::string_view::npos;
  }

  void scaled() {
    text_.kind = "scaled";
    factor_ = pick(
        {"1e-150*(x - 1/3)", "1e150*(x - 1/3)", "1e-80*(x - 1/3)^2", "1e150*(x - 1/3)*(x - 1/3)"});
    singular(x_.holds_third);
  }

  void disconnected() {
    text_.kind = "disconnected";
    x_ = y_ = kRanges[0];
    factor_ = "x";
    const std::size_t which = random_.below(6);
    constexpr const char* kConstraints[] = {"1/4 - x^2",         "1e-9 - x^2", "x^2 + 1",
                                            "1/100 - x^2 - y^2", "x^2 - 1/4",  "x^2"};
    constraint_ = kConstraints[which];
    singular(which >= 3);
  }

  void trajectory() {
    text_.kind = "trajectory";
    const std::size_t which = random_.below(3);
    constexpr const char* kFactors[] = {"1 - x", "1 - x + 1e-12", "x"};
    factor_ = kFactors[which];
    moves_ = true;
    singular(which != 1);
  }

  void ball() {
    text_.kind = "ball";
    const std::size_t which = random_.below(3);
    // The ball of radius 1/10 contains (0.06, 0.08) with p1 + 2p2 = 0.22, but no p1 + p2 = 0.15.
    constexpr const char* kFactors[] = {"0.22 - p_1 - 2*p_2", "0.15 - p_1 - p_2",
                                        "p_1^2 + p_2^2 - 0.01 - 1e-9"};
    factor_ = kFactors[which];
    singular(which == 0);
  }

  void root() {
    text_.kind = "root";
    factor_ = pick({"1 + sqrt(x - 1/3)", "2 + asin(x + 2/3)", "1 + log(x - 1/3 + 1)"});
    if (factor_[4] == 's' && factor_[5] == 'q') {
      // The expression is defined for x ≥ 1/3 only.
      const std::string_view range(x_.text);
      const bool above = range.starts_with("[\"1/3\"") || range.starts_with("\"1/3") ||
                         range.starts_with("[\"1/3 +") || range.starts_with("[\"pi");
      above ? safe() : neither();
    } else if (factor_[0] == '2') {
      // The expression is defined for −5/3 ≤ x ≤ 1/3; 2 + asin ≥ 2 − π/2.
      const bool below =
          x_.is_third || std::string_view(x_.text).ends_with("\"1/3\"]") || is_just_below();
      below ? safe() : neither();
    } else {
      // log(2/3 + x): 0 at 1/3; −1 at 1/e − 2/3 ≈ −0.299; undefined at −2/3.
      const std::string_view range(x_.text);
      if (range.starts_with("[-")) text_.never_safe = true;
      if (!range.starts_with("[-")) safe();
    }
  }

  void error() {
    text_.kind = "error";
    const std::size_t which = random_.below(3);
    x_ = kRanges[3];
    constexpr const char* kFactors[] = {"x - 1/3 - 1/30", "x - 1/3 - 1/30 - 1e-12",
                                        "x - 1/3 + 1/31"};
    factor_ = kFactors[which];
    error_ = "1/30";
    singular(which != 1);
  }

  /// Makes a model whose rank drops only at x = y = 1/3.
  void tall() {
    text_.kind = "tall";
    factor_ = "x - 1/3";
    extra_ = "y - 1/3";
    text_.never_safe = x_.holds_third && y_.holds_third;
    text_.never_singular = true;
  }

  void write_matrix() {
    auto& rows = text_.matrix;
    for (std::size_t i = 0; i < order_; ++i) {
      rows.emplace_back(order_, "0");
      for (std::size_t j = 0; j < i; ++j)
        rows[i][j] = pick({"0", "1", "x", "y", "sin(phi)", "x*y", "a", "1/7"});
      rows[i][i] = plain_ ? "1" : pick({"1", "2 + sin(y)", "1 + x^2", "3", "1 + a", "b"});
    }
    const std::size_t at = random_.below(order_);
    rows[at][at] = factor_;
    if (!extra_.empty()) {
      // The row of the factor and the extra row differ only in their last entries.
      rows[at].assign(order_, "0");
      rows[at][at] = factor_;
      for (std::size_t i = at + 1; i < order_; ++i) rows[i][at] = "0";
      rows.push_back(std::vector<std::string>(order_, "0"));
      rows.back()[at] = extra_;
    }
    for (std::size_t mix = random_.below(4); mix > 0; --mix) mix_rows();
    if (random_.one_in(2)) mix_columns();
    if (random_.one_in(3) && !plain_)
      for (std::size_t i = 0; i < rows.size(); ++i)
        text_.row_scale.push_back(pick({"1/sqrt(x^2 + 1)", "2", "1/3"}));
  }

  static std::string sum_of(const std::string& a, const std::string& times, const std::string& b) {
    if (b == "0") return a;
    if (a == "0") return times + "*(" + b + ")";
    return "(" + a + ") + " + times + "*(" + b + ")";
  }

  void mix_rows() {
    auto& rows = text_.matrix;
    const std::size_t to = random_.below(rows.size());
    const std::size_t from = (to + 1 + random_.below(rows.size() - 1)) % rows.size();
    const std::string times = pick({"2", "(-1)", "1", "(1/3)"});
    for (std::size_t j = 0; j < rows[to].size(); ++j)
      rows[to][j] = sum_of(rows[to][j], times, rows[from][j]);
  }

  void mix_columns() {
    const std::size_t to = random_.below(order_);
    const std::size_t from = (to + 1 + random_.below(order_ - 1)) % order_;
    for (auto& row : text_.matrix) row[to] = sum_of(row[to], "3", row[from]);
  }

  void write_motion() {
    if (moves_)
      text_.motion = "parameters = { T = [0, 1] }\nx = \"cos(2*pi*T)\"\ny = \"T\"\nphi = 0\n";
    else
      text_.motion =
          std::string("x = ") + x_.text + "\ny = " + y_.text + "\nphi = [\"-pi/7\", \"pi/7\"]\n";
    if (!error_.empty()) text_.motion += "error = { x = \"" + error_ + "\" }\n";
    if (!constraint_.empty()) text_.motion += "constraints = [\"" + constraint_ + "\"]\n";
    if (!alpha_.empty()) text_.motion += "alpha = \"" + alpha_ + "\"\n";
  }

  RandomSource& random_;
  ModelText text_;
  KnownRange x_{}, y_{};
  std::size_t order_ = 2;
  std::string factor_, extra_, constraint_, alpha_, error_;
  bool moves_ = false;
  bool plain_ = false;  ///< the determinant is the factor itself
};

}  // namespace regulus::detail::test
