// SPDX-License-Identifier: GPL-3.0-or-later
// Models whose condition number in the 2-norm is known or computed by a library of its own.
#pragma once

#include <fmt/format.h>

#include <Eigen/Dense>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "codegen/question/bound/bound_run.hpp"
#include "codegen/support/decomposition.hpp"

namespace regulus::detail::test {

/// The text of a model with a motion in x and y, perhaps with more lines in front of its matrix.
inline std::string model_with(const std::string& rows, const std::string& motion,
                              const std::string& more = "") {
  return fmt::format(
      "regulus = 1\nname = \"test\"\n{}\n[pose]\nx = \"1\"\ny = \"1\"\n[geometry]\na = {{ value = "
      "2, "
      "tolerance = 0.5 }}\n[matrix]\nrows = {}\n[motion.m]\n{}\n",
      more, rows, motion);
}

inline BoundSettings settings_with(double gap) {
  BoundSettings settings;
  settings.gap = gap;
  settings.search.engine = Engine::kInterpreted;
  settings.search.threads = 1;
  settings.search.time_limit = 60;
  settings.output.quiet = true;
  return settings;
}

inline double condition(const Eigen::MatrixXd& A) {
  const Eigen::VectorXd values = singular_values(A);
  return values[0] / values[values.size() - 1];
}

/// A random matrix of sines, squares and an uncertain a; the same as text and as numbers.
struct RandomModel {
  std::mt19937 random;
  std::size_t columns, rows;
  std::vector<std::array<int, 5>> coefficients;

  explicit RandomModel(unsigned seed) : random(seed) {
    columns = 2 + random() % 2;
    rows = columns + random() % 2;
    for (std::size_t e = 0; e < rows * columns; ++e) {
      const auto pick = [&] { return int(random() % 5) - 2; };
      coefficients.push_back(
          {pick() + (e / columns == e % columns ? 9 : 0), pick(), pick(), pick(), pick()});
    }
  }
  [[nodiscard]] std::string text() const {
    std::string matrix = "[";
    for (std::size_t e = 0; e < coefficients.size(); ++e) {
      const auto& c = coefficients[e];
      matrix += fmt::format("{}\"{} + ({})*x + ({})*sin(y) + ({})*x*y + ({})*a*x\"{}",
                            e % columns == 0 ? "[" : ", ", c[0], c[1], c[2], c[3], c[4],
                            e % columns == columns - 1 ? "], " : "");
    }
    return model_with(matrix + "]", "x = [0, 1]\ny = [-1, 1]");
  }
  [[nodiscard]] Eigen::MatrixXd at(double x, double y, double a) const {
    Eigen::MatrixXd A(rows, columns);
    for (std::size_t e = 0; e < coefficients.size(); ++e) {
      const auto& c = coefficients[e];
      A(Eigen::Index(e / columns), Eigen::Index(e % columns)) =
          c[0] + c[1] * x + c[2] * std::sin(y) + c[3] * x * y + c[4] * a * x;
    }
    return A;
  }
};

/// Returns a certificate with another number, in its line and in its words.
inline std::string with_number(std::string text, double value) {
  const std::size_t at = text.find("\nbound ") + 7;
  const std::string old = text.substr(at, text.find('\n', at) - at);
  for (std::size_t place = 0; (place = text.find(' ' + old, place)) != std::string::npos;)
    text.replace(place + 1, old.size(), fmt::format("{:.12f}", value));
  return text;
}

}  // namespace regulus::detail::test
