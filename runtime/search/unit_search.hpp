// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "runtime/cluster/unit.hpp"
#include "runtime/cluster/workers.hpp"
#include "runtime/search/branch_and_prune.hpp"
#include "runtime/search/decider.hpp"
#include "runtime/search/unit_events.hpp"
#include "runtime/witness/witness_search.hpp"

namespace regulus::detail {

/// Decides units of a search by Algorithm 1, each up to a fixed number of boxes.
///
/// Every unit starts from what the search had learned before its first unit. A unit ends early if a
/// singularity is proved or, unless the search is exhaustive, if a box cannot be decided.
class UnitSearch final : public cluster::UnitDecider {
 public:
  using Clock = std::chrono::steady_clock;

  /// All must outlive this object. `witness` is set to what was learned before each unit; after an
  /// outcome of kind kWitness it has the proof. `stop`: true ends the work soon.
  UnitSearch(const Problem& problem, const Settings& settings, const RowStructure& structure,
             const cluster::Learned& learned, WitnessSearch& witness, const std::atomic<bool>& stop,
             Clock::time_point deadline = Clock::time_point::max());

  [[nodiscard]] std::optional<std::string> decide(const cluster::Unit& unit) override;

 private:
  friend class BranchAndPrune<UnitSearch>;
  [[nodiscard]] bool begin_round() noexcept;
  [[nodiscard]] std::size_t decide_round() noexcept;
  [[nodiscard]] Decisions& batch(std::size_t) noexcept { return batch_; }
  [[nodiscard]] bool conclude(Decisions& batch) noexcept;
  [[nodiscard]] bool goes_on() const noexcept { return !witness_.found(); }
  void give_back(Decisions& batch) noexcept;
  void settle(Decisions& batch, std::size_t lane) noexcept;
  [[nodiscard]] bool splits(const OpenBox&) const noexcept { return true; }
  [[nodiscard]] BoxId number(const OpenBox& parent, std::uint32_t variable, double at) noexcept;
  void lose(const OpenBox&, const OpenBox&) noexcept { memory_exhausted_ = true; }
  void end_round() const noexcept {}

  void load(const cluster::Unit& unit);
  void record(Decisions& batch, std::size_t lane) noexcept;
  void note_start(Decisions& batch) noexcept;
  [[nodiscard]] bool must_stop() const noexcept;
  [[nodiscard]] cluster::Outcome outcome() const;
  void add_groups(const std::vector<BoxId>& open, cluster::Outcome& outcome) const;

  const Problem& problem_;
  const Settings& settings_;
  const cluster::Learned& learned_;
  const std::atomic<bool>& stop_;
  const Clock::time_point deadline_;
  const std::size_t splittable_;
  WitnessSearch& witness_;
  Decider decider_;
  Decisions batch_;
  Frontier frontier_;
  BranchAndPrune<UnitSearch> loop_;
  UnitTree tree_;
  AdaptiveThreshold threshold_;
  std::size_t roots_ = 0;
  std::uint64_t boxes_ = 0, probes_in_boxes_ = 0, probes_before_ = 0;
  std::vector<Interval> start_, box_;
  bool blocked_ = false, stopped_ = false, memory_exhausted_ = false;
};

/// Returns how many variables differ between the boxes of a search: the first ones.
[[nodiscard]] std::size_t splittable_variables(const Problem& problem,
                                               const Settings& settings) noexcept;

}  // namespace regulus::detail
