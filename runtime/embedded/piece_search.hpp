// SPDX-License-Identifier: Apache-2.0
// A search of a piece of a variety; it owns all its memory from the start.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "runtime/embedded/checker.hpp"
#include "runtime/search/branch_and_prune.hpp"
#include "runtime/search/decider.hpp"
#include "runtime/search/frontier.hpp"
#include "runtime/witness/witness_search.hpp"

namespace regulus::detail {

/// Implements Checker; checker.hpp has the contracts.
class PieceSearch {
  static constexpr std::size_t kFirstSplits = 3;  ///< give kLanes boxes

 public:
  PieceSearch(const regulus_kernel& kernel, std::span<const Interval> ranges, unsigned max_boxes,
              double alpha = 0.0);
  PieceSearch(const PieceSearch&) = delete;
  PieceSearch& operator=(const PieceSearch&) = delete;

  [[nodiscard]] Check check(std::span<const Interval> piece) noexcept;

  [[nodiscard]] const regulus_kernel& kernel() const noexcept { return *problem_.kernel; }

 private:
  [[nodiscard]] Check search(std::span<const Interval> piece) noexcept;
  void learn_easy_widths() noexcept;
  [[nodiscard]] bool all_easy(std::size_t test, double width) noexcept;
  void load_frontier(std::span<const Interval> piece) noexcept;
  void push(std::span<const Interval> box) noexcept;
  void push_parts(std::size_t split) noexcept;
  friend class BranchAndPrune<PieceSearch>;
  [[nodiscard]] bool begin_round() noexcept;
  [[nodiscard]] std::size_t decide_round() noexcept;
  [[nodiscard]] Decisions& batch(std::size_t) noexcept { return batch_; }
  [[nodiscard]] bool conclude(Decisions& batch) noexcept;
  [[nodiscard]] bool goes_on() const noexcept { return !stopped_; }
  void give_back(Decisions&) noexcept {}  // every batch is decided
  void look_for_witness(Decisions& batch) noexcept;
  void settle(Decisions& batch, std::size_t lane) noexcept;
  [[nodiscard]] bool splits(const OpenBox&) const noexcept { return true; }
  [[nodiscard]] BoxId number(const OpenBox& parent, std::uint32_t variable, double at) noexcept;
  void lose(const OpenBox& first, const OpenBox& second) noexcept;
  void end_round() const noexcept {}
  void stop_at(Reason reason, std::span<const Interval> box) noexcept;

  const Problem problem_;
  const Settings settings_;
  const RowStructure structure_;
  const unsigned max_boxes_;
  Decider decider_;
  Decisions batch_;
  WitnessSearch witness_;
  Frontier frontier_;
  BranchAndPrune<PieceSearch> loop_;
  AdaptiveThreshold threshold_;
  std::array<std::uint32_t, kFirstSplits> first_splits_{};  ///< variables, of the whole ranges
  std::size_t known_splits_ = 0;
  bool learns_splits_ = true;
  std::array<double, kMaxEasyTests> easy_width_{};  ///< relative: boxes up to it are easy
  std::vector<Interval> half_, piece_, places_;
  Check check_;  ///< the current one
  unsigned boxes_ = 0;
  bool stopped_ = false;  ///< check_ is the answer
  bool looked_inside_ = false;
  bool certified_ = false;  ///< some box that the constraints do not exclude passed a test
};

}  // namespace regulus::detail
