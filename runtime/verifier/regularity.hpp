// SPDX-License-Identifier: Apache-2.0
// The test that every matrix over a box has full column rank. PROOF.md, "The test", derives it.
#pragma once

#include "runtime/verifier/outside.hpp"
#include "runtime/verifier/touched_rows.hpp"

namespace regulus::verifier {

class RegularityTest {
 public:
  /// Adds derivatives to the question's graph.
  RegularityTest(Question& question, const Variety& variety);

  enum class Answer {
    kOutside,  ///< no point of the box is in the variety, because of a constraint or a ball
    kRegular,  ///< at every point the model is defined, and the claim NO SINGULARITY holds
    kOpen,     ///< neither has been shown
  };
  [[nodiscard]] Answer decide(const Box& box);

  /// After kOpen: true if every expression that must have a value has one all over the box.
  [[nodiscard]] bool is_defined() const noexcept { return is_defined_; }
  /// After kOpen: returns the variable that is best to split; nullopt if none can be split.
  [[nodiscard]] std::optional<std::size_t> variable_to_split(const Box& box) const;

  /// After kOpen: returns the sign of det A at the middle of the box, 0 if it is not known.
  [[nodiscard]] int sign_at_middle() const;
  [[nodiscard]] const Box& middle() const noexcept { return middle_.point; }

 private:
  void place_middle(const Box& box);
  [[nodiscard]] bool is_regular();
  [[nodiscard]] bool is_regular_without_derivatives();
  [[nodiscard]] bool exceeds_threshold() const;
  [[nodiscard]] bool exceeds_threshold(Interval bound, Interval determinant_of_K) const;
  [[nodiscard]] Interval determinant_of_K() const;
  [[nodiscard]] std::vector<double> impacts() const;

  Question& q_;
  const Variety& variety_;
  MovingInverse inverse_;
  TouchedRows rows_;
  Evaluation over_box_;
  Outside outside_;
  Domination of_motion_, of_rows_;

  // For one box.
  bool is_defined_ = false;
  enum class Stage {
    kNothing,
    kMotion,
    kRows
  } stage_ = Stage::kNothing;  ///< the last that has been bounded
  Middle middle_;
  Box thin_;      ///< at the middle except in the moving variables
  Matrix K_, P_;  ///< without derivatives: |K·A − I| ≤ P
};

}  // namespace regulus::verifier
