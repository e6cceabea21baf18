// SPDX-License-Identifier: GPL-3.0-or-later
// The tubes of a list with tolerances, and Newton's method in doubles, which finds where a solution is.
#pragma once

#include <cmath>

#include "tests/property/solve/certified_lists.hpp"

namespace regulus::detail::test {

using Numbers = std::vector<double>;

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// Solves n equations in n unknowns; empty: it does not converge.
template <class Equations>
Numbers newton(const Equations& equations, Numbers x) {
  const std::size_t n = x.size();
  for (int step = 0; step < 40; ++step) {
    const Numbers value = equations(x);
    std::vector<Numbers> rows(n);
    for (std::size_t i = 0; i < n; ++i) rows[i].push_back(-value[i]);
    for (std::size_t k = 0; k < n; ++k) {
      Numbers up = x, down = x;
      up[k] += 1e-6, down[k] -= 1e-6;
      const Numbers a = equations(up), b = equations(down);
      for (std::size_t i = 0; i < n; ++i) rows[i].insert(rows[i].end() - 1, (a[i] - b[i]) / 2e-6);
    }
    double size = 0;
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k; i < n; ++i)
        if (std::fabs(rows[i][k]) > std::fabs(rows[pivot][k])) pivot = i;
      std::swap(rows[k], rows[pivot]);
      if (!(std::fabs(rows[k][k]) > 1e-14)) return {};
      for (std::size_t i = 0; i < n; ++i) {
        const double factor = i == k ? 0 : rows[i][k] / rows[k][k];
        for (std::size_t j = k; j <= n; ++j) rows[i][j] -= factor * rows[k][j];
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      const double change = rows[k][n] / rows[k][k];
      x[k] += change;
      size = std::max(size, std::fabs(change));
    }
    if (!(size < 1e3)) return {};
    if (size < 1e-12) return x;
  }
  return {};
}

/// The intervals of each line `solution`.
inline std::vector<std::vector<Interval>> tubes_of(const std::string& certificate) {
  std::vector<std::vector<Interval>> tubes;
  for (const std::string& line : lines_of(certificate)) {
    if (!line.starts_with("solution ")) continue;
    std::istringstream words(line.substr(9));
    tubes.emplace_back();
    for (std::string word; words >> word;)
      tubes.back().emplace_back(std::stod(word), std::stod(word.substr(word.find(':') + 1)));
  }
  return tubes;
}

inline bool is_within(const Numbers& x, const std::vector<Interval>& tube) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!(tube[i].lo <= x[i] && x[i] <= tube[i].hi)) return false;
  return true;
}

inline Numbers middle_of(const std::vector<Interval>& tube) {
  Numbers x;
  for (const Interval& part : tube) x.push_back(mid(part));
  return x;
}

/// Anchors of the library's 3-RPR, moved, and its lengths.
struct PlanarRobot {
  std::array<std::array<double, 2>, 3> a{{{0, 0}, {15.91, 0}, {0, 10}}},
      b{{{0, 0}, {17.04, 0}, {20.84 * std::cos(0.8826031098), 20.84 * std::sin(0.8826031098)}}};
  std::array<double, 3> length{14.98, 15.38, 12};

  Numbers operator()(const Numbers& x) const {
    Numbers value;
    const double c = std::cos(x[2]), s = std::sin(x[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      const double u = x[0] + c * b[i][0] - s * b[i][1] - a[i][0],
                   v = x[1] + s * b[i][0] + c * b[i][1] - a[i][1];
      value.push_back(u * u + v * v - length[i] * length[i]);
    }
    return value;
  }
};

/// A platform on six legs, in doubles.
struct SpatialRobot {
  using Points = std::array<std::array<double, 3>, 6>;
  Points a, b;
  std::array<double, 6> length;

  /// x, y, z and a quaternion of length 1.
  Numbers operator()(const Numbers& x) const {
    const double w = x[3], p = x[4], q = x[5], r = x[6];
    const double R[3][3] = {{1 - 2 * (q * q + r * r), 2 * (p * q - w * r), 2 * (p * r + w * q)},
                            {2 * (p * q + w * r), 1 - 2 * (p * p + r * r), 2 * (q * r - w * p)},
                            {2 * (p * r - w * q), 2 * (q * r + w * p), 1 - 2 * (p * p + q * q)}};
    Numbers value;
    for (std::size_t i = 0; i < 6; ++i) {
      double square = -length[i] * length[i];
      for (std::size_t k = 0; k < 3; ++k) {
        double part = x[k] - a[i][k];
        for (std::size_t j = 0; j < 3; ++j) part += R[k][j] * b[i][j];
        square += part * part;
      }
      value.push_back(square);
    }
    value.push_back(w * w + p * p + q * q + r * r - 1);
    return value;
  }
};

}  // namespace regulus::detail::test
