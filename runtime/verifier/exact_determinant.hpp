// SPDX-License-Identifier: Apache-2.0
// The determinant, multiplied out exactly. It can decide boxes that intervals of doubles cannot
// decide. PROOF.md, "The exact determinant", derives the bounds.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/extremum.hpp"
#include "runtime/verifier/univariate.hpp"
#include "runtime/verifier/variety.hpp"

namespace regulus::verifier {

class ExactDeterminant {
 public:
  /// Multiplies out det A; times all scales if there is a threshold. Adds to the question's graph.
  /// Requires a square matrix.
  ExactDeterminant(Question& question, const Variety& variety, long max_bits)
      : ExactDeterminant(question, variety, question.matrix, max_bits) {}
  /// Multiplies out the determinant of another square matrix with as many columns as A.
  ExactDeterminant(Question& question, const Variety& variety, const std::vector<NodeId>& matrix,
                   long max_bits);

  /// Returns true only if the determinant is 0 wherever the matrix is defined.
  [[nodiscard]] bool vanishes() const noexcept { return vanishes_; }
  /// Returns why it could not be multiplied out; empty if it could.
  [[nodiscard]] const std::string& obstacle() const noexcept { return obstacle_; }

  /// Ensures   true only if its magnitude exceeds alpha at every point of the set in the box.
  /// Requires  the matrix is defined all over the box.
  [[nodiscard]] bool exceeds_threshold(const Box& box);

 private:
  using Form = DeterminantForm;
  [[nodiscard]] bool exceeds_naturally(Form& form, const Box& box);
  [[nodiscard]] bool exceeds_in_one_variable(const Box& box) const;
  [[nodiscard]] bool exceeds_at_extremum(const Box& box);
  /// Uses forms g (see Reduced) in which terms that a constraint shares with det are gone.
  [[nodiscard]] bool exceeds_within_constraints(const Box& box);
  void reduce_by_constraints(Algebra& algebra, const Polynomial& determinant);

  [[nodiscard]] std::unique_ptr<Form> form_of(Algebra& algebra, const std::vector<NodeId>& matrix);

  Question& q_;
  const Variety& variety_;
  const long max_bits_;
  bool vanishes_ = false;
  bool has_few_terms_ = false;  ///< of the full form: it is differentiated
  std::string obstacle_;
  ExactBounds bounds_;
  std::unique_ptr<Form> plain_, full_;
  /// g = f + λh for a constraint h ≤ 0. Where h ≤ 0, f ≥ g if λ > 0, and f ≤ g if λ < 0.
  struct Reduced {
    std::unique_ptr<Form> form;
    bool from_below;
  };
  std::vector<Reduced> reduced_;
  std::optional<Rational> alpha_;
  std::optional<std::size_t> only_;  ///< the one variable of `polynomial_`
  Univariate polynomial_;
};

}  // namespace regulus::verifier
