// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "codegen/use/api/check.hpp"

namespace regulus {

/// The limits of one search; 0: none, and as many threads as there are processors.
struct SearchLimits {
  std::uint64_t max_boxes = 0;
  double time_limit = 0;  ///< seconds
  unsigned threads = 0;
};

/// A question that is asked again and again, with other ranges, tolerances or thresholds. Its
/// functions are formed and compiled once; after that an answer takes the time of its boxes.
///
/// Any thread may use it, one at a time; calls wait for each other as those of check() do.
class PreparedQuestion {
 public:
  /// Prepares the question as it is. With Engine::kAuto the kernel is interpreted only if there is
  /// no compiler. Threads and errors as check(), and UsageError for a motion along way-points.
  explicit PreparedQuestion(const Question& question, const SearchOptions& options = {},
                            const std::atomic<bool>* interrupt = nullptr);
  PreparedQuestion(PreparedQuestion&&) noexcept;
  PreparedQuestion& operator=(PreparedQuestion&&) noexcept;
  ~PreparedQuestion();

  /// Answers a question that differs from the prepared one in ranges, tolerances and the threshold
  /// alone. If it has other variables (a constant that is now uncertain, a pose parameter that now
  /// has a range) or now has a threshold, it is prepared first, and kept as well. The finding has no
  /// `report` and no `json`: see describe().
  ///
  /// Ensures   the verdict is proved for the question that is asked. The boxes may be others than
  ///           those of check(), which chooses the forms of its functions for its own ranges.
  /// Throws    as check(); UsageError if another model, motion, tube or file of way-points is asked.
  [[nodiscard]] Finding check(const Question& question, const SearchLimits& limits = {},
                              const std::atomic<bool>* interrupt = nullptr);

  /// The parameters of the motion, in the order of the ranges of the next function.
  [[nodiscard]] const std::vector<std::string>& parameters() const noexcept;

  /// Answers the prepared question over other ranges of the motion's parameters: a control loop's
  /// door, without texts. `ranges[i]` is the range of parameters()[i]: exactly these doubles, in the
  /// model's unit of length, angles in radians. Tolerances and threshold are those that were
  /// prepared.
  ///
  /// Requires  as many finite ranges as parameters, none empty, within the joints' limits.
  /// Ensures   the verdict is proved for these ranges. Exact algebra and more digits than doubles
  ///           have are asked only if 4096 boxes without them prove nothing.
  /// Throws    UsageError for ranges that do not meet the requirement.
  [[nodiscard]] Result check(std::span<const Interval> ranges, const SearchLimits& limits = {},
                             const std::atomic<bool>* interrupt = nullptr);

  /// Adds the reports to a finding of check() for that question and those limits.
  void describe(const Question& question, Finding& finding, const SearchLimits& limits = {});

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace regulus
