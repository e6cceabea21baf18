// SPDX-License-Identifier: Apache-2.0
// Proves leaves by a test of boxes: what it leaves open is halved.
#pragma once

#include "runtime/verifier/outside.hpp"
#include "runtime/verifier/prover.hpp"

namespace regulus::verifier {

class SplittingProver : public Prover {
 public:
  SplittingProver(const Question& question, const Variety& variety, const Options& options,
                  WorkClock& clock)
      : q_(question), variety_(variety), options_(options), clock_(clock) {}

  void begin(bool looks_for_points) final;
  void prove(const Leaf& leaf) override;

 protected:
  [[nodiscard]] virtual BoxAnswer decide(const Box& box, LeafClaim claim) = 0;
  /// After BoxAnswer::kOpen: the variable that is best to split; nullopt if none can be split.
  [[nodiscard]] virtual std::optional<std::size_t> variable_to_split(const Box& box) const = 0;
  /// Returns why a claim is false at a point of the variety; empty if this is not shown.
  [[nodiscard]] virtual std::string contradiction(const Box& point, LeafClaim claim) = 0;

 private:
  void look_for_point(const Box& box);
  void look_for_contradiction(const Box& box, LeafClaim claim);
  void look_at_corners(const Box& leaf, LeafClaim claim);

  const Question& q_;
  const Variety& variety_;
  const Options& options_;
  WorkClock& clock_;
  std::vector<Box> waiting_;
  bool looks_for_points_ = true;
  int points_tried_ = 0;
};

}  // namespace regulus::verifier
