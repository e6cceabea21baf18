// SPDX-License-Identifier: GPL-3.0-or-later
// The option --certificate of a bound of the condition number in the 2-norm.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "codegen/bound/bound_number.hpp"
#include "codegen/engine/pipeline.hpp"
#include "codegen/margin/end_proofs.hpp"
#include "codegen/quantity/quantity.hpp"
#include "runtime/certificate/writer.hpp"

namespace regulus::inline bounding {

/// FILE.safe, a proof of the upper end, and FILE.singular, of the attained one. The tree of the search
/// is kept until the upper end is known: 24 bytes for each box.
class ConditionCertificate final : public Observer {
 public:
  /// `path` empty: none are wanted. `uncertain`: as for certified_question, of the search. The others
  /// must outlive this object. Throws FileError if a file cannot be created there.
  ConditionCertificate(std::string path, const Request& request, const Component& component,
                       const std::set<std::string>& uncertain);

  /// Returns the observer of the search; nullptr if none is wanted.
  [[nodiscard]] Observer* observer() noexcept { return path_.empty() ? nullptr : this; }
  void on_split(const OpenBox& box, const Split& split) noexcept override;
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;

  // These throw FileError.

  /// κ is below the number in every leaf.
  void prove(const BoundEnd& end);
  /// κ is at least the number at a point.
  void attain(const BoundEnd& end, const std::vector<Interval>& variables);
  /// The matrix is singular. `uncertain`: of the search that shows it.
  void show_singular(const Result& result, const std::set<std::string>& uncertain);
  /// The same at a point, where a vector v ≠ 0 has Av = 0.
  void show_singular(const std::vector<Interval>& variables);

  /// The upper end is the ratio of the bounds of singular values.
  void note_ratio() noexcept { is_ratio_ = true; }

  /// Returns what has been written, for the reports.
  [[nodiscard]] EndProofs proofs() const;

 private:
  struct Event {
    BoxId box;
    double at = 0;               ///< of a split
    std::uint32_t variable = 0;  ///< the same
    Rule rule = Rule::kBlocked;  ///< of a leaf; kBlocked: it is a split
  };

  [[nodiscard]] CertifiedQuestion question(const GiNaC::ex& number,
                                           const std::set<std::string>& uncertain) const;
  [[nodiscard]] CertifiedQuestion question_of_singularity(
      const std::set<std::string>& uncertain) const;
  [[nodiscard]] bool is_refused(const CertifiedQuestion& question, bool is_singular);
  void write_singular(const Result& result, const std::set<std::string>& uncertain);

  const std::string path_;
  const Request& request_;
  const Component& component_;
  const std::set<std::string> uncertain_;
  std::vector<Event> events_;
  bool is_out_of_memory_ = false, is_ratio_ = false;
  EndProof safe_, singular_;  ///< without a file: not written
  std::string obstacle_;      ///< why this question can have no certificate
};

}  // namespace regulus::bounding
