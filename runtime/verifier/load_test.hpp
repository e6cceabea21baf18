// SPDX-License-Identifier: Apache-2.0
// The tests that forces within the limits hold a load all over a box, or hold it nowhere in it.
// PROOF.md, "Forces within limits", derives them.
#pragma once

#include "runtime/verifier/load_lines.hpp"
#include "runtime/verifier/middle_forces.hpp"
#include "runtime/verifier/slopes.hpp"

namespace regulus::verifier {

class LoadTest {
 public:
  /// Adds derivatives to the question's graph. Throws as enclose_load.
  LoadTest(Question& question, const Variety& variety);

  enum class Claim {
    kHeld,     ///< at every point the model is defined, and every wrench of the load is held
    kNotHeld,  ///< at every point some wrench of the load is held by no forces within the limits
    kOutside,  ///< no point of the box is in the variety
  };
  [[nodiscard]] BoxAnswer decide(const Box& box, Claim claim);

  /// After kOpen: returns the variable that is best to split; nullopt if none can be split.
  [[nodiscard]] std::optional<std::size_t> variable_to_split(const Box& box) const {
    return variable_of_impact(variety_, box, impact_);
  }
  [[nodiscard]] const Box& middle() const noexcept { return middle_.point; }

 private:
  using Intervals = std::vector<Interval>;

  [[nodiscard]] bool enclose(const Box& box);
  [[nodiscard]] bool find_inverse();
  void bound_error();
  [[nodiscard]] MiddleForces middle_forces(const Intervals& wrench) const;
  [[nodiscard]] bool is_held(const Intervals& wrench);
  [[nodiscard]] bool is_within_limits(const std::vector<double>& forces, const Intervals& residual);
  [[nodiscard]] std::vector<double> bound_correction(const std::vector<double>& residual) const;
  [[nodiscard]] double ball_force(std::size_t row) const;
  [[nodiscard]] bool is_not_held(const Intervals& wrench);
  [[nodiscard]] double length_of_row(std::size_t row) const;
  void weigh_free_rows();
  [[nodiscard]] Interval entry_over_box(std::size_t row, std::size_t column) const;
  [[nodiscard]] Intervals without_free_forces(const std::vector<double>& near) const;
  [[nodiscard]] Interval needed_along(const Intervals& direction) const;
  [[nodiscard]] Interval possible_along(const Intervals& direction);
  [[nodiscard]] Interval along(std::size_t row, const Intervals& direction) const;

  [[nodiscard]] Interval A(std::size_t i, std::size_t j) const { return slopes_.entry(i, j); }
  [[nodiscard]] double K(std::size_t j, std::size_t i) const { return K_[i * n_ + j]; }

  const Variety& variety_;
  const LoadBounds bounds_;
  const std::size_t m_, n_;
  std::vector<double> weight_;  ///< half of the range of each force, 0: the force is given; without
                                ///< limits, for one box: large
  MatrixSlopes slopes_;
  Outside outside_;

  // For one box.
  Middle middle_;
  ScaledRows scaled_;
  Matrix K_;                   ///< columns × rows
  std::vector<double> error_;  ///< P: |K·A − I| ≤ P, row by row
  std::vector<double> impact_;
};

}  // namespace regulus::verifier
