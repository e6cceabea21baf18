// SPDX-License-Identifier: GPL-3.0-or-later
// Brackets the largest safe value: searches at one value after another.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "codegen/question/margin/attempts.hpp"

namespace regulus::detail {

struct Margin {
  std::optional<MarginStep> certified;  ///< the largest value, with the search that certified it
  std::optional<MarginStep> refuted;    ///< the least value, with a witness
  std::optional<MarginStep> empty;      ///< the last value at which no pose remains
  std::optional<double> gap;            ///< relative
  bool closed = false;                  ///< see Bracket::closed
  bool interrupted = false;
  std::vector<MarginStep> steps;  ///< in order of time
  std::uint64_t boxes = 0;
  double seconds = 0;  ///< of search
};

/// The searches of a bracket that an earlier run has made. Their outcomes choose the next values,
/// so that this run goes the same way, but no end is reported before this run has proved it, too.
class EarlierSearches {
 public:
  EarlierSearches() = default;
  EarlierSearches(const EarlierSearches&) = delete;
  EarlierSearches& operator=(const EarlierSearches&) = delete;
  virtual ~EarlierSearches() = default;

  /// Returns the outcome of the search at a value that was allowed so many boxes: NO SINGULARITY, or
  /// POSSIBLE PROBLEM for a reason that is not the time's; nullopt if there was none.
  [[nodiscard]] virtual std::optional<Result> find(const MarginValue& value,
                                                   std::uint64_t most_boxes) const = 0;
  /// Keeps the outcome of a search of this run.
  virtual void keep(const MarginValue& value, std::uint64_t most_boxes, const Result& result) = 0;
  /// The search at this value does not end as the earlier one. Throws InputError.
  [[noreturn]] virtual void refuse(const MarginValue& value) const = 0;
};

struct BracketSettings {
  Bracket::Limits limits{};
  const std::atomic<bool>* interrupt = nullptr;
  StepListener listener{};             ///< called after each step; empty: none
  EarlierSearches* earlier = nullptr;  ///< null: none
};

/// Approaches the largest safe value of the question from both sides. Throws what the attempts and
/// the listener throw.
[[nodiscard]] Margin close_bracket(Attempts& attempts, const MarginQuestion& question,
                                   const BracketSettings& settings);

/// Returns why the last search that decided nothing did so; empty if its limits ended it, or if each
/// search decided something.
[[nodiscard]] std::string obstacle_of(const Margin& margin);

}  // namespace regulus::detail
