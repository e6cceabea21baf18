// SPDX-License-Identifier: Apache-2.0
// A bound of |f| over a box from the point where it is least: exact ends of ranges if f is
// monotone, a point to thousands of bits if it is convex. PROOF.md, "The exact determinant".
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/verifier/variety.hpp"

namespace regulus::verifier {

/// One expression in Arb, separated from the rest of its graph.
class BallExpression {
 public:
  BallExpression(const Graph& graph, NodeId root);
  /// Returns nullptr unless every operation is defined at every point of `variables`.
  [[nodiscard]] const Ball* run(const std::vector<Ball>& variables, long bits);
  [[nodiscard]] const std::vector<std::size_t>& variables() const noexcept { return variables_; }

 private:
  const Graph& graph_;
  std::vector<Node> steps_;  ///< operands by their places in this list
  std::vector<Ball> values_;
  std::vector<std::size_t> variables_;
};

/// An expression with the derivatives that have been requested.
struct DeterminantForm {
  DeterminantForm(Question& question, NodeId expression)
      : graph(question.graph),
        root(expression),
        natural(question, {expression}),
        value(question.graph, expression) {}

  [[nodiscard]] BallExpression& first(std::size_t k);
  [[nodiscard]] BallExpression& second(std::size_t k, std::size_t l);

  Graph& graph;
  NodeId root;
  Evaluation natural;
  BallExpression value;
  std::map<std::size_t, std::pair<NodeId, BallExpression>> gradient;
  std::map<std::pair<std::size_t, std::size_t>, BallExpression> hessian;
};

/// The ends of the ranges and the threshold, as expressions.
struct ExactBounds {
  explicit ExactBounds(const Question& question);

  std::vector<BallExpression> lower, upper;  ///< by variable
  BallExpression alpha;
};

class Extremum {
 public:
  Extremum(const Variety& variety, ExactBounds& bounds, DeterminantForm& form, const Box& box,
           long max_bits)
      : variety_(variety), bounds_(bounds), form_(form), box_(box), max_bits_(max_bits) {}

  /// Ensures   true only if |f| > alpha at every point of the set in the box.
  [[nodiscard]] bool exceeds();

 private:
  enum class Place { kFree, kLower, kUpper };

  [[nodiscard]] Ball end_of(std::size_t k, bool upper, long bits) const;
  [[nodiscard]] Ball range_of(std::size_t k, long bits, bool widened) const;
  [[nodiscard]] std::vector<Ball> ranges(long bits, bool widened) const;
  [[nodiscard]] int sign_in_the_middle();
  /// Moves variables in which f is monotone to their ends. Returns false if nothing can be said.
  [[nodiscard]] bool move_to_ends();
  [[nodiscard]] bool exceeds_at_point(const std::vector<Ball>& point, const Ball& loss, long bits);
  [[nodiscard]] bool exceeds_at_ends();
  [[nodiscard]] bool exceeds_where_convex();
  [[nodiscard]] bool find_curvature(bool widened);
  [[nodiscard]] bool improve(std::vector<Ball>& point, long bits);
  [[nodiscard]] std::optional<Ball> loss_at(const std::vector<Ball>& point, long bits);

  const Variety& variety_;
  ExactBounds& bounds_;
  DeterminantForm& form_;
  const Box& box_;
  const long max_bits_;
  int sign_ = 0;
  std::vector<Place> place_;       ///< by variable
  std::vector<std::size_t> free_;  ///< variables of f that are not at an end
  std::vector<double> curvature_;  ///< of free_: f − Σ ½ curvature·x² is convex
  bool widened_ = false;
};

}  // namespace regulus::verifier
