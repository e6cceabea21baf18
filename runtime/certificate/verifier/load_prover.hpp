// SPDX-License-Identifier: Apache-2.0
// Proves leaves of claims about forces that hold a load, in smaller boxes if necessary.
#pragma once

#include "runtime/certificate/verifier/load_test.hpp"
#include "runtime/certificate/verifier/prover.hpp"

namespace regulus::verifier {

class LoadProver final : public Prover {
 public:
  LoadProver(Question& question, const Variety& variety, const Options& options, WorkClock& clock)
      : q_(question),
        variety_(variety),
        options_(options),
        clock_(clock),
        test_(question, variety) {}

  void begin(bool looks_for_points) override;
  void prove(const Box& box, LeafClaim claim) override;

 private:
  void look_for_point();
  void look_for_contradiction(const Box& box, LoadTest::Claim claim);

  const Question& q_;
  const Variety& variety_;
  const Options& options_;
  WorkClock& clock_;
  LoadTest test_;
  std::vector<Box> waiting_;
  bool looks_for_points_ = true;
  int points_tried_ = 0;
};

}  // namespace regulus::verifier
