// SPDX-License-Identifier: GPL-3.0-or-later
// The searches of a bracket about all pieces of a trajectory.
#pragma once

#include <atomic>
#include <optional>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/answer/report/output_options.hpp"
#include "codegen/question/margin/attempts.hpp"
#include "codegen/question/way/trajectory_run.hpp"

namespace regulus::detail {

class PathAttempts final : public Attempts {
 public:
  /// `request`: its motion has a trajectory; it lives as long as this. `proofs`: of the ends at
  /// which the run stops. `topic`: of the question at all values.
  PathAttempts(const MarginRequest& request, SearchOptions search, const OutputOptions& output,
               const std::atomic<bool>* interrupt, EndProofs proofs = {}, SearchTopic topic = {});

  /// Throws    as check_trajectory(); FileError.
  [[nodiscard]] MarginStep at(const MarginValue& value, const PlannedAttempt& planned) override;

  /// Returns the check at the least value that is not safe; nullopt if there is none.
  [[nodiscard]] std::optional<TrajectoryCheck> take_refuted() { return std::move(refuted_); }
  /// Returns the last of the other checks; nullopt if there is none.
  [[nodiscard]] std::optional<TrajectoryCheck> take_last() { return std::move(last_); }
  /// Returns the time of all checks.
  [[nodiscard]] const StageSeconds& seconds() const noexcept { return seconds_; }
  [[nodiscard]] const EndProofs& proofs() const noexcept { return proofs_; }

 private:
  void certify(const MarginValue& value, const TrajectoryCheck& check);

  const MarginRequest& request_;
  const SearchOptions search_;
  const OutputOptions output_;
  const std::atomic<bool>* const interrupt_;
  EndProofs proofs_;
  SearchTopic topic_;
  std::optional<TrajectoryCheck> refuted_, last_;
  StageSeconds seconds_;
};

/// Returns the limits of a bracket of such searches.
[[nodiscard]] Bracket::Limits limits_of(const SearchOptions& search, double gap);

}  // namespace regulus::detail
