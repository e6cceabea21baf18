// SPDX-License-Identifier: Apache-2.0
#include "runtime/regularity/second_order_lists.hpp"

#include <algorithm>
#include <set>

namespace regulus::detail {
namespace {

unsigned narrow(std::size_t x) { return static_cast<unsigned>(x); }

}  // namespace

SecondOrderLists::SecondOrderLists(const DerivativeLists& lists, const RowStructure& structure)
    : rows_(lists.rows), columns_(lists.columns), variables_(lists.variables) {
  for (const std::size_t row : structure.rows) touched_.push_back(narrow(row));
  list_wide(lists, structure);
  list_pairs(lists, structure);
  list_rows(lists, structure);
}

SecondOrderPlan::Entry SecondOrderLists::entry_of(const DerivativePlace& d, std::size_t at) const {
  return {narrow(d.row), narrow(d.column), narrow(at), narrow(d.row * columns_ + d.column)};
}

PlanRange SecondOrderLists::add_entries(const Entries& entries) {
  const unsigned begin = narrow(entries_.size());
  entries_.insert(entries_.end(), entries.begin(), entries.end());
  for (const Entry& entry : entries) columns_of_entries_.push_back(entry.column);
  return {begin, narrow(entries_.size())};
}

std::size_t SecondOrderLists::wide_index(std::size_t variable) const {
  const auto known = std::find_if(wide_.begin(), wide_.end(),
                                  [&](const auto& w) { return w.variable == variable; });
  return static_cast<std::size_t>(known - wide_.begin());
}

/// B does not move along a quantity with a row of its own.
void SecondOrderLists::list_wide(const DerivativeLists& lists, const RowStructure& structure) {
  std::map<std::size_t, std::set<std::size_t>> columns_of;
  for (const DerivativePlace& d : lists.first)
    if (!structure.touches_one_row(d.first)) columns_of[d.first].insert(d.column);
  for (const auto* list : {&lists.second, &lists.row_second})
    for (const DerivativePlace& d : *list)
      for (const std::size_t variable : {d.first, d.second})
        if (!structure.touches_one_row(variable)) columns_of[variable];
  for (const auto& [variable, columns] : columns_of) {
    const unsigned begin = narrow(columns_of_D_.size());
    for (const std::size_t column : columns) columns_of_D_.push_back(narrow(column));
    const PlanRange range{begin, narrow(columns_of_D_.size())};
    Entries first;
    for (std::size_t at = 0; at < lists.first.size(); ++at) {
      const DerivativePlace& d = lists.first[at];
      if (d.first != variable) continue;
      first.push_back(entry_of(d, at));
    }
    wide_.push_back({narrow(variable), range, add_entries(first)});
  }
}

void SecondOrderLists::list_pairs(const DerivativeLists& lists, const RowStructure& structure) {
  std::map<std::pair<std::size_t, std::size_t>, Entries> second;
  for (std::size_t at = 0; at < lists.second.size(); ++at) {
    const DerivativePlace& d = lists.second[at];
    if (structure.touches_one_row(d.first) || structure.touches_one_row(d.second)) continue;
    second[{wide_index(d.first), wide_index(d.second)}].push_back(entry_of(d, at));
  }
  for (std::size_t p = 0; p < wide_.size(); ++p)
    for (std::size_t q = p; q < wide_.size(); ++q) {
      Entries& entries = second[{p, q}];
      std::ranges::sort(entries, {}, [](const Entry& e) { return std::pair(e.row, e.column); });
      const unsigned starts = narrow(starts_.size());
      for (unsigned row = 0; row <= columns_; ++row) {
        const auto first = std::ranges::lower_bound(entries, row, {}, &Entry::row);
        starts_.push_back(narrow(entries_.size()) + static_cast<unsigned>(first - entries.begin()));
      }
      pairs_.push_back({narrow(p), narrow(q), add_entries(entries), starts});
    }
}

void SecondOrderLists::list_rows(const DerivativeLists& lists, const RowStructure& structure) {
  std::vector<RowVariable> variables;
  const auto find = [&](std::size_t variable) -> RowVariable& {
    for (RowVariable& u : variables)
      if (u.variable == variable) return u;
    const auto slot = static_cast<unsigned>(structure.slot[variable]);
    variables.push_back({narrow(variable), slot, {}, std::vector<Entries>(wide_.size()), {}});
    return variables.back();
  };
  for (std::size_t at = 0; at < lists.row_first.size(); ++at) {
    const DerivativePlace& d = lists.row_first[at];
    find(d.first).first.push_back(entry_of(d, at));
  }
  for (std::size_t at = 0; at < lists.row_second.size(); ++at) {
    const DerivativePlace& d = lists.row_second[at];
    const Entry entry = entry_of(d, at);
    const bool first_is_wide = !structure.touches_one_row(d.first);
    const bool second_is_wide = !structure.touches_one_row(d.second);
    RowVariable& u = find(second_is_wide ? d.first : d.second);
    if (first_is_wide || second_is_wide) {
      u.mixed[wide_index(first_is_wide ? d.first : d.second)].push_back(entry);
    } else {
      // ∂A/∂u_k is taken after the variables before u_k have moved, at a value of u_k between its
      // nominal value and its final value.
      if (u.other.empty() || u.other.back().first != d.first) u.other.push_back({d.first, {}});
      u.other.back().second.push_back(entry);
    }
  }
  group_rows(structure, variables);
}

/// Coordinates of one ball form a group if they touch the same row.
void SecondOrderLists::group_rows(const RowStructure& structure,
                                  std::vector<RowVariable>& variables) {
  const auto ball_of = [&](const RowVariable& u) {
    return structure.ball.empty() ? RowStructure::kNoBall : structure.ball[u.variable];
  };
  std::vector<std::vector<const RowVariable*>> groups;
  for (const RowVariable& u : variables) {
    const auto joins = [&](const std::vector<const RowVariable*>& group) {
      return ball_of(u) != RowStructure::kNoBall && ball_of(*group.front()) == ball_of(u) &&
             group.front()->slot == u.slot && group.size() < kMaxBall;
    };
    const auto known = std::find_if(groups.begin(), groups.end(), joins);
    known != groups.end() ? known->push_back(&u) : groups.push_back({&u});
  }
  for (const auto& group : groups) {
    const unsigned begin = narrow(row_variables_.size());
    for (const RowVariable* u : group) add_row_variable(*u);
    groups_.push_back({{begin, narrow(row_variables_.size())}, group.front()->slot});
  }
}

void SecondOrderLists::add_row_variable(const RowVariable& u) {
  const unsigned mixed = narrow(mixed_.size());
  for (const Entries& entries : u.mixed) mixed_.push_back(add_entries(entries));
  const unsigned begin = narrow(same_rows_.size());
  for (const auto& [variable, entries] : u.other)
    same_rows_.push_back({narrow(variable), add_entries(entries)});
  row_variables_.push_back(
      {u.variable, u.slot, add_entries(u.first), mixed, {begin, narrow(same_rows_.size())}});
}

SecondOrderPlan SecondOrderLists::plan() const noexcept {
  SecondOrderPlan plan;
  plan.rows = narrow(rows_);
  plan.columns_of_A = narrow(columns_);
  plan.slots = narrow(touched_.size());
  plan.wides = narrow(wide_.size());
  plan.pairs = narrow(pairs_.size());
  plan.groups = narrow(groups_.size());
  plan.moving = plan.wides;
  plan.keeps_shares = false;
  plan.weighs_row_variables = false;
  plan.touched = touched_.data();
  plan.columns = columns_of_D_.data();
  plan.starts = starts_.data();
  plan.entries = entries_.data();
  plan.columns_of_entries = columns_of_entries_.data();
  plan.wide = wide_.data();
  plan.pair = pairs_.data();
  plan.mixed = mixed_.data();
  plan.same_rows = same_rows_.data();
  plan.row_variables = row_variables_.data();
  plan.group = groups_.data();
  return plan;
}

namespace {

/// Gives out parts of a buffer, or counts how much it must hold.
class Dealer {
 public:
  explicit Dealer(double* begin) noexcept : next_(begin) {}
  void give(PointArray& array, std::size_t packs) noexcept {
    array.x = next_ == nullptr ? nullptr : next_ + used_ * kLanes;
    used_ += packs;
  }
  [[nodiscard]] std::size_t used() const noexcept { return used_; }

