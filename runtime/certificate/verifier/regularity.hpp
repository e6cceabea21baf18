// SPDX-License-Identifier: Apache-2.0
// The test that every matrix over a box has full column rank. PROOF.md, "The test", derives it.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "regulus/certificate/verifier/evaluation.hpp"
#include "regulus/certificate/verifier/expansion.hpp"
#include "regulus/certificate/verifier/question.hpp"
#include "regulus/certificate/verifier/variety.hpp"

namespace regulus::verifier {

/// A square matrix of order at most kMostRows + columns, row-major, of upper bounds.
struct Bounds {
  std::size_t order = 0;
  std::vector<double> entries;
  [[nodiscard]] double& at(std::size_t i, std::size_t j) { return entries[i * order + j]; }
  [[nodiscard]] double at(std::size_t i, std::size_t j) const { return entries[i * order + j]; }
};

class RegularityTest {
 public:
  /// Adds nodes to the question's graph.
  RegularityTest(Question& question, const Variety& variety);

  enum class Answer {
    kOutside,  ///< no point of the box is in the variety: a constraint is positive, or a ball is
               ///< left
    kRegular,  ///< at every point the model is defined, and the claim NO SINGULARITY holds
    kOpen,     ///< neither has been shown
  };
  [[nodiscard]] Answer decide(const Box& box);

  /// After kOpen: the variable whose range is best split; nullopt if none can be.
  [[nodiscard]] std::optional<std::size_t> variable_to_split(const Box& box) const;

  /// After kOpen: the sign of det A at the middle of the box, 0 where it is not known.
  [[nodiscard]] int sign_at_middle() const;
  [[nodiscard]] const Box& middle() const noexcept { return middle_; }

 private:
  /// Quantities δ that touch one row: one, |δ| ≤ Δ, or coordinates in a ball.
  struct Group {
    std::size_t slot;
    int ball;  ///< −1: one quantity
    std::vector<std::size_t> members;
  };
  /// One term C_μ·μ of A, with μ's derivatives by the wide variables.
  struct WideTerm {
    Term term;
    std::vector<NodeId> first;   ///< by wide variable
    std::vector<NodeId> second;  ///< by pair
  };
  /// w_k, the derivative of a row of A by quantity k, with its own derivatives; column by column.
  struct Direction {
    std::size_t row;
    std::vector<NodeId> w;
    std::vector<std::vector<NodeId>> by_wide;
    std::vector<std::pair<std::size_t, std::vector<NodeId>>> by_quantity;
  };
  using Matrix = std::vector<double>;
  using IntervalMatrix = std::vector<Interval>;

  void find_structure();
  void add_quantity(std::size_t variable, std::size_t row);
  void form_terms();
  void form_directions();
  void make_evaluations();
  [[nodiscard]] bool is_outside(const Box& box);
  [[nodiscard]] bool is_beyond(const BallOfVariables& ball, double reach, const Box& box) const;
  void place_middle(const Box& box);
  [[nodiscard]] bool evaluate_all(const Box& box);
  void bound_product();
  void multiply_term(std::size_t term);
  template <class Value>
  void add_terms(IntervalMatrix& sum, Value value) const;
  void add_slope(std::size_t p);
  void add_pair(std::size_t p, std::size_t q, std::size_t pair);
  void bound_rows(const Box& box);
  void bound_quantity(std::size_t variable);
  void follow(const Direction& direction, std::size_t p);
  [[nodiscard]] Interval moving_determinant() const;
  [[nodiscard]] std::vector<double> impacts() const;
  [[nodiscard]] bool find_vector();
  [[nodiscard]] bool dominates() const;
  [[nodiscard]] bool exceeds_threshold() const;
  [[nodiscard]] bool is_whole(const Group& group, const Box& box) const;

  Question& q_;
  const Variety& variety_;
  std::vector<std::size_t> wide_;  ///< variables that are not in a group and touch some row
  std::vector<Group> groups_;
  std::vector<std::size_t> rows_;  ///< the rows touched, by slot
  std::vector<bool> in_group_;
  std::vector<WideTerm> terms_;
  std::map<std::size_t, Direction> directions_;  ///< by variable
  std::optional<Evaluation> at_middle_, over_wide_, over_all_, motion_;

  // For one box.
  bool evaluated_ = false;  ///< T and what it is made of are those of the box
  Box middle_, pose_box_;
  std::vector<double> radius_;      ///< of the box about its middle
  Matrix K_;                        ///< columns × rows
  std::vector<IntervalMatrix> KC_;  ///< of each term
  Matrix e_, X_, Z_;                ///< |e|, Σr_p|D_p|, ½Σr_pr_q|B_pq|
  std::vector<IntervalMatrix> B_;   ///< B_p at the middle, for each wide variable
  std::vector<Matrix> D_;
  std::vector<IntervalMatrix> DK_;  ///< columns of D_p·K, one for each slot
  std::vector<Matrix> share_;       ///< of each wide variable in P; roughly
  IntervalMatrix pair_;
  Bounds T_;
  std::vector<double> v_, Tv_;
  std::vector<double> quantity_;  ///< what one quantity adds to its row of T, per Δ
  std::vector<std::vector<double>> of_quantity_;  ///< quantity_ for each variable in a group
  std::vector<double> group_sum_;
  std::vector<double> w_, g_;   ///< w̄, g_p
  std::vector<double> moving_;  ///< Σr_p|g_p|
  Matrix moved_;                ///< Σr_p|D_pK|, one column for each slot
};

/// An approximation of the inverse, or of the pseudo-inverse, of a rows × columns matrix; false if
/// elimination breaks down. Nothing is claimed about it.
[[nodiscard]] bool approx_left_inverse(const std::vector<double>& A, std::size_t rows,
                                       std::size_t columns, std::vector<double>& K);

/// Encloses the determinant of a square matrix of doubles.
[[nodiscard]] Ball determinant(const std::vector<double>& A, std::size_t order, long bits);
[[nodiscard]] Ball determinant(const std::vector<Ball>& A, std::size_t order, long bits);

}  // namespace regulus::verifier
