// SPDX-License-Identifier: GPL-3.0-or-later
// Makes certificates about closures: tubes by Newton's method and bisection.
#pragma once

#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/existence/branch_tube.hpp"
#include "tests/support/certificate_texts.hpp"

namespace regulus::detail::test {

/// Φ and its derivatives over a box, row by row.
struct ClosureValues {
  std::vector<Interval> value, by_unknown, by_variable;
};

/// A mechanism with its question, in numbers and in words.
struct ClosureCase {
  std::size_t n = 0;             ///< unknowns
  std::vector<Interval> ranges;  ///< of all variables
  std::vector<bool> is_split;    ///< by variable
  std::vector<double> start,
      start_unknowns;  ///< where the branch starts, and what is near it there
  std::function<ClosureValues(const std::vector<Interval>& x, const std::vector<Interval>& p)> over;
  /// True if the box is outside the constraints.
  std::function<bool(const std::vector<Interval>& x)> is_outside = [](const auto&) {
    return false;
  };
  std::string set, unknowns, equations, motion;  ///< lines
  std::size_t uncertain = 0;
};

/// A leaf, or a split.
struct ClosureNode {
  std::size_t variable = 0;
  double at = 0;
  int lower = -1, upper = -1;  ///< -1: a leaf
  std::vector<Interval> box;
  std::optional<BranchTube> tube;  ///< of a leaf; none: it is outside
};

inline std::vector<Interval> points(const std::vector<double>& x) { return {x.begin(), x.end()}; }

/// Returns the solution at x that continues the one at `from`.
inline std::vector<double> continued(const ClosureCase& c, const std::vector<double>& from,
                                     std::vector<double> p, const std::vector<double>& x) {
  constexpr int kSteps = 64;
  for (int step = 1; step <= kSteps; ++step) {
    std::vector<double> at;
    for (std::size_t k = 0; k < x.size(); ++k)
      at.push_back(from[k] + (x[k] - from[k]) * step / kSteps);
    for (int iteration = 0; iteration < (step == kSteps ? 12 : 4); ++iteration) {
      const ClosureValues v = c.over(points(at), points(p));
      std::vector<double> J;
      for (const Interval entry : v.by_unknown) J.push_back(mid(entry));
      const auto inverse = approx_inverse_of(J, c.n);
      if (!inverse) break;
      for (std::size_t i = 0; i < c.n; ++i)
        for (std::size_t j = 0; j < c.n; ++j) p[i] -= (*inverse)[i * c.n + j] * mid(v.value[j]);
    }
  }
  return p;
}

/// Returns a tube about the solution `p` at x₀ that passes the test over the box, if one is found.
inline std::optional<BranchTube> tube_about(const ClosureCase& c, const std::vector<double>& x0,
                                            const std::vector<double>& p,
                                            const std::vector<Interval>& box) {
  const std::size_t n = c.n, m = x0.size();
  BranchTube tube{x0, p, std::vector<double>(n * m), std::vector<double>(n, 1e-9)};
  const ClosureValues here = c.over(points(x0), points(p));
  std::vector<double> J;
  for (const Interval entry : here.by_unknown) J.push_back(mid(entry));
  const auto inverse = approx_inverse_of(J, n);
  if (!inverse) return std::nullopt;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < m; ++k)
      for (std::size_t j = 0; j < n; ++j)
        tube.slopes[i * m + k] -= (*inverse)[i * n + j] * mid(here.by_variable[j * m + k]);
  for (int attempt = 0; attempt < 8; ++attempt) {
    const ClosureValues there = c.over(box, enclose(tube, box));
    const TubeImage image =
        image_of(tube, box, *inverse, {here.value, there.by_unknown, there.by_variable});
    if (attempt > 0 && has_one_solution(tube, image)) return tube;
    for (std::size_t i = 0; i < n; ++i) {
      tube.radius[i] = 1.5 * image.radius[i] + 1e-9;
      if (!(tube.radius[i] < 1)) return std::nullopt;
    }
  }
  return std::nullopt;
}

