// SPDX-License-Identifier: GPL-3.0-or-later
// What is told about forces that hold a load.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/question/load/feasibility_run.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::detail {

/// A load and the limits of the forces, for words.
struct LoadWords {
  LoadWords(const PreparedSearch& of, const std::string& name, const std::string& unit,
            const std::vector<Interval>& ranges)
      : preparation(of), load(name), force_unit(unit), limits(ranges) {}
  LoadWords(const PreparedForces& forces)
      : LoadWords(forces.preparation, forces.load, forces.force_unit, forces.limits) {}

  const PreparedSearch& preparation;
  const std::string &load, &force_unit;
  const std::vector<Interval>& limits;
};

/// Returns the claim about a box, as a sentence.
[[nodiscard]] std::string describe_claim(const LoadWords& words, ForceClaim claim);

/// Returns "within [1, 500] N", or "within their limits" if these differ.
[[nodiscard]] std::string describe_limits(const LoadWords& words);
/// Tells the load, and the limits of the forces.
void tell_load(const LoadWords& words, Facts& facts);
/// Tells people why a load is not held at a place.
void say_shortage(const PreparedForces& prepared, const ForceWitness& witness, Facts& facts);
/// Returns the claim of FEASIBLE.
[[nodiscard]] std::string describe_claim(const LoadWords& words);
/// Returns why neither answer was shown.
[[nodiscard]] std::string describe_reason(const PreparedForces& prepared,
                                          const FeasibilityResult& result);
[[nodiscard]] nlohmann::ordered_json json_witness_of(const PreparedForces& prepared,
                                                     const ForceWitness& witness);
/// Returns "feasible", "infeasible" or "possible-problem".
[[nodiscard]] const char* json_word(FeasibilityVerdict verdict) noexcept;

inline constexpr std::array kEveryForceClaim{ForceClaim::kFeasible, ForceClaim::kInfeasible,
                                             ForceClaim::kUndecided, ForceClaim::kOutside};
/// Returns the claim of Volumes and of PathStretch that stands for a claim about forces.
[[nodiscard]] Claim stand_in(ForceClaim claim) noexcept;
/// Returns the word for what it stands for.
[[nodiscard]] const char* word_of_stand_in(Claim claim) noexcept;

/// Adds up the volumes of boxes by their claims.
class ForceVolumes {
 public:
  explicit ForceVolumes(const Problem& problem) : volumes_(problem) {}
  void add(std::span<const Interval> box, ForceClaim claim) noexcept;
  [[nodiscard]] const Share& of(ForceClaim claim) const noexcept;
  /// Returns the part of the whole box, "83.1 %".
  [[nodiscard]] std::string percentage(ForceClaim claim) const;
  [[nodiscard]] Interval fraction(ForceClaim claim) const noexcept;
  /// Returns the same by the claims that stand for those about forces.
  [[nodiscard]] const Volumes& by_stand_in() const noexcept { return volumes_; }

 private:
  Volumes volumes_;
};

/// Tells how much of a motion has each claim.
void tell_volumes(const LoadWords& words, const ForceVolumes& volumes, Facts& facts);

/// Tells the question, the claim and the place where it fails; `volumes`: of a paving, or null.
void tell_forces(const PreparedForces& prepared, const FeasibilityResult& result,
                 const ForceVolumes* volumes, Facts& facts);

/// Returns the first line of a paving, and the line of a box.
[[nodiscard]] nlohmann::ordered_json json_forces_header(const LoadWords& words, double resolution);
[[nodiscard]] nlohmann::ordered_json json_forces_box(const LoadWords& words,
                                                     std::span<const Interval> box,
                                                     ForceClaim claim);

}  // namespace regulus::detail
