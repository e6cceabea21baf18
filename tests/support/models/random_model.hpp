// SPDX-License-Identifier: GPL-3.0-or-later
// Small ordinary models: entries around a diagonal, shared let expressions, tolerances of every
// shape, constraints, trajectories and thresholds.
#pragma once

#include <string>

#include "tests/support/models/model_text.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

class RandomModel {
 public:
  explicit RandomModel(RandomSource& random) : random_(random) {
    text_.kind = "random";
    columns_ = random.one_in(8) ? 5 + random.below(2) : 2 + random.below(3);
    rows_ = columns_ + (random.one_in(8) ? 1 : 0);
    write_geometry();
    write_let();
    for (std::size_t i = 0; i < rows_; ++i) write_row(i);
    if (random.one_in(3)) write_row_scale();
    write_motion();
  }

  [[nodiscard]] const ModelText& text() const { return text_; }

 private:
  std::string pick(const std::vector<std::string>& from) {
    return from[random_.below(from.size())];
  }

  std::string number() { return pick({"2", "3", "1/3", "0.1", "-1", "-1/7", "0.5", "1.25"}); }
  std::string tolerance() { return pick({"0", "0.001", "0.01", "1/30", "0.1", "0.3"}); }

  void write_geometry() {
    text_.geometry = "a = { value = \"" + number() + "\", tolerance = \"" + tolerance() +
                     "\" }\nb = { value = \"" + number() + "\", tolerance = \"" + tolerance() +
                     "\" }\nc = 3\n" + "p = { value = [1, \"1/3\"], " +
                     (random_.one_in(2) ? "radius" : "tolerance") + " = \"" + tolerance() +
                     "\" }\nq = { value = [\"-1/2\", 2, 0.1], radius = \"" + tolerance() + "\" }\n";
  }

  void write_let() {
    text_.let = "s = \"sin(phi)\"\nd = \"x*cos(phi) - y*s\"\nr = \"sqrt((x - p_1)^2 + y^2 + 2)\"\n";
  }

  /// Returns a quantity that this row may use: some of the geometry is only in one row.
  std::string atom(std::size_t row) {
    if (random_.one_in(5) && row == own_row_a_) return "b";
    if (random_.one_in(4) && row == own_row_q_) return pick({"q_1", "q_2", "q_3"});
    if (random_.one_in(4)) return pick({"a", "p_1", "p_2"});
    return pick({"x", "y", "phi", "x", "y", "s", "cos(phi)", "d", "r", "c", "cos(x + y)"});
  }

  std::string term(std::size_t row) {
    switch (random_.below(7)) {
      case 0:
        return atom(row) + "*" + atom(row);
      case 1:
        return atom(row) + "^2";
      case 2:
        return "sin(" + atom(row) + " + " + number() + ")";
      case 3:
        return "a*p_2*" + atom(row);
      case 4:
        return atom(row) + "/(" + pick({"2 + x", "3 + s", "r", "1 + y^2"}) + ")";
      default:
        return atom(row);
    }
  }

  std::string entry(std::size_t row, std::size_t column) {
    std::string e = "(" + number() + ")*" + term(row);
    if (random_.one_in(2)) e += " + " + term(row);
    if (random_.one_in(4)) e += " - " + term(row);
    if (row % columns_ == column) return strength_ + " + " + weight_ + "*(" + e + ")";
    if (random_.one_in(3)) return number();
    return weight_ + "*(" + e + ")";
  }

  void write_row(std::size_t i) {
    text_.matrix.emplace_back();
    for (std::size_t j = 0; j < columns_; ++j) text_.matrix.back().push_back(entry(i, j));
  }

  void write_row_scale() {
    for (std::size_t i = 0; i < rows_; ++i)
      text_.row_scale.push_back(pick({"1/r", "2", "1/3", "1/sqrt(d^2 + 1)", "exp(x)"}));
  }

  std::string box_range(const std::string& name) {
    return name + " = " +
           pick({"[-1, 1]", "[0, 0.5]", "[\"1/3\", \"2/3\"]", "[0.1, 0.3]", "[\"-pi/7\", \"pi/7\"]",
                 "[-0.01, 0.02]", "0.25", "\"1/3\"", "[\"sqrt(2)/3\", \"sqrt(3)/3\"]"}) +
           "\n";
  }

  void write_motion() {
    if (random_.one_in(4)) {
      text_.motion = "parameters = { T = [0, 1] }\nx = \"cos(2*pi*T)/2\"\ny = \"" +
                     pick({"sin(2*pi*T)/2", "T^2 - T", "1/3"}) +
                     "\"\nphi = " + pick({"0", "\"T/3\"", "\"10*deg\""}) + "\n";
    } else {
      text_.motion = box_range("x") + box_range("y") + box_range("phi");
    }
    if (random_.one_in(4))
      text_.motion += "error = { x = " + pick({"0.01", "\"1/30\""}) + ", phi = \"0.1*deg\" }\n";
    if (random_.one_in(3)) text_.motion += "constraints = [" + constraint() + "]\n";
    if (rows_ == columns_ && random_.one_in(3))
      text_.motion += "alpha = \"" + pick({"1/10", "0.01", "1", "3", "1e-9"}) + "\"\n";
  }

  std::string constraint() {
    return pick({"\"x^2 + y^2 - 1/4\"", "\"1/10 - x^2 - y^2\"", "\"1/9 - x^2\"", "\"x - y\"",
                 "\"a*x - 1/2\"", "\"x^2 - 1\", \"1/100 - y^2\"", "\"x\"", "\"x^2\""});
  }

  RandomSource& random_;
  ModelText text_;
  std::size_t rows_ = 0, columns_ = 0;
  const std::size_t own_row_a_ = random_.below(2), own_row_q_ = random_.below(2);
  const std::string strength_ = pick({"0", "0", "1", "2", "3"});
  const std::string weight_ = pick({"0.3", "0.3", "1"});
};

}  // namespace regulus::detail::test