 private:
  double* next_;
  std::size_t used_ = 0;
};

/// n columns, s slots, w wide variables.
struct Sizes {
  std::size_t n, s, w, pairs, rows;
};

std::size_t deal(double* begin, const Sizes& size, SecondOrderWork& work) noexcept {
  const auto [n, s, w, pairs, rows] = size;
  Dealer dealer(begin);
  for (PointArray* array : {&work.K, &work.abs_K, &work.sum_DK}) dealer.give(*array, n * s);
  dealer.give(work.D, w * n * n);
  dealer.give(work.DK, w * n * s);
  for (PointArray* array : {&work.e, &work.sum_d, &work.sum_D, &work.magnitude_of_B, &work.linear,
                            &work.rounding, &work.P, &work.pair_sum, &work.pair_radius})
    dealer.give(*array, n * n);
  dealer.give(work.center, n);
  dealer.give(work.pairs, pairs * n * n);
  for (PointArray* array : {&work.weight, &work.weight_of_g, &work.rest, &work.same_row})
    dealer.give(*array, s * n);
  dealer.give(work.R, s * s);
  dealer.give(work.R_of_wide, (1 + w) * s * s);
  dealer.give(work.R_of_row, rows * s);
  dealer.give(work.forms, rows * s);
  dealer.give(work.moving, s * s);
  dealer.give(work.slope, w * n);
  dealer.give(work.weight_of_value, 1 + w);
  dealer.give(work.weight_of_row, s);
  dealer.give(work.group_R, (1 + w) * s);
  dealer.give(work.group_lower, (1 + w) * n);
  return dealer.used();
}

}  // namespace

std::size_t SecondOrderLists::packs() const noexcept {
  SecondOrderWork counted;
  return deal(nullptr,
              {columns_, touched_.size(), wide_.size(), pairs_.size(), row_variables_.size()},
              counted);
}

SecondOrderWork SecondOrderLists::work(AlignedBuffer& numbers) const noexcept {
  SecondOrderWork work;
  deal(numbers.get(),
       {columns_, touched_.size(), wide_.size(), pairs_.size(), row_variables_.size()}, work);
  return work;
}

}  // namespace regulus::detail
