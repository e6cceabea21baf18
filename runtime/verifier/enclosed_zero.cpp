// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/enclosed_zero.hpp"

#include <algorithm>

#include "runtime/verifier/derivative.hpp"
#include "runtime/verifier/linear_algebra.hpp"
#include "runtime/verifier/rounding.hpp"
#include "runtime/verifier/slopes.hpp"

namespace regulus::verifier {
namespace {

/// The rows of A·v = 0 that are not 0 all over the box, in the chosen variables and the components of v
/// that are neither fixed to 1 nor 0.
class BorderedSystem {
 public:
  BorderedSystem(Question& q, const NullVector& claimed) : q_(q), chosen_(claimed.chosen) {
    const auto& v = claimed.components;
    unit_ = std::size_t(std::ranges::find_if(v, is_one) - v.begin());
    for (std::size_t j = 0; j < v.size(); ++j)
      if (!is_zero(v[j])) support_.push_back(j);
    for (const std::size_t k : chosen_) {
      Differentiator by(q.graph, k);
      for (const NodeId entry : q.matrix) slopes_.push_back(by.of(entry));
    }
    std::vector<NodeId> roots = q.matrix;
    roots.insert(roots.end(), slopes_.begin(), slopes_.end());
    evaluation_.emplace(q, roots);
  }

  /// Drops the rows that are 0; false if there are not as many equations as unknowns.
  [[nodiscard]] bool begin(const Box& box) {
    if (!evaluation_->run(box)) return false;
    rows_.clear();
    for (std::size_t i = 0; i < q_.rows; ++i)
      if (!std::ranges::all_of(support_, [&](std::size_t j) {
            return is_zero(evaluation_->value(q_.matrix[i * q_.columns + j]));
          }))
        rows_.push_back(i);
    return rows_.size() + 1 == chosen_.size() + support_.size();
  }
  [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }

  struct Values {
    std::vector<Interval> value, slopes;  ///< by row; a square matrix, row-major
  };

  /// Encloses the equations and their derivatives; false if one is not bounded.
  [[nodiscard]] bool run(const Box& box, const std::vector<Interval>& v, Values& into) {
    if (!evaluation_->run(box)) return false;
    into = {};
    for (const std::size_t i : rows_) {
      into.value.push_back(times(v, &q_.matrix[i * q_.columns]));
      for (std::size_t k = 0; k < chosen_.size(); ++k)
        into.slopes.push_back(times(v, &slopes_[(k * q_.rows + i) * q_.columns]));
      for (const std::size_t j : support_)
        if (j != unit_) into.slopes.push_back(evaluation_->value(q_.matrix[i * q_.columns + j]));
    }
    return is_moderate(into.value) && is_moderate(into.slopes);
  }

  /// The intervals of the unknowns, in the order of the derivatives.
  [[nodiscard]] std::vector<Interval> unknowns(const Box& box,
                                               const std::vector<Interval>& v) const {
    std::vector<Interval> result;
    for (const std::size_t k : chosen_) result.push_back(box[k]);
    for (const std::size_t j : support_)
      if (j != unit_) result.push_back(v[j]);
    return result;
  }

 private:
  [[nodiscard]] Interval times(const std::vector<Interval>& v, const NodeId* row) const {
    Interval sum;
    for (const std::size_t j : support_) sum = sum + evaluation_->value(row[j]) * v[j];
    return sum;
  }

  const Question& q_;
  const std::vector<std::size_t> chosen_;
  std::vector<std::size_t> support_, rows_;
  std::size_t unit_ = 0;
  std::vector<NodeId> slopes_;
  std::optional<Evaluation> evaluation_;
};

Interval times_row(const Matrix& K, std::size_t n, std::size_t i, const Interval* column,
                   std::size_t step) {
  Interval sum;
  for (std::size_t j = 0; j < n; ++j) sum = sum + K[j * n + i] * column[j * step];
  return sum;
}

/// |KF(c)| + |KF′ − I|r < r in every component.
bool maps_into_itself(const Matrix& K, const BorderedSystem::Values& center,
                      const BorderedSystem::Values& over, const std::vector<double>& r) {
  const std::size_t n = r.size();
  for (std::size_t i = 0; i < n; ++i) {
    Interval sum = point(mag(times_row(K, n, i, center.value.data(), 1)));
    for (std::size_t l = 0; l < n; ++l) {
      const Interval entry = times_row(K, n, i, over.slopes.data() + l, n);
      sum = sum + point(mag(i == l ? entry - point(1.0) : entry)) * point(r[l]);
    }
    if (!(sum.hi < r[i])) return false;
  }
  return true;
}

}  // namespace

bool has_null_vector(Question& q, const Box& box, const NullVector& claimed) {
  BorderedSystem system(q, claimed);
  Box middle = box;
  for (const std::size_t k : claimed.chosen) middle[k] = point(mid(box[k]));
  std::vector<Interval> v;
  for (const Interval x : claimed.components) v.push_back(point(mid(x)));
  BorderedSystem::Values center, over;
  if (!is_moderate(box) || !is_moderate(claimed.components) || !system.begin(box) ||
      !system.run(middle, v, center) || !system.run(box, claimed.components, over))
    return false;
  std::vector<double> slopes, r;
  for (const Interval x : center.slopes) slopes.push_back(mid(x));
  for (const Interval x : system.unknowns(box, claimed.components)) {
    const double c = mid(x);
    r.push_back(down(std::min(x.hi - c, c - x.lo)));
  }
  Matrix K;
  return approx_left_inverse(slopes, system.size(), system.size(), K) && is_moderate(K) &&
         is_moderate(r) && maps_into_itself(K, center, over, r);
}

}  // namespace regulus::verifier
