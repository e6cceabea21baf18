// SPDX-License-Identifier: Apache-2.0
// Proves the claim NO SINGULARITY over one leaf of the tree, in smaller boxes if necessary.
#pragma once

#include <cstdint>
#include <optional>

#include "runtime/certificate/verifier/exact_rank.hpp"
#include "runtime/certificate/verifier/regularity.hpp"
#include "runtime/certificate/verifier/verify.hpp"
#include "runtime/certificate/verifier/work_clock.hpp"

namespace regulus::verifier {

class LeafProver {
 public:
  LeafProver(Question& question, const Variety& variety, const Options& options, WorkClock& clock);

  /// Forgets what earlier leaves have shown, so that the next ones are proved in the same way after
  /// any others. `looks_for_points`: a point of the variety is wanted.
  void begin(bool looks_for_points);

  /// Returns if the claim holds at every point of the box. Throws Rejection if it is shown to be
  /// false somewhere in the variety, Unfinished if neither is shown.
  void prove(const Box& box);

  /// Returns true if some part of a leaf was not outside the variety.
  [[nodiscard]] bool has_met_variety() const noexcept { return has_met_variety_; }
  /// Returns true if a point of the variety was shown to exist.
  [[nodiscard]] bool has_met_point() const noexcept { return has_met_point_; }
  /// Returns the sign of det A at some point of the variety, if one was found: a variety without
  /// constraints has one sign only.
  [[nodiscard]] int sign() const noexcept { return sign_; }
  /// Returns the number of boxes into which the leaves since begin() were cut.
  [[nodiscard]] std::uint64_t boxes() const noexcept { return boxes_; }

 private:
  [[nodiscard]] bool is_regular_exactly(const Box& box, std::uint64_t boxes_of_leaf);
  void look_for_point();
  [[noreturn]] void give_up(const Box& leaf, const std::string& why);
  void look_for_contradiction();
  [[nodiscard]] bool certain_at_middle() const;
  [[nodiscard]] bool proved_with_more_bits(const Box& box) const;

  Question& q_;
  const Variety& variety_;
  const Options& options_;
  WorkClock& clock_;
  RegularityTest test_;
  std::optional<ExactDeterminant> exact_;  ///< made when it is first needed
  std::optional<ExactRank> exact_rank_;    ///< the same for more rows than columns
  std::vector<Box> waiting_;
  std::uint64_t boxes_ = 0;
  bool is_exact_too_large_ = false;
  bool uses_algebra_ = false;  ///< since begin(), some leaf needed it
  bool looks_for_points_ = true;
  bool has_met_variety_ = false, has_met_point_ = false;
  int points_tried_ = 0;
  int sign_ = 0;  ///< of det A at some point of a variety without constraints
};

/// The values that a point's determinant and its definedness need, over a box in Arb.
struct PointValues {
  std::vector<Ball> matrix;
  Ball determinant;  ///< of A; of J⁻¹ if there is a threshold; 0 if A is not square
  std::vector<Ball> constraints;
};
/// Returns nullopt if any of them is not certainly defined.
[[nodiscard]] std::optional<PointValues> values_over(const Question& question, const Box& box,
                                                     long bits);

}  // namespace regulus::verifier
