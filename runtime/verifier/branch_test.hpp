// SPDX-License-Identifier: Apache-2.0
// The test that a system of equations has exactly one solution in a tube, at every place of a box.
// PROOF.md, "Closures", derives it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/linear_algebra.hpp"
#include "runtime/verifier/prover.hpp"

namespace regulus::verifier {

/// A small box of the unknowns.
struct SolutionBox {
  std::vector<double> middle, radius;
};

enum class Place { kInside, kOutside, kUnknown };

class BranchTest {
 public:
  /// Adds derivatives to the question's graph. The question must outlive this object. `moves`: with
  /// derivatives by the variables, which tubes that move with them need; others are tested without.
  explicit BranchTest(Question& question, bool moves = true);

  /// Ensures   true only if at each place of the box the equations have exactly one solution in the
  ///           tube, and in all of the tube they and the expressions that must be defined have
  ///           values, and the derivatives by the unknowns exist and are a regular matrix.
  [[nodiscard]] bool has_one_solution(const Box& box, const TubeNumbers& tube);
  /// After it was false: how much each variable adds to the left side; empty if nothing is known.
  [[nodiscard]] const std::vector<double>& impact() const noexcept { return impact_; }

  // After has_one_solution() or solution_near(): the places and unknowns over which the test was last
  // tried, the derivatives of the equations by the unknowns there, and K.
  [[nodiscard]] const Box& whole() const noexcept { return whole_; }
  [[nodiscard]] Interval derivative(std::size_t equation, std::size_t unknown) const {
    return first_values_[equation * all_ + m_ + unknown];
  }
  [[nodiscard]] double inverse(std::size_t row, std::size_t column) const {
    return K_[column * n_ + row];
  }

  // After has_one_solution() of a tube: the equations' derivatives to the first order. The places are
  // x̄ + δ and the unknowns c̄ + Sδ + ρ, where x̄ is the middle of the box and c̄ that of the tube there.

  /// Encloses the derivatives of the derivatives over the tube. Returns false if nothing is known.
  [[nodiscard]] bool take_rates();
  /// Encloses the derivative at (x̄, c̄).
  [[nodiscard]] Interval center_derivative(std::size_t equation, std::size_t unknown) const {
    return center_[equation * all_ + m_ + unknown];
  }
  /// After take_rates(): encloses its derivative by δ_k, or by ρ_l with k = number of variables + l, over
  /// the tube.
  [[nodiscard]] Interval rate(std::size_t equation, std::size_t unknown, std::size_t k) const;
  /// |δ_k| or |ρ_l| is at most that.
  [[nodiscard]] double reach(std::size_t k) const {
    return k < m_ ? mag(step_[k]) : radius_of(*tube_)[k - m_];
  }

  /// Encloses the value of one unknown minus that of another at the places over which the test was
  /// last true.
  [[nodiscard]] Interval difference(std::size_t unknown, std::size_t other) const;

  /// Returns true only if the equations have no solution in the tube at any place of a small box.
  [[nodiscard]] bool has_no_solution(const Box& place, const TubeNumbers& tube);

  /// Narrows a box of unknowns to a part with all solutions that are in it, at any place of `places`.
  /// Returns false only if there are none; the box has no meaning then.
  [[nodiscard]] bool narrow_to_solutions(const Box& places, Box& unknowns);
  /// After it was true: which part of the changes of the equations is by each unknown; empty if nothing
  /// is known.
  [[nodiscard]] const std::vector<double>& shares() const noexcept { return shares_; }

  /// Ensures   true only if the equations and what must be defined have values all over the boxes, and
  ///           the derivatives by the unknowns exist and are a regular matrix there.
  [[nodiscard]] bool is_regular(const Box& places, const Box& unknowns);

  /// Returns a small box in which the equations have exactly one solution at each place of `place`,
  /// a small box. It is looked for near `start`, to a small part of `scale`.
  [[nodiscard]] std::optional<SolutionBox> solution_near(const Box& place,
                                                         std::vector<double> start,
                                                         std::span<const double> scale);

