// SPDX-License-Identifier: GPL-3.0-or-later
// The option --certificate of `regulus check --load` and `regulus locate --load`.
#pragma once

#include <optional>
#include <string>

#include "codegen/answer/certificate/load_question.hpp"
#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/load/feasibility_run.hpp"
#include "codegen/question/load/way_forces.hpp"
#include "runtime/proof/proof_file.hpp"

namespace regulus::detail {

/// Writes the tree of a search while it runs: of FEASIBLE, or of a paving. For INFEASIBLE the
/// witness takes its place.
class ForceCertificate final : public Observer {
 public:
  /// An empty `path` means no certificate. `shard_size`: as ProofFile::set_shard_size. Throws
  /// FileError if the file cannot be made.
  ForceCertificate(const std::string& path, const PreparedForces& prepared, bool paves,
                   std::uint64_t shard_size);

  /// Returns the observer of the search; nullptr if no certificate is wanted, or none can be made.
  [[nodiscard]] Observer* observer() noexcept { return file_ ? this : nullptr; }

  void on_split(const OpenBox& box, const Split& split) noexcept override;
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;

  /// Puts the file in its place if the result claims something. If this fails, status() says so.
  void finish(const FeasibilityResult& result);

  [[nodiscard]] const ProofStatus& status() const noexcept { return status_; }

 private:
  void write(const FeasibilityResult& result);

  const bool paves_;
  ProofStatus status_;
  CertifiedLoad question_;
  std::optional<ProofFile> file_;
};

/// Writes the proof of a verdict along way-points: of all pieces, or of the pose on one of them. An
/// empty `path` means no certificate.
[[nodiscard]] ProofStatus certify_way_forces(const std::string& path, const WayForces& found,
                                             const ProofPlacing& placing);

}  // namespace regulus::detail
