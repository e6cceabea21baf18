// SPDX-License-Identifier: GPL-3.0-or-later
// Reports about forces that hold a load, for people and for programs.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/question/load/feasibility_run.hpp"
#include "runtime/search/paving.hpp"

namespace regulus {

/// Returns the claim about a box, as a sentence.
[[nodiscard]] std::string describe_claim(const PreparedForces& prepared, ForceClaim claim);

/// Returns "within [1, 500] N", or "within their limits" if these differ.
[[nodiscard]] std::string describe_limits(const PreparedForces& prepared);
/// Returns the lines about a place where a load is not held.
[[nodiscard]] std::string format_shortage(const PreparedForces& prepared,
                                          const ForceWitness& witness);
/// Returns why neither answer was shown.
[[nodiscard]] std::string describe_reason(const PreparedForces& prepared,
                                          const FeasibilityResult& result);
[[nodiscard]] nlohmann::ordered_json json_witness_of(const PreparedForces& prepared,
                                                     const ForceWitness& witness);
[[nodiscard]] nlohmann::ordered_json json_limits(const PreparedForces& prepared);
/// Returns "feasible", "infeasible" or "possible-problem".
[[nodiscard]] const char* json_word(FeasibilityVerdict verdict) noexcept;

/// Adds up the volumes of boxes by their claims.
class ForceVolumes {
 public:
  explicit ForceVolumes(const Problem& problem) : volumes_(problem) {}
  void add(std::span<const Interval> box, ForceClaim claim) noexcept;
  [[nodiscard]] const Share& of(ForceClaim claim) const noexcept;
  /// Returns the part of the whole box, "83.1 %".
  [[nodiscard]] std::string percentage(ForceClaim claim) const;
  [[nodiscard]] Interval fraction(ForceClaim claim) const noexcept;

 private:
  Volumes volumes_;
};

/// Returns the report but for the verdict; `volumes`: of a paving, or null.
[[nodiscard]] std::string format_forces(const PreparedForces& prepared,
                                        const FeasibilityResult& result,
                                        const ForceVolumes* volumes);

/// Returns the JSON report.
[[nodiscard]] nlohmann::ordered_json json_forces(const PreparedForces& prepared,
                                                 const FeasibilityResult& result,
                                                 const ForceVolumes* volumes);

/// Returns the first line of a paving, and the line of a box.
[[nodiscard]] nlohmann::ordered_json json_forces_header(const PreparedForces& prepared,
                                                        double resolution);
[[nodiscard]] nlohmann::ordered_json json_forces_box(const PreparedForces& prepared,
                                                     std::span<const Interval> box,
                                                     ForceClaim claim);

}  // namespace regulus