  /// Ensures   true only if, at each place of `place`, there is exactly one solution within `outer`
  ///           of `middle`, and it is within `inner` of it.
  [[nodiscard]] bool has_one_solution(const Box& place, const std::vector<double>& middle,
                                      const std::vector<double>& outer,
                                      const std::vector<double>& inner);

  /// The same, but what must be defined may have no values where the solution is not.
  [[nodiscard]] bool has_one_start(const Box& place, const std::vector<double>& middle,
                                   const std::vector<double>& outer,
                                   const std::vector<double>& inner);

  /// Encloses the middle line c + S(x − x₀) of a tube at the places of a box.
  [[nodiscard]] std::vector<Interval> middle_of(const TubeNumbers& tube, const Box& box) const;
  /// Tells where a box of unknowns lies: in the tube at all places of `place`, or outside at all.
  [[nodiscard]] Place place_of(const SolutionBox& solution, const TubeNumbers& tube,
                               const Box& place) const;
  /// The radius of a tube.
  [[nodiscard]] std::span<const double> radius_of(const TubeNumbers& tube) const {
    return std::span(tube).last(n_);
  }

 private:
  /// Matrices with a row for each equation, and a column for each variable and then each unknown.
  using Values = std::vector<Interval>;

  [[nodiscard]] double slope(const TubeNumbers& tube, std::size_t i, std::size_t k) const {
    return tube[m_ + n_ + i * m_ + k];
  }
  [[nodiscard]] static bool take(Evaluation& evaluation, const std::vector<NodeId>& nodes,
                                 const Box& box, Values& values);
  [[nodiscard]] bool take_center(const Box& point);
  [[nodiscard]] bool bound_center(const Box& point);
  void narrow_values(const Box& point);
  [[nodiscard]] Values mean_derivatives(const std::vector<Interval>& step) const;
  [[nodiscard]] double left_side(std::size_t i, const Values& over, std::size_t k) const;
  [[nodiscard]] Interval times_inverse(std::size_t i, const Values& columns, std::size_t count,
                                       std::size_t at) const;
  [[nodiscard]] bool narrow_by_rows(const Values& values, const Values& M,
                                    const std::vector<double>& center, Box& unknowns) const;
  [[nodiscard]] Values along(const TubeNumbers& tube, Values derivatives) const;
  [[nodiscard]] std::vector<double> changes(const TubeNumbers& tube,
                                            const std::vector<double>& reach) const;
  [[nodiscard]] bool is_in(const TubeNumbers& tube, const std::vector<double>& reach,
                           bool is_second_order);
  [[nodiscard]] bool has_one_in_box(Evaluation& over, const Box& place,
                                    const std::vector<double>& middle,
                                    const std::vector<double>& outer,
                                    const std::vector<double>& inner);
  [[nodiscard]] bool is_in_box(const std::vector<double>& outer, const std::vector<double>& inner,
                               bool is_second_order) const;
  [[nodiscard]] Interval second(std::size_t j, std::size_t k, std::size_t l) const {
    return second_at(j, m_ + k, m_ + l);
  }
  [[nodiscard]] Interval second_at(std::size_t j, std::size_t a, std::size_t b) const;

  Question& q_;
  const bool moves_;
  const std::size_t m_, n_, all_;  ///< variables, unknowns, both
  std::vector<NodeId> first_,
      second_;  ///< second_: of each equation the upper triangle, row by row
  std::optional<Evaluation> equations_, derivatives_, over_, near_start_, rates_;
  std::vector<NodeId> by_variable_;  ///< where the tube does not move
  std::optional<Evaluation> rates_at_center_;

  // For one box.
  Box whole_;
  const TubeNumbers* tube_ = nullptr;    ///< over which it was tried; null: no tube
  std::vector<Interval> step_, middle_;  ///< X − x̄ and the middle of the tube at x̄
  Matrix K_;                             ///< column by column
  Values value_;                         ///< K Φ at the centre, by unknown
  Values at_center_, center_, first_values_, second_values_;
  std::vector<double> impact_, shares_;
  bool has_rates_ = false;  ///< second_values_ are of the last tube
};

}  // namespace regulus::verifier
