// SPDX-License-Identifier: GPL-3.0-or-later
// The option --certificate of a bound of the condition number in the 2-norm.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/bound/bound_number.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "codegen/question/quantity/quantity.hpp"
#include "codegen/question/way/path_trees.hpp"
#include "runtime/proof/writer.hpp"

namespace regulus::detail {

/// A place in the variables of a certificate; of a trajectory: of that about one piece.
struct ConditionPlace {
  std::vector<Interval> variables;
  std::size_t piece = 0;
};

/// FILE.safe, a proof of the upper end, and FILE.singular, of the attained one. The tree of the
/// search is kept until the upper end is known.
class ConditionCertificate {
 public:
  /// `path` empty: none are wanted. `uncertain`: as for certified_question, of the search. `request`
  /// and `component` must outlive this object. Throws FileError if a file cannot be created there.
  ConditionCertificate(const std::string& path, const Request& request, const Component& component,
                       const std::set<std::string>& uncertain, const ProofPlacing& placing);

  /// Returns the observer of the search; nullptr if none is wanted.
  [[nodiscard]] Observer* observer() noexcept;

  // These throw FileError.

  /// κ is below the number in every leaf.
  void prove(const BoundEnd& end);
  /// κ is at least the number there.
  void attain(const BoundEnd& end, const ConditionPlace& place);
  /// The matrix is singular. `uncertain`: of the search that shows it, on a piece of a trajectory.
  void show_singular(const Result& result, const std::set<std::string>& uncertain,
                     std::size_t piece);
  /// The same at a place, where a vector v ≠ 0 has Av = 0.
  void show_singular(const ConditionPlace& place);

  /// The upper end is the ratio of the bounds of singular values.
  void note_ratio();

  [[nodiscard]] const EndProofs& proofs() const noexcept { return proofs_; }

 private:
  /// Returns the claim of κ and a number; 0 means that the matrix is singular.
  [[nodiscard]] CertifiedAbout about(const GiNaC::ex& number) const;
  [[nodiscard]] CertifiedQuestion on_piece(std::size_t piece, const CertifiedAbout& about,
                                           const std::set<std::string>& uncertain) const;
  [[nodiscard]] std::shared_ptr<ProofFile> proof_of_tree(const std::string& head) const;
  [[nodiscard]] bool is_refused(const CertifiedQuestion& question, bool is_singular);

  EndProofs proofs_;
  const Request& request_;
  const Component& component_;
  const std::set<std::string> uncertain_;
  TreeKept tree_;
  std::optional<PathTrees> pieces_;  ///< of a trajectory
};

}  // namespace regulus::detail
