// SPDX-License-Identifier: Apache-2.0
// Proves the claim NO SINGULARITY over one leaf of the tree, in smaller boxes where need be.
#pragma once

#include <cstdint>

#include "regulus/certificate/verifier/regularity.hpp"
#include "regulus/certificate/verifier/verify.hpp"

namespace regulus::verifier {

class LeafProver {
 public:
  /// Counts in `boxes` what the leaves are cut into.
  LeafProver(Question& question, const Variety& variety, const Options& options,
             std::uint64_t& boxes);

  /// Returns when the claim holds at every point of the box. Throws Rejection when it has been
  /// shown not to hold somewhere in the variety, Unfinished when neither has been shown.
  void prove(const Box& box);

 private:
  [[noreturn]] void give_up(const Box& leaf, const std::string& why);
  void look_for_contradiction();
  [[nodiscard]] bool certain_at_middle() const;
  [[nodiscard]] bool proved_with_more_bits(const Box& box) const;

  const Question& q_;
  const Variety& variety_;
  const Options& options_;
  RegularityTest test_;
  std::vector<Box> waiting_;
  std::uint64_t& boxes_;
  int sign_ = 0;  ///< of det A at some point of a variety without constraints
};

/// The nodes that a point's determinant and its definedness need, evaluated over a box in Arb.
struct PointValues {
  Ball determinant;  ///< of A; of J⁻¹ if there is a threshold
  std::vector<Ball> constraints;
};
/// nullopt where something is not certainly defined. The matrix must be square.
[[nodiscard]] std::optional<PointValues> values_over(const Question& question, const Box& box,
                                                     long bits);

}  // namespace regulus::verifier
