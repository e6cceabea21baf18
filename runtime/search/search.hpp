// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/search/branch_and_prune.hpp"
#include "runtime/search/foresight.hpp"
#include "runtime/search/round.hpp"
#include "runtime/search/search_record.hpp"

namespace regulus::detail {

/// Algorithm 1 on up to eight boxes at a time, with the constraints of Table II. Its memory serves
/// for one search after another of the same problem.
class Search {
 public:
  /// Both must outlive this object.
  ///
  /// Requires  find_fault finds none; rounding to nearest.
  [[gnu::noinline]] Search(const Problem& problem, const Settings& settings);
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  /// Takes what searches of another problem have taught; it changes the time of the next, not its
  /// result.
  void learn_from(const Search& other) noexcept;
  /// Becomes the search of the problem whose ranges have changed in place.
  void take_ranges();

  /// Does the work of Solver::resume. The result depends on nothing but the problem, the settings,
  /// the boxes and the state.
  ///
  /// Requires  every open box is one of the problem's; rounding to nearest.
  /// Errors    std::bad_alloc before the first box and after the last; in between memory that is
  ///           exhausted ends the search with kMemory.
  [[nodiscard, gnu::noinline]] Result run(std::span<const OpenBox> open, const SearchState& state,
                                          Observer* observer);

 private:
  friend class BranchAndPrune<Search>;
  [[nodiscard]] bool begin_round() noexcept;
  [[nodiscard]] std::size_t decide_round() noexcept;
  [[nodiscard]] Decisions& batch(std::size_t index) noexcept { return round_.batch(index); }
  [[nodiscard]] bool conclude(Decisions& batch) noexcept;
  [[nodiscard]] bool goes_on() const noexcept { return !record_.witness.found(); }
  void give_back(Decisions& batch) noexcept;
  void settle(Decisions& batch, std::size_t lane) noexcept;
  [[nodiscard]] bool splits(const OpenBox& box) noexcept;
  [[nodiscard]] BoxId number(const OpenBox& parent, std::uint32_t variable, double at) noexcept;
  void lose(const OpenBox& first, const OpenBox& second) noexcept;
  void end_round() noexcept { record_.tell_progress(); }

  void stop_at_undecided_batch() noexcept;
  [[nodiscard]] std::uint64_t batches_of_round() const noexcept;
  [[nodiscard]] bool has_budget_for_round() const noexcept;
  void make_closed_form() noexcept;
  void load_round() noexcept;
  void load(Decisions& batch) noexcept;
  void leave(Decisions& batch, std::size_t lane) noexcept;
  [[nodiscard]] bool must_be_cut() const noexcept;
  void run_units();

  const Settings& settings_;
  const RowStructure structure_;
  SearchRecord record_;
  Round round_;
  Foresight foresight_;
  BranchAndPrune<Search> loop_;
  bool closed_form_made_ = false;
};

}  // namespace regulus::detail
