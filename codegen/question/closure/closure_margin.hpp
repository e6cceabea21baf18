// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a closure at one value after another, for a bracket.
#pragma once

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/answer/report/output_options.hpp"
#include "codegen/question/closure/closure_way.hpp"
#include "codegen/question/margin/attempts.hpp"

namespace regulus::detail {

/// A check at one value: of a branch over ranges.
struct CheckedBranch {
  PreparedClosure prepared;
  ClosureFinding found;

  /// `topic`: of the value. `progress` may be null.
  CheckedBranch(Request request, const SearchOptions& search, const FormingWatch& watch,
                Observer* progress, const SearchTopic& topic);
  [[nodiscard]] Result result() const;
  [[nodiscard]] std::string claim() const;
  /// Writes the proof of the verdict, if there is one.
  [[nodiscard]] ProofStatus certify(const std::string& path, const ProofPlacing& placing) const;
};

/// The same of a branch along way-points.
struct CheckedBranchOnWay {
  PreparedWay prepared;
  WayFinding found;

  CheckedBranchOnWay(Request request, const SearchOptions& search, const FormingWatch& watch,
                     Observer* progress, const SearchTopic& topic);
  [[nodiscard]] Result result() const { return found.result; }
  [[nodiscard]] std::string claim() const;
  [[nodiscard]] ProofStatus certify(const std::string& path, const ProofPlacing& placing) const;
};

/// At a value that is not safe the branch reaches a singular configuration.
template <class Checked>
class ClosureAttempts final : public Attempts {
 public:
  /// `proofs`: of both ends. The references must outlive this object.
  ClosureAttempts(const MarginRequest& request, const SearchOptions& search,
                  const OutputOptions& output, const std::atomic<bool>* interrupt, EndProofs proofs)
      : request_(request),
        search_(search),
        output_(output),
        interrupt_(interrupt),
        proofs_(std::move(proofs)) {}

  [[nodiscard]] MarginStep at(const MarginValue& value, const PlannedAttempt& planned) override;

  [[nodiscard]] const EndProofs& proofs() const { return proofs_; }
  /// The last check, and the last one that was not safe.
  [[nodiscard]] const std::optional<Checked>& last() const { return last_; }
  [[nodiscard]] const std::optional<Checked>& refuted() const { return refuted_; }

 private:
  void certify(const MarginValue& value, const Checked& checked, Verdict verdict);

  const MarginRequest& request_;
  const SearchOptions& search_;
  const OutputOptions& output_;
  const std::atomic<bool>* const interrupt_;
  EndProofs proofs_;
  std::optional<Checked> last_, refuted_;
};

}  // namespace regulus::detail
