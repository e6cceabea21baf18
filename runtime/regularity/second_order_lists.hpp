// SPDX-License-Identifier: Apache-2.0
// Makes a SecondOrderPlan from a kernel's lists of derivatives, and owns the plan's data.
#pragma once

#include <map>
#include <vector>

#include "runtime/regularity/aligned_buffer.hpp"
#include "runtime/regularity/row_structure.hpp"
#include "runtime/regularity/second_order_plan.hpp"

namespace regulus::detail {

/// The derivative of an entry by `first`, and also by `second` ≥ first if its order is two.
struct DerivativePlace {
  std::size_t row, column, first, second;
};

/// Derivatives that are not listed are zero.
struct DerivativeLists {
  std::size_t rows = 0, columns = 0, variables = 0;
  std::vector<DerivativePlace> first, second;          ///< of B, by wide variables
  std::vector<DerivativePlace> row_first, row_second;  ///< of A, by at least one with a row
};

class SecondOrderLists {
 public:
  /// Requires  a variable that `structure` gives a row is listed with it.
  SecondOrderLists(const DerivativeLists& lists, const RowStructure& structure);

  /// Valid for the life of this object.
  [[nodiscard]] SecondOrderPlan plan() const noexcept;
  /// Returns the size of the buffer of numbers for plan(); work() must get the same buffer.
  [[nodiscard]] std::size_t packs() const noexcept;
  [[nodiscard]] SecondOrderWork work(AlignedBuffer& numbers) const noexcept;

  [[nodiscard]] std::size_t variables() const noexcept { return variables_; }
  [[nodiscard]] std::size_t row_variables() const noexcept { return row_variables_.size(); }

 private:
  using Entry = SecondOrderPlan::Entry;
  using Entries = std::vector<Entry>;
  struct RowVariable {
    unsigned variable, slot;
    Entries first;
    std::vector<Entries> mixed;                          // by wide variable
    std::vector<std::pair<std::size_t, Entries>> other;  // of its row: itself, those before it
  };

  void list_wide(const DerivativeLists& lists, const RowStructure& structure);
  void list_pairs(const DerivativeLists& lists, const RowStructure& structure);
  void list_rows(const DerivativeLists& lists, const RowStructure& structure);
  void group_rows(const RowStructure& structure, std::vector<RowVariable>& variables);
  void add_row_variable(const RowVariable& variable);
  [[nodiscard]] Entry entry_of(const DerivativePlace& d, std::size_t at) const;
  PlanRange add_entries(const Entries& entries);
  [[nodiscard]] std::size_t wide_index(std::size_t variable) const;

  std::size_t rows_, columns_, variables_;
  std::vector<unsigned> touched_, columns_of_D_, starts_, columns_of_entries_;
  Entries entries_;
  std::vector<SecondOrderPlan::Wide> wide_;
  std::vector<SecondOrderPlan::Pair> pairs_;
  std::vector<PlanRange> mixed_;
  std::vector<SecondOrderPlan::SameRow> same_rows_;
  std::vector<SecondOrderPlan::RowVariable> row_variables_;
  std::vector<SecondOrderPlan::Group> groups_;
};

}  // namespace regulus::detail
