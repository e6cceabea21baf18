// SPDX-License-Identifier: Apache-2.0
// The rows of A that are touched by quantities of one row each. Let A be regular with these
// quantities at the middles of their ranges. It stays regular if no y ≠ 0 has y_s = Σ_k δ_k(b_k +
// c_k)·y for all s, summed over the quantities k of the s-th row touched, with |c_k| ≤ S_k.
// PROOF.md, "The test", 2, derives this.
#pragma once

#include <optional>

#include "runtime/certificate/verifier/domination.hpp"
#include "runtime/certificate/verifier/moving_inverse.hpp"
#include "runtime/certificate/verifier/variety.hpp"

namespace regulus::verifier {

class TouchedRows {
 public:
  /// Adds derivatives to the question's graph.
  TouchedRows(Question& question, const Variety& variety, const std::vector<std::size_t>& moving);

  [[nodiscard]] std::size_t order() const noexcept { return rows_.size(); }

  /// `inverse` has been run with the same middle and r, and is dominated. Returns false if nothing
  /// could be bounded.
  [[nodiscard]] bool run(const Box& box, const Box& middle, const std::vector<double>& r,
                         const MovingInverse& inverse, const Domination& domination);

  /// After run: |Σ δ_k(b_k + c_k)| ≤ T, row by row.
  [[nodiscard]] const Matrix& T() const noexcept { return T_; }
  /// Returns true only if there is no such y. Searches the surface of the box |y| ≤ v, v > 0;
  /// returns false also if that takes too long.
  [[nodiscard]] bool has_no_null_vector(const std::vector<double>& v) const;

  /// Adds the contribution of each variable to Tv, relative to v; roughly.
  void add_impacts(const std::vector<double>& v, std::vector<double>& impact) const;

 private:
  struct Quantity {
    std::size_t variable, slot;  ///< touches rows_[slot]
    std::vector<NodeId> w;       ///< the derivative of the row
    std::vector<std::vector<NodeId>> by_moving;
    std::vector<std::pair<std::size_t, std::vector<NodeId>>> by_quantity;
    std::vector<double> b, S;                   ///< by slot
    std::vector<std::vector<double>> followed;  ///< parts of S, by moving variable
  };
  /// Quantities of one row: a single one, or those of one ball.
  struct Group {
    std::size_t slot;
    std::optional<std::size_t> ball;
    std::vector<std::size_t> members;  ///< of quantities_
  };
  /// A box of vectors y.
  struct Directions {
    std::vector<double> middle, radius;
  };

  void find_quantities();
  void differentiate(Quantity& quantity);
  void find_groups();
  void bound_K(const MovingInverse& inverse, const Domination& domination);
  [[nodiscard]] bool bound_quantity(Quantity& quantity, const MovingInverse& inverse);
  template <class Value>
  [[nodiscard]] double bound_group(const Group& group, Value value) const;
  [[nodiscard]] bool has_no_null_vector(Directions& y) const;

  Question& q_;
  const Variety& variety_;
  const std::vector<std::size_t>& moving_;
  const std::size_t n_;
  std::vector<std::size_t> rows_;
  std::vector<Quantity> quantities_;
  std::vector<Group> groups_;
  std::optional<Evaluation> at_middle_, over_box_;

  // For one box; matrices are n×slots, except T.
  std::vector<double> r_;
  std::vector<bool> whole_;  ///< by ball: no range of its coordinates has been cut
  Matrix K_;                 ///< the columns of K for these rows
  std::vector<Matrix> DK_;   ///< D_p·K
  Matrix moved_, unsure_;    ///< bounds of |K(t) − K|, and of the part that DK does not cover
  Matrix G_;                 ///< at least (I − P)⁻¹|K(t)|
  Matrix T_;                 ///< slots×slots
  std::vector<double> w_, g_, drift_, Y_;
};

/// Bounds |Σ δ_kx_k| over the values of the group, where |x_k| ≤ value(k). If a split has cut a
/// ball, the box around the rest of the ball is used.
template <class Value>
double TouchedRows::bound_group(const Group& group, Value value) const {
  double sum = 0.0;
  const bool is_ball = group.ball && whole_[*group.ball];
  for (const std::size_t k : group.members) {
    const double x = value(quantities_[k]);
    sum += is_ball ? x * x : r_[quantities_[k].variable] * x;
  }
  return is_ball ? variety_.reach[*group.ball] * std::sqrt(sum) : sum;
}

}  // namespace regulus::verifier
