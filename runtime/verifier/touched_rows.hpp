// SPDX-License-Identifier: Apache-2.0
// The rows of A that are touched by quantities of one row each. Let A be regular with these
// quantities at the middles of their ranges. It stays regular if no y ≠ 0 has y_s = −Σ_k δ_k(b_k +
// c_k)·y − Σ_jk δ_jδ_k(b_jk + c_jk)·y for all s, summed over the quantities of the s-th row touched
// and their products, with |c| ≤ S.
// PROOF.md, "The test", 2, derives this.
#pragma once

#include <optional>

#include "runtime/verifier/domination.hpp"
#include "runtime/verifier/moving_inverse.hpp"
#include "runtime/verifier/variety.hpp"

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
  /// The coefficient of δ_k or of δ_jδ_k in y is (b + c)·y, |c| ≤ S; by slot.
  struct Coefficient {
    std::vector<double> b, S;
    std::vector<std::vector<double>> followed;  ///< parts of S, by moving variable
  };
  struct Quantity {
    std::size_t variable, slot;  ///< touches rows_[slot]
    std::vector<NodeId> w;       ///< the derivative of the row
    std::vector<std::vector<NodeId>> by_moving;
    Coefficient coefficient;
  };
  /// Quantities of one row: a single one, or those of one ball.
  struct Group {
    std::size_t slot;
    std::optional<std::size_t> ball;
    std::vector<std::size_t> members;  ///< of quantities_
    bool is_coupled = false;           ///< single: in a coupling; ball: with one other
  };
  /// The product of two quantities of one row.
  struct Product {
    std::size_t first, second;  ///< places in the groups
    std::vector<NodeId> H;      ///< the second derivative of the row
    Coefficient coefficient;
  };
  /// The products of quantities of two groups. Of a group with itself, each is listed once.
  struct Products {
    std::size_t first, second;  ///< of groups_
    std::vector<Product> members;
    bool is_coupled = false;  ///< in a coupling, or of coupled balls
  };
  /// Single quantities of a row that are bounded together with their products: `ends` at ends of
  /// their ranges, all combinations of which are tried.
  struct Coupling {
    std::size_t slot;
    std::vector<std::size_t> ends, followers;  ///< of groups_
    std::vector<std::size_t> products;         ///< of products_: each of an end and a follower
  };
  /// |x − middle| ≤ radius.
  struct Estimate {
    double middle, radius;
    [[nodiscard]] double magnitude() const noexcept { return std::fabs(middle) + radius; }
  };
  /// The coefficients times y, for groups_ and for products_.
  struct Effects {
    std::vector<std::vector<Estimate>> groups, products;
  };
  /// A box of vectors y.
  struct Directions {
    std::vector<double> middle, radius;
  };

  void find_quantities();
  void find_groups();
  void find_products();
  void find_couplings();
  [[nodiscard]] Coupling find_coupling(std::size_t slot);
  void pair_balls();
  [[nodiscard]] std::size_t products_between(std::size_t a, std::size_t b) const;
  void resize(Coefficient& coefficient) const;
  void bound_K(const MovingInverse& inverse, const Domination& domination);
  [[nodiscard]] bool bound_quantity(Quantity& quantity, const MovingInverse& inverse);
  [[nodiscard]] bool bound_product(Product& product, const MovingInverse& inverse);
  void follow(Coefficient& k, std::size_t p);
  void bound(Coefficient& k, const MovingInverse& inverse);
  /// Calls estimate(coefficient) for all coefficients, and adds the bounds of y to `most`, by slot.
  template <class Value>
  void add_bounds(Value estimate, std::vector<double>& most) const;
  [[nodiscard]] bool is_ball(const Group& group) const { return group.ball && whole_[*group.ball]; }
  [[nodiscard]] double bound_of(const Group& group, const std::vector<Estimate>& x) const;
  [[nodiscard]] double bound_of(const Products& products, const std::vector<Estimate>& x) const;
  /// Bounds Σ δ_kx_k + sign·Σ δ_jδ_kx_jk over the quantities of a row.
  [[nodiscard]] double bound_of_row(std::size_t slot, const Effects& x, double sign) const;
  [[nodiscard]] double bound_of(const Coupling& coupling, const Effects& x, double sign) const;
  /// The same of two balls.
  [[nodiscard]] double bound_of_balls(const Products& products, const Effects& x,
                                      const std::vector<Estimate>& of_products, double sign) const;
  [[nodiscard]] bool are_coupled_balls(const Products& products) const {
    return products.is_coupled && is_ball(groups_[products.first]) &&
           is_ball(groups_[products.second]);
  }
  [[nodiscard]] Effects effects(const Directions& y) const;
  [[nodiscard]] double spread(const Group& group, std::size_t place) const {
    return r_[quantities_[group.members[place]].variable];
  }
  [[nodiscard]] bool has_no_null_vector(Directions& y) const;

  Question& q_;
  const Variety& variety_;
  const std::vector<std::size_t>& moving_;
  const std::size_t n_;
  std::vector<std::size_t> rows_;
  std::vector<Quantity> quantities_;
  std::vector<Group> groups_;
  std::vector<Products> products_;
  std::vector<Coupling> couplings_;
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
  mutable std::vector<Estimate> estimates_;
};

template <class Value>
void TouchedRows::add_bounds(Value estimate, std::vector<double>& most) const {
  for (const Group& group : groups_) {
    estimates_.clear();
    for (const std::size_t k : group.members)
      estimates_.push_back(estimate(quantities_[k].coefficient));
    most[group.slot] += bound_of(group, estimates_);
  }
  for (const Products& products : products_) {
    estimates_.clear();
    for (const Product& product : products.members)
      estimates_.push_back(estimate(product.coefficient));
    most[groups_[products.first].slot] += bound_of(products, estimates_);
  }
}

}  // namespace regulus::verifier
