// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/loop_closing.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

constexpr double kStep = 1e-6;        ///< of central differences
constexpr double kLeastPivot = 1e-7;  ///< of independent derivatives, of those of size 1
constexpr int kMostSteps = 400;

double square(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return sum;
}

/// Solves (JᵀJ + d·I)s = −Jᵀg by elimination; a positive d makes the matrix regular.
std::vector<double> damped_step(const std::vector<double>& slopes, const std::vector<double>& gap,
                                std::size_t n, double damping) {
  std::vector<double> a(n * n, 0.0), b(n, 0.0);
  for (std::size_t r = 0; r < gap.size(); ++r)
    for (std::size_t i = 0; i < n; ++i) {
      const double left = slopes[r * n + i];
      if (left == 0) continue;
      b[i] -= left * gap[r];
      for (std::size_t j = 0; j < n; ++j) a[i * n + j] += left * slopes[r * n + j];
    }
  for (std::size_t i = 0; i < n; ++i) a[i * n + i] += damping;
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t i = c + 1; i < n; ++i) {
      const double factor = a[i * n + c] / a[c * n + c];
      if (factor == 0) continue;
      for (std::size_t j = c; j < n; ++j) a[i * n + j] -= factor * a[c * n + j];
      b[i] -= factor * b[c];
    }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) b[i] -= a[i * n + j] * b[j];
    b[i] /= a[i * n + i];
  }
  return b;
}

/// Elimination with complete pivoting, where a loop may give so many rows.
class Elimination {
 public:
  Elimination(std::vector<double> slopes, std::vector<std::size_t> loop_of_row,
              std::vector<std::size_t> left, std::size_t columns)
      : a_(std::move(slopes)),
        loop_of_row_(std::move(loop_of_row)),
        left_(std::move(left)),
        m_(columns),
        is_chosen_(loop_of_row_.size(), 0),
        is_column_chosen_(columns, 0) {
    result_.by_loop.assign(left_.size(), 0);
  }

  void exclude(std::size_t row) { is_chosen_[row] = 1; }

  IndependentRows run() {
    while (const auto pivot = largest()) eliminate(pivot->first, pivot->second);
    return std::move(result_);
  }

 private:
  std::optional<std::pair<std::size_t, std::size_t>> largest() const {
    double size = kLeastPivot;
    std::optional<std::pair<std::size_t, std::size_t>> found;
    for (std::size_t r = 0; r < loop_of_row_.size(); ++r) {
      if (is_chosen_[r] != 0 || left_[loop_of_row_[r]] == 0) continue;
      for (std::size_t c = 0; c < m_; ++c)
        if (is_column_chosen_[c] == 0 && std::fabs(a_[r * m_ + c]) > size)
          size = std::fabs(a_[r * m_ + c]), found = {r, c};
    }
    return found;
  }

  void eliminate(std::size_t row, std::size_t column) {
    is_chosen_[row] = is_column_chosen_[column] = 1;
    --left_[loop_of_row_[row]];
    ++result_.by_loop[loop_of_row_[row]];
    result_.rows.push_back(row);
    result_.columns.push_back(column);
    for (std::size_t r = 0; r < loop_of_row_.size(); ++r) {
      const double factor = a_[r * m_ + column] / a_[row * m_ + column];
      if (is_chosen_[r] != 0 || factor == 0) continue;
      for (std::size_t c = 0; c < m_; ++c) a_[r * m_ + c] -= factor * a_[row * m_ + c];
    }
  }

  std::vector<double> a_;
  const std::vector<std::size_t> loop_of_row_;
  std::vector<std::size_t> left_;
  const std::size_t m_;
  std::vector<char> is_chosen_, is_column_chosen_;
  IndependentRows result_;
};

}  // namespace

std::vector<double> LoopPose::gap() const {
  std::vector<double> all;
  for (const CutLoop& loop : loops) {
    const std::vector<double> parts = detail::gap_of(loop, joints, values);
    all.insert(all.end(), parts.begin(), parts.end());
  }
  return all;
}

double LoopPose::gap_of_loop(std::size_t loop) const {
  return opening_of(loops[loop], joints, values);
}

double LoopPose::largest_gap() const {
  double largest = 0;
  for (std::size_t i = 0; i < loops.size(); ++i) largest = std::fmax(largest, gap_of_loop(i));
  return largest;
}

std::vector<double> LoopPose::slopes(const std::vector<std::size_t>& by) const {
  LoopPose moved = *this;
  std::vector<double> slopes;
  for (std::size_t c = 0; c < by.size(); ++c) {
    moved.values[by[c]] = values[by[c]] + kStep;
    const std::vector<double> above = moved.gap();
    moved.values[by[c]] = values[by[c]] - kStep;
    const std::vector<double> below = moved.gap();
    moved.values[by[c]] = values[by[c]];
    slopes.resize(above.size() * by.size());
    for (std::size_t r = 0; r < above.size(); ++r)
      slopes[r * by.size() + c] = (above[r] - below[r]) / (2 * kStep);
  }
  return slopes;
}

/// Levenberg and Marquardt: the damping grows where a step fails, and vanishes near a solution.
void close_loops(LoopPose& pose, const std::vector<std::size_t>& moving) {
  double damping = 1e-3;
  std::vector<double> gap = pose.gap();
  for (int step = 0; step < kMostSteps && !moving.empty(); ++step) {
    const double before = square(gap);
    if (!(before > 1e-30) || damping > 1e12) return;
    const std::vector<double> change = damped_step(pose.slopes(moving), gap, moving.size(),
                                                   damping * std::fmin(1, before) + 1e-14);
    LoopPose next = pose;
    for (std::size_t i = 0; i < moving.size(); ++i) next.values[moving[i]] += change[i];
    std::vector<double> after = next.gap();
    if (square(after) < before) {
      pose.values = std::move(next.values);
      gap = std::move(after);
      damping = std::fmax(damping / 5, 1e-12);
    } else {
      damping *= 4;
    }
  }
}

IndependentRows independent_rows(const LoopPose& pose, const std::vector<std::size_t>& by,
                                 const std::vector<std::size_t>& most,
                                 const std::vector<char>& idle) {
  std::vector<std::size_t> loop_of_row;
  for (std::size_t i = 0; i < pose.loops.size(); ++i)
    loop_of_row.resize(
        loop_of_row.size() + detail::gap_of(pose.loops[i], pose.joints, pose.values).size(), i);
  Elimination elimination(pose.slopes(by), loop_of_row, most, by.size());
  for (std::size_t row = 0; row < idle.size(); ++row)
    if (idle[row] != 0) elimination.exclude(row);
  return elimination.run();
}

}  // namespace regulus::detail