/// A tree of tubes about the branch through `p` at the start; empty if it is not found.
class ClosureTree {
 public:
  explicit ClosureTree(const ClosureCase& c) : c_(c), start_(c.start_unknowns) {
    is_made_ = add(c.ranges, 0) >= 0;
  }

  [[nodiscard]] bool is_made() const { return is_made_; }
  std::vector<ClosureNode>& nodes() { return nodes_; }
  [[nodiscard]] std::size_t leaves() const {
    std::size_t count = 0;
    for (const ClosureNode& node : nodes_) count += node.lower < 0;
    return count;
  }

  [[nodiscard]] std::string text() const {
    std::string lines;
    std::size_t leaves = 0, next = 1;
    write(0, 0, next, leaves, lines);
    return lines + "end " + std::to_string(leaves) + '\n';
  }

 private:
  static constexpr int kDeepest = 24;

  int add(const std::vector<Interval>& box, int depth) {
    const int number = static_cast<int>(nodes_.size());
    nodes_.push_back({});
    nodes_.back().box = box;
    if (c_.is_outside(box)) return number;
    std::vector<double> middle;
    for (const Interval x : box) middle.push_back(mid(x));
    auto tube = tube_about(c_, middle, continued(c_, c_.start, start_, middle), box);
    if (tube) {
      nodes_[static_cast<std::size_t>(number)].tube = std::move(tube);
      return number;
    }
    std::size_t k = 0;
    double most = 0;
    for (std::size_t v = 0; v < box.size(); ++v)
      if (const double part = width_ru(box[v]) / width_ru(c_.ranges[v]);
          c_.is_split[v] && part > most)
        k = v, most = part;
    if (depth == kDeepest || most == 0) return -1;
    std::vector<Interval> lower = box, upper = box;
    const double at = mid(box[k]);
    lower[k] = {box[k].lo, at}, upper[k] = {at, box[k].hi};
    const int below = add(lower, depth + 1), above = below < 0 ? -1 : add(upper, depth + 1);
    if (above < 0) return -1;
    ClosureNode& node = nodes_[static_cast<std::size_t>(number)];
    node.variable = k, node.at = at, node.lower = below, node.upper = above;
    return number;
  }

  void write(int at, std::size_t box, std::size_t& next, std::size_t& leaves,
             std::string& lines) const {
    const ClosureNode& node = nodes_[static_cast<std::size_t>(at)];
    char number[64];
    if (node.lower >= 0) {
      std::snprintf(number, sizeof number, " %zu %a\n", node.variable, node.at);
      lines += "s " + std::to_string(box) + number;
      const std::size_t first = next;
      next += 2;
      write(node.lower, first, next, leaves, lines);
      write(node.upper, first + 1, next, leaves, lines);
      return;
    }
    ++leaves;
    lines += "l " + std::to_string(box) + (node.tube ? " tube" : " outside");
    if (node.tube)
      for (const auto* part :
           {&node.tube->at, &node.tube->center, &node.tube->slopes, &node.tube->radius})
        for (const double x : *part) {
          std::snprintf(number, sizeof number, " %a", x);
          lines += number;
        }
    lines += '\n';
  }

  const ClosureCase& c_;
  std::vector<double> start_;
  std::vector<ClosureNode> nodes_;
  bool is_made_ = false;
};

inline std::string closure_question(const ClosureCase& c) {
  format::ClaimedSet set{c.n, c.n, c.uncertain};
  return std::string("regulus-certificate 1\nverdict NO SINGULARITY\nclaim ") +
         format::describe_closure_claim(set, false) +
         "\nmodel by hand\nsha256 -\nmotion turn\nalpha 0\n" + c.set + c.unknowns + c.equations +
         c.motion + "proof\n";
}

