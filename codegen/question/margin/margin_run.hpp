// SPDX-License-Identifier: GPL-3.0-or-later
// Brackets the largest safe value: searches at one value after another, with one kernel.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "codegen/answer/report/output_options.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/margin/margin_certificates.hpp"
#include "codegen/question/margin/margin_question.hpp"
#include "runtime/problem/result.hpp"
#include "runtime/search/bracket.hpp"
#include "runtime/witness/least_witness.hpp"

namespace regulus {

/// The result at one value.
struct MarginStep {
  MarginValue value;
  Result result;
  std::string claim;
};

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

class MarginRun {
 public:
  using Listener = std::function<void(const MarginStep&)>;

  MarginRun(PreparedSearch& preparation, const MarginQuestion& question,
            const MarginRequest& request, const SearchOptions& search, const OutputOptions& output,
            const Settings& settings, double gap, MarginCertificates& certificates,
            Listener listener, EarlierSearches* earlier = nullptr);

  [[nodiscard]] Margin run();

 private:
  [[nodiscard]] bool interrupted() const noexcept;
  [[nodiscard]] Problem problem_at(const MarginValue& value);
  void look_below(const std::optional<MarginValue>& high, double limit);
  void look_for_witness(double seconds, int starts);
  bool refute_at_found();
  void close_in();
  void close_in_from_above();
  void attempt(const PlannedAttempt& planned);
  [[nodiscard]] Result search_at(const MarginValue& value, const PlannedAttempt& planned);
  void prove_remembered();
  void look_near(std::span<const Interval> box);
  void note(MarginStep step, bool is_search, std::uint64_t most_boxes = kAnyBoxes);
  [[nodiscard]] MarginValue value_of(double approx) const;

  PreparedSearch& preparation_;
  const MarginQuestion& question_;
  const MarginRequest& request_;
  const SearchOptions& search_;
  const OutputOptions& output_;
  Settings settings_;
  MarginCertificates& certificates_;
  Listener listener_;
  EarlierSearches* earlier_;
  bool is_remembered_ = false;  ///< the certified end is that of an earlier run
  Bracket bracket_;
  Problem widest_;
  std::unique_ptr<LeastWitness> witness_;
  Margin margin_;
};

}  // namespace regulus
