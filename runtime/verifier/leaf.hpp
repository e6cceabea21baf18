// SPDX-License-Identifier: Apache-2.0
// Proves the claim NO SINGULARITY over one leaf of the tree, in smaller boxes if necessary.
#pragma once

#include <optional>

#include "runtime/verifier/exact_rank.hpp"
#include "runtime/verifier/prover.hpp"
#include "runtime/verifier/regularity.hpp"

namespace regulus::verifier {

class LeafProver final : public Prover {
 public:
  LeafProver(Question& question, const Variety& variety, const Options& options, WorkClock& clock);

  void begin(bool looks_for_points) override;
  void prove(const Leaf& leaf) override;

 private:
  [[nodiscard]] bool is_regular_exactly(const Box& box, std::uint64_t boxes_of_leaf);
  [[nodiscard]] bool is_proved_by_algebra(const Box& box);
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
  bool is_exact_too_large_ = false;
  bool uses_algebra_ = false;  ///< since begin(), some leaf needed it
  int useless_algebra_ = 0;    ///< since begin(), boxes that it did not prove
  bool looks_for_points_ = true;
  int points_tried_ = 0;
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