/// A four-bar linkage: crank 0.2 at angle θ, coupler 0.35, rocker 0.25, distance of the joints 0.45.
/// θ turns between ±`degrees`, for the branch of the sign `side`; the crank is uncertain by `spread`.
/// Its configurations meet where the coupler and the rocker are in line, at θ ≈ ±131°.
inline ClosureCase four_bar(int degrees, int side = 1, double spread = 0) {
  constexpr double kDegree = 0x1.1df46a2529d39p-6;
  ClosureCase c;
  c.n = 2;
  const double end = degrees * kDegree * (1 + 0x1p-50);
  c.ranges = {{-end, end}, {0.2 - spread - 1e-15, 0.2 + spread + 1e-15}};
  c.is_split = {true, false};
  c.start = {60 * kDegree, 0.2};
  c.uncertain = 1;
  c.over = [](const std::vector<Interval>& x, const std::vector<Interval>& p) {
    const Interval b = Interval(35.0) / Interval(100.0), d = Interval(45.0) / Interval(100.0);
    const auto [st, ct] = sincos(x[0]);
    const auto [sf, cf] = sincos(p[0]);
    const auto [ss, cs] = sincos(p[1]);
    return ClosureValues{
        {x[1] * ct + b * cf - d - Interval(0.25) * cs, x[1] * st + b * sf - Interval(0.25) * ss},
        {-b * sf, Interval(0.25) * ss, b * cf, -Interval(0.25) * cs},
        {-x[1] * st, ct, x[1] * ct, st}};
  };
  const std::string angle = std::to_string(degrees) + "*pi/180";
  char number[64];
  std::snprintf(number, sizeof number, "%.17g", spread);
  c.set = "parameter theta in -" + angle + " : " + angle + "\nuncertain crank = 0.2 +- " + number +
          "\npose theta = theta\n";
  c.start_unknowns = side > 0 ? std::vector<double>{0.22, 1.6} : std::vector<double>{-1.14, -2.52};
  c.start_unknowns = continued(c, c.start, c.start_unknowns, c.start);
  std::snprintf(number, sizeof number, "%.6f", c.start_unknowns[0]);
  c.unknowns = std::string("unknown phi = ") + number + " +- 0.01\n";
  std::snprintf(number, sizeof number, "%.6f", c.start_unknowns[1]);
  c.unknowns += std::string("unknown psi = ") + number + " +- 0.01\nstart 60*pi/180\n";
  c.equations =
      "let x = crank*cos(theta) + 0.35*cos(phi)\nequation x - 0.45 - 0.25*cos(psi)\n"
      "equation crank*sin(theta) + 0.35*sin(phi) - 0.25*sin(psi)\n";
  return c;
}

/// p² = x² + y² + gap and q·(1 + x/4) = p for x and y in [−1, 1]: the two branches of p are nearest at
/// x = y = 0, where they are 2√gap apart.
inline ClosureCase two_sheets(double gap, int side = 1, double start_x = 0.5) {
  ClosureCase c;
  c.n = 2;
  c.ranges = {{-1, 1}, {-1, 1}};
  c.is_split = {true, true};
  c.start = {start_x, 0.25};
  c.over = [gap](const std::vector<Interval>& x, const std::vector<Interval>& p) {
    const Interval quarter(0.25), factor = Interval(1.0) + quarter * x[0];
    return ClosureValues{{sqr(p[0]) - sqr(x[0]) - sqr(x[1]) - Interval(gap), p[1] * factor - p[0]},
                         {2.0 * p[0], 0.0, -1.0, factor},
                         {-2.0 * x[0], -2.0 * x[1], quarter * p[1], 0.0}};
  };
  c.start_unknowns = continued(c, c.start, {(0.1 + start_x) * side, start_x * side}, c.start);
  char number[64];
  c.set = "parameter x in -1 : 1\nparameter y in -1 : 1\npose x = x\npose y = y\n";
  for (std::size_t i = 0; i < 2; ++i) {
    std::snprintf(number, sizeof number, "%.9f", c.start_unknowns[i]);
    c.unknowns += std::string("unknown ") + (i == 0 ? "p = " : "q = ") + number + " +- 1/100\n";
  }
  std::snprintf(number, sizeof number, "start %g\nstart 0.25\n", start_x);
  c.unknowns += number;
  std::snprintf(number, sizeof number, "%.17g", gap);
  c.equations =
      std::string("equation p^2 - x^2 - y^2 - ") + number + "\nequation q*(1 + x/4) - p\n";
  return c;
}

}  // namespace regulus::detail::test
