// SPDX-License-Identifier: GPL-3.0-or-later
// The option --certificate of a bound of the condition number in the 2-norm.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/bound/bound_number.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/quantity/quantity.hpp"
#include "runtime/proof/tree_kept.hpp"
#include "runtime/proof/writer.hpp"

namespace regulus {

/// FILE.safe, a proof of the upper end, and FILE.singular, of the attained one. The tree of the
/// search is kept until the upper end is known.
class ConditionCertificate {
 public:
  /// `path` empty: none are wanted. `uncertain`: as for certified_question, of the search. `request`
  /// and `component` must outlive this object. Throws FileError if a file cannot be created there.
  ConditionCertificate(const std::string& path, const Request& request, const Component& component,
                       const std::set<std::string>& uncertain, const ProofPlacing& placing);

  /// Returns the observer of the search; nullptr if none is wanted.
  [[nodiscard]] Observer* observer() noexcept { return proofs_.are_wanted() ? &tree_ : nullptr; }

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
  void note_ratio();

  [[nodiscard]] const EndProofs& proofs() const noexcept { return proofs_; }

 private:
  [[nodiscard]] CertifiedQuestion question(const GiNaC::ex& number,
                                           const std::set<std::string>& uncertain) const;
  [[nodiscard]] CertifiedQuestion question_of_singularity(
      const std::set<std::string>& uncertain) const;
  [[nodiscard]] bool is_refused(const CertifiedQuestion& question, bool is_singular);
  void write_singular(const Result& result, const std::set<std::string>& uncertain);

  EndProofs proofs_;
  const Request& request_;
  const Component& component_;
  const std::set<std::string> uncertain_;
  TreeKept tree_;
};

}  // namespace regulus
