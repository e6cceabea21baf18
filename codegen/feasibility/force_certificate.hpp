// SPDX-License-Identifier: GPL-3.0-or-later
// The option --certificate of `regulus check --load` and `regulus locate --load`.
#pragma once

#include <exception>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "codegen/certificate/load_question.hpp"
#include "codegen/feasibility/feasibility_run.hpp"
#include "runtime/files/atomic_file.hpp"
#include "runtime/problem/observer.hpp"

namespace regulus::inline feasibility {

/// Returns the lines of a certificate for a split and for a leaf.
[[nodiscard]] std::string force_split_line(const Split& split);
[[nodiscard]] std::string force_leaf_line(BoxId box, Rule rule);
/// Returns the lines of the proof of INFEASIBLE.
[[nodiscard]] std::string force_witness_lines(const ForceWitness& witness);

/// Writes the tree of a search while it runs: of FEASIBLE, or of a paving. For INFEASIBLE the
/// witness takes its place.
class ForceCertificate final : public Observer {
 public:
  /// An empty `path` means no certificate. Throws FileError if the file cannot be made.
  ForceCertificate(const std::string& path, const PreparedForces& prepared, bool paves);

  /// Returns the observer of the search; nullptr if no certificate is wanted, or none can be made.
  [[nodiscard]] Observer* observer() noexcept { return file_ ? this : nullptr; }

  void on_split(const OpenBox& box, const Split& split) noexcept override;
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;

  /// Puts the file in its place if the result claims something. Throws FileError.
  void finish(const FeasibilityResult& result);

  /// Returns lines of the report; empty if no certificate was wanted.
  [[nodiscard]] std::string line() const;
  /// Adds the keys `certificate` and `certificate_obstacle` to a JSON report.
  void add_to(nlohmann::ordered_json& report) const;

 private:
  void put(const std::string& text);
  void open(const std::string& verdict);

  std::string path_;
  bool paves_;
  CertifiedLoad question_;
  std::optional<AtomicFile> file_;
  std::string lines_;  ///< not yet in the file
  std::uint64_t leaves_ = 0;
  std::exception_ptr failure_;  ///< the reason why a part of the file is missing
  std::string obstacle_;
  bool is_written_ = false;
};

}  // namespace regulus::feasibility
