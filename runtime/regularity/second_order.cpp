// SPDX-License-Identifier: Apache-2.0
// Which listed derivative goes where; the numbers are in second_order_bounds.cpp.
#include "regulus/regularity/second_order.hpp"

#include <algorithm>

namespace regulus {

SecondOrderBounds::SecondOrderBounds(const DerivativeLists& lists, const RowStructure& structure,
                                     bool moves)
    : rows_(lists.rows),
      columns_(lists.columns),
      moves_(moves),
      touched_(structure.rows),
      radius_(lists.variables) {
  list_wide(lists, structure);
  list_rows(lists, structure);
  group_row_variables(structure);
  const std::size_t m = rows_, n = columns_, slots = touched_.size();
  for (WideVariable& w : wide_) {
    w.D = w.defect = OctetMatrix(n, n);
    w.DK = OctetMatrix(n, m);
    w.R = OctetMatrix(slots, slots);
  }
  for (RowVariable& u : row_variables_) u.R = OctetMatrix(1, slots);
  K_ = abs_K_ = sum_DK_ = OctetMatrix(n, m);
  e_ = sum_d_ = sum_D_ = radius_of_B_ = magnitude_of_B_ = pair_ = P_ = OctetMatrix(n, n);
  weight_ = weight_of_g_ = rest_ = OctetMatrix(slots, n);
  R_ = OctetMatrix(slots, slots);
  row_ = OctetMatrix(1, n);
  slope_ = OctetMatrix(wide_.size(), n);
  columns_of_group_ = OctetMatrix(1 + wide_.size(), n);
  R_of_group_ = OctetMatrix(1 + wide_.size(), slots);
}

/// Coordinates of one ball form a group if they touch the same row.
void SecondOrderBounds::group_row_variables(const RowStructure& structure) {
  const auto ball_of = [&](std::size_t k) {
    return structure.ball.empty() ? RowStructure::kNoBall
                                  : structure.ball[row_variables_[k].variable];
  };
  for (std::size_t k = 0; k < row_variables_.size(); ++k) {
    const auto joins = [&](const Group& group) {
      return ball_of(k) != RowStructure::kNoBall && ball_of(group.front()) == ball_of(k) &&
             row_variables_[group.front()].slot == row_variables_[k].slot &&
             group.size() < kMaxBall;
    };
    const auto known = std::find_if(groups_.begin(), groups_.end(), joins);
    if (known != groups_.end())
      known->push_back(k);
    else
      groups_.push_back({k});
  }
}

/// The index of a wide variable, which is added if need be.
std::size_t SecondOrderBounds::wide_index(std::size_t variable) {
  for (std::size_t p = 0; p < wide_.size(); ++p)
    if (wide_[p].variable == variable) return p;
  wide_.push_back({variable, {}, {}, {}, {}, {}});
  return wide_.size() - 1;
}

SecondOrderBounds::RowVariable& SecondOrderBounds::row_variable(std::size_t variable,
                                                                const RowStructure& structure) {
  for (RowVariable& u : row_variables_)
    if (u.variable == variable) return u;
  const auto slot = static_cast<std::size_t>(structure.slot[variable]);
  row_variables_.push_back({variable, slot, {}, {}, {}, {}});
  return row_variables_.back();
}

void SecondOrderBounds::list_wide(const DerivativeLists& lists, const RowStructure& structure) {
  for (std::size_t at = 0; at < lists.first.size(); ++at) {
    const DerivativePlace& d = lists.first[at];
    if (structure.touches_one_row(d.first)) continue;  // a quantity that B is not moved along
    wide_[wide_index(d.first)].first.push_back({d.row, d.column, at});
  }
  for (const auto* list : {&lists.second, &lists.row_second})
    for (const DerivativePlace& d : *list)
      for (const std::size_t variable : {d.first, d.second})
        if (!structure.touches_one_row(variable)) static_cast<void>(wide_index(variable));
  std::sort(wide_.begin(), wide_.end(),
            [](const WideVariable& a, const WideVariable& b) { return a.variable < b.variable; });
  for (std::size_t p = 0; p < wide_.size(); ++p)
    for (std::size_t q = p; q < wide_.size(); ++q) pairs_.push_back({p, q, {}});
  for (std::size_t at = 0; at < lists.second.size(); ++at) {
    const DerivativePlace& d = lists.second[at];
    if (structure.touches_one_row(d.first) || structure.touches_one_row(d.second)) continue;
    const std::size_t p = wide_index(d.first), q = wide_index(d.second);
    std::find_if(pairs_.begin(), pairs_.end(), [&](const Pair& x) {
      return x.p == p && x.q == q;
    })->second.push_back({d.row, d.column, at});
  }
}

void SecondOrderBounds::list_rows(const DerivativeLists& lists, const RowStructure& structure) {
  for (std::size_t at = 0; at < lists.row_first.size(); ++at) {
    const DerivativePlace& d = lists.row_first[at];
    row_variable(d.first, structure).first.push_back({d.row, d.column, at});
  }
  for (std::size_t at = 0; at < lists.row_second.size(); ++at) {
    const DerivativePlace& d = lists.row_second[at];
    const Entry entry{d.row, d.column, at};
    const bool first_is_wide = !structure.touches_one_row(d.first);
    const bool second_is_wide = !structure.touches_one_row(d.second);
    RowVariable& u = row_variable(second_is_wide ? d.first : d.second, structure);
    if (first_is_wide || second_is_wide) {
      u.mixed.resize(wide_.size());
      u.mixed[wide_index(first_is_wide ? d.first : d.second)].push_back(entry);
    } else {
      // ∂A/∂u_k is taken after the variables before u_k have moved, at a value of u_k between its
      // nominal one and where it moves to.
      if (u.same_row.empty() || u.same_row.back().first != d.first)
        u.same_row.push_back({d.first, {}});
      u.same_row.back().second.push_back(entry);
    }
  }
  for (RowVariable& u : row_variables_) u.mixed.resize(wide_.size());
}

}  // namespace regulus
