// SPDX-License-Identifier: Apache-2.0
// Makes the terms of orthants.hpp for one box from the numbers of its bounds.
#pragma once

#include "runtime/regularity/orthants.hpp"
#include "runtime/regularity/second_order.hpp"

namespace regulus::detail {

class OrthantTerms {
 public:
  /// The treatment of products of two uncertain quantities of a row.
  enum class Products : std::uint8_t {
    kBounded,  ///< in S
    kForms,    ///< their first part in forms, the rest in S
  };

  /// All must outlive this object.
  OrthantTerms(const SecondOrderPlan& plan, const SecondOrderInput& input,
               const SecondOrderWork& work, ConstPointMatrix T, std::size_t lane,
               OrthantProblem& problem) noexcept;

  /// Loads terms, forms and reach into the problem. Returns false if there are too many forms.
  ///
  /// Rounding  upward.
  [[nodiscard]] bool load(Products products) noexcept;

  /// Returns the entries of M and Q, after load.
  [[nodiscard]] double M(unsigned row, unsigned j) const noexcept { return M_[row][j]; }
  [[nodiscard]] double Q(unsigned row, unsigned k) const noexcept { return Q_[row][k]; }

 private:
  using Group = SecondOrderPlan::Group;
  using Term = OrthantProblem::Term;

  /// The part of a group in coupled terms.
  struct Role {
    enum class Kind : std::uint8_t { kAlone, kEnd, kFollower, kFirstBall, kSecondBall };
    Kind kind = Kind::kAlone;
    unsigned partner = 0;  ///< of a ball
  };

  [[nodiscard]] double at(const PointArray& array, std::size_t e) const noexcept {
    return array.x[point_at(e, lane_)];
  }
  [[nodiscard]] double P(unsigned i, unsigned j) const noexcept {
    return T_.at(i * (n_ + s_) + j, lane_);
  }
  [[nodiscard]] double K(unsigned i, unsigned slot) const noexcept {
    return in_.K.at(i * plan_.rows + plan_.touched[slot], lane_);
  }
  [[nodiscard]] const Group& group(unsigned of_row) const noexcept {
    return plan_.group[groups_[of_row]];
  }

  [[nodiscard]] bool load_row(unsigned row, Products products) noexcept;
  void load_Q(unsigned row, Products products) noexcept;
  void list_groups(unsigned row) noexcept;
  void pair_balls() noexcept;
  void choose_ends() noexcept;
  void find_followers() noexcept;
  [[nodiscard]] unsigned count_partners(unsigned g) const noexcept;
  [[nodiscard]] bool is_covered(unsigned a, unsigned b) const noexcept;
  [[nodiscard]] bool have_products(const Group& a, const Group& b) const noexcept;
  [[nodiscard]] bool load_balls(unsigned row) noexcept;
  [[nodiscard]] bool load_ranges(unsigned row) noexcept;
  [[nodiscard]] bool begin_coupled(Term::Kind kind, unsigned first, unsigned second) noexcept;
  void load_scaled(const Group& group, unsigned at_form) noexcept;
  void load_coupling(unsigned row, const Group& first, unsigned i, const Group& second,
                     unsigned j) noexcept;
  void load_quantities() noexcept;
  [[nodiscard]] double range(const Group& group) const noexcept;
  [[nodiscard]] bool load_products(unsigned row) noexcept;
  [[nodiscard]] bool load_term(unsigned row, const Group& a, const Group& b) noexcept;
  [[nodiscard]] bool load_forms(unsigned row, const Group& a, const Group& b,
                                const Term& term) noexcept;
  [[nodiscard]] bool append_zeros(unsigned count) noexcept;
  template <typename Visit>
  void visit_listed(const Group& a, const Group& b, Visit&& visit) const noexcept;
  template <typename Visit>
  void visit_products(const Group& a, const Group& b, Visit&& visit) const noexcept;
  void load_form(unsigned row, const PlanRange& entries, double weight, unsigned at_form) noexcept;
  void bound_reach() noexcept;

  const SecondOrderPlan& plan_;
  const SecondOrderInput& in_;
  const SecondOrderWork& w_;
  const ConstPointMatrix T_;
  const std::size_t lane_;
  OrthantProblem& p_;
  const unsigned n_, s_;
  unsigned forms_ = 0;
  unsigned group_count_ = 0;           ///< of the row
  unsigned groups_[kMaxOrthantForms];  ///< of the row: indices into plan_.group
  Role role_[kMaxOrthantForms];        ///< of each
  double M_[kMaxOrthantRows][kMaxOrthantRows], Q_[kMaxOrthantRows][kMaxColumns];
};

}  // namespace regulus::detail
