// SPDX-License-Identifier: GPL-3.0-or-later
// The searches of a bracket about a set of poses, with one kernel.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "codegen/answer/report/output_options.hpp"
#include "codegen/question/margin/attempts.hpp"
#include "codegen/question/margin/margin_certificates.hpp"
#include "codegen/question/margin/prepared_margin.hpp"
#include "runtime/witness/least_witness.hpp"

namespace regulus::detail {

class VarietyAttempts final : public Attempts {
 public:
  /// `margin` is prepared for `question`; both live as long as this. `proofs`: of the ends at which
  /// the run stops.
  VarietyAttempts(PreparedMargin& margin, const MarginQuestion& question,
                  const OutputOptions& output, EndProofs proofs = {});

  [[nodiscard]] MarginStep at(const MarginValue& value, const PlannedAttempt& planned) override;
  [[nodiscard]] std::vector<MarginStep> beforehand(double seconds) override;
  [[nodiscard]] bool can_look() const noexcept override { return witness_ != nullptr; }
  [[nodiscard]] std::vector<MarginStep> near(const Result& ended, Refuted refuted) override;
  [[nodiscard]] std::vector<MarginStep> everywhere(double seconds, Refuted refuted) override;

  [[nodiscard]] const EndProofs& proofs() const noexcept { return certificates_.proofs(); }

 private:
  [[nodiscard]] Problem problem_at(const MarginValue& value);
  [[nodiscard]] double end() const;
  void look_up_to(const std::optional<MarginValue>& high, double seconds,
                  std::vector<MarginStep>& found);
  void look_everywhere(double seconds, int starts, std::vector<MarginStep>& found);
  void look_near(std::span<const Interval> box, std::vector<MarginStep>& found);
  void refute_at_found(std::vector<MarginStep>& found);

  PreparedMargin& margin_;
  const MarginQuestion& question_;
  const OutputOptions& output_;
  MarginCertificates certificates_;
  Refuted refuted_;
  Problem widest_;
  std::unique_ptr<LeastWitness> witness_;
};

/// Returns the limits of a bracket in the time and with the boxes of its searches.
[[nodiscard]] Bracket::Limits limits_of(const Settings& settings, double gap);

}  // namespace regulus::detail
