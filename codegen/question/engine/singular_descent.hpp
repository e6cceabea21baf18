// SPDX-License-Identifier: GPL-3.0-or-later
// Descents to places where a matrix is nearest to losing rank, in plain doubles: they show where to
// look, and prove nothing.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "codegen/question/engine/balanced_matrix.hpp"
#include "codegen/question/engine/pipeline.hpp"

namespace regulus::detail {

/// A matrix that can be evaluated approximately.
struct ApproxMatrix {
  std::size_t rows = 0, columns = 0;
  std::size_t operations = 0;  ///< of one evaluation
  /// Returns the entries, row-major, at the middles of the ranges; nullopt where it is undefined.
  std::function<std::optional<std::vector<double>>(std::span<const Interval>)> at;
};

/// A matrix with a least singular value below it, balanced, counts as singular in a search for a proof.
inline constexpr double kAlmostLostRank = 1e-9;

/// The matrix of a formulation; `entries`, the program of its entries, must outlive the result.
[[nodiscard]] ApproxMatrix approx_matrix(const Formulation& formulation, const Program& entries);

class SingularDescent {
 public:
  /// Both must outlive this object.
  SingularDescent(const PreparedSearch& preparation, const ApproxMatrix& matrix);

  struct Place {
    std::vector<Interval> point;  ///< thin
    std::vector<double> matrix;
    double singular_value;  ///< the least, of the balanced matrix
  };

  /// Returns the starting point of that number; number 0 is the middle of the variety.
  [[nodiscard]] std::vector<Interval> start(int number);
  [[nodiscard]] std::vector<Interval> middle_of(std::span<const Interval> box) const;

  /// Returns the place that Newton's steps reach; nullopt if the matrix is undefined at the start,
  /// or a constraint is violated there.
  [[nodiscard]] std::optional<Place> from(const std::vector<Interval>& start);

  /// From now on the variable has this value.
  void fix(std::size_t variable, double x) { ranges_[variable] = Interval(x); }
  /// Undoes all of that.
  void release() { ranges_ = all_ranges_; }

  /// Returns true if the effort that a report may take is spent.
  [[nodiscard]] bool exhausted() const noexcept { return evaluations_ >= most_evaluations_; }

 private:
  [[nodiscard]] std::optional<Place> look_at(const std::vector<Interval>& point);
  [[nodiscard]] std::vector<double> typical_matrix();
  [[nodiscard]] Eigen::MatrixXd scaled(const std::vector<double>& matrix) const;
  [[nodiscard]] std::optional<Place> improved(const Place& place);
  [[nodiscard]] Eigen::VectorXd newton_step(const Place& place);
  [[nodiscard]] double width(std::size_t k) const noexcept { return ranges_[k].hi - ranges_[k].lo; }
  [[nodiscard]] Eigen::VectorXd slope(const Place& place, const Eigen::MatrixXd& A,
                                      const Eigen::VectorXd& v, std::size_t k);

  const ApproxMatrix& matrix_;
  Program constraints_;
  std::vector<Interval> ranges_, all_ranges_;
  BalancedMatrix scales_;
  std::minstd_rand random_;
  std::size_t evaluations_ = 0;
  std::size_t most_evaluations_;
};

}  // namespace regulus::detail
