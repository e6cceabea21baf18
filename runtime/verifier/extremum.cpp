// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/extremum.hpp"

#include <algorithm>

#include "runtime/verifier/ball_matrix.hpp"
#include "runtime/verifier/derivative.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfExtremum = 128;
constexpr std::size_t kMostFree = 8;  ///< most variables of a convex bound
constexpr int kFirstSteps = 8;        ///< of Newton's method
constexpr long kWithin = 1 << 24;     ///< a point stays inside by this fraction of the radius

}  // namespace

BallExpression::BallExpression(const Graph& graph, NodeId root) : graph_(graph) {
  std::map<NodeId, int> places;
  for (const NodeId id : ingredients(graph, {root})) {
    Node node = graph.nodes()[std::size_t(id)];
    if (node.op == Op::kVariable) variables_.push_back(std::size_t(node.a));
    if (operands(node.op) > 0) node.a = places.at(node.a);
    if (operands(node.op) > 1) node.b = places.at(node.b);
    places.emplace(id, int(steps_.size()));
    steps_.push_back(node);
  }
  values_.resize(steps_.size());
}

const Ball* BallExpression::run(const std::vector<Ball>& variables, long bits) {
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Node& node = steps_[i];
    Ball& value = values_[i];
    if (!certain_defined(node, values_, bits)) return nullptr;
    if (node.op == Op::kConstant)
      arb_set_fmpq(value.get(), graph_.rational(node.a).get(), bits);
    else if (node.op == Op::kPi)
      arb_const_pi(value.get(), bits);
    else if (node.op == Op::kVariable)
      value = variables[std::size_t(node.a)];
    else
      compute(node, values_, value.get(), bits);
    if (!arb_is_finite(value.get())) return nullptr;
  }
  return &values_.back();
}

ExactBounds::ExactBounds(const Question& question) : alpha(question.graph, question.alpha) {
  for (const Variable& v : question.variables) {
    lower.emplace_back(question.graph, v.lo);
    upper.emplace_back(question.graph, v.hi);
  }
}

BallExpression& DeterminantForm::first(std::size_t k) {
  const auto known = gradient.find(k);
  if (known != gradient.end()) return known->second.second;
  NodeId node = Differentiator(graph, k).of(root);
  if (node == kNoNode) node = graph.number("0");
  return gradient.emplace(k, std::pair(node, BallExpression(graph, node))).first->second.second;
}

BallExpression& DeterminantForm::second(std::size_t k, std::size_t l) {
  const auto known = hessian.find({k, l});
  if (known != hessian.end()) return known->second;
  static_cast<void>(first(k));
  NodeId node = Differentiator(graph, l).of(gradient.at(k).first);
  if (node == kNoNode) node = graph.number("0");
  return hessian.emplace(std::pair(k, l), BallExpression(graph, node)).first->second;
}

bool Extremum::exceeds() {
  place_.assign(box_.size(), Place::kFree);
  sign_ = sign_in_the_middle();
  if (sign_ == 0 || !move_to_ends()) return false;
  return free_.empty() ? exceeds_at_ends() : exceeds_where_convex();
}

/// Returns the end: that of a range is an expression, that of a part is a double.
Ball Extremum::end_of(std::size_t k, bool upper, long bits) const {
  const double x = upper ? box_[k].hi : box_[k].lo;
  const double outer = upper ? variety_.outer[k].hi : variety_.outer[k].lo;
  if (x == outer) {
    BallExpression& end = upper ? bounds_.upper[k] : bounds_.lower[k];
    if (const Ball* value = end.run({}, bits)) return *value;
  }
  return Ball(point(x), bits);
}

Ball Extremum::range_of(std::size_t k, long bits, bool widened) const {
  if (place_[k] != Place::kFree) return end_of(k, place_[k] == Place::kUpper, bits);
  Ball result, lower = end_of(k, false, bits), upper = end_of(k, true, bits);
  arb_union(result.get(), lower.get(), upper.get(), bits);
  if (widened) {
    mag_t more;
    mag_init(more);
    mag_mul_2exp_si(more, arb_radref(result.get()), -20);
    arb_add_error_mag(result.get(), more);
    mag_clear(more);
  }
  return result;
}

std::vector<Ball> Extremum::ranges(long bits, bool widened) const {
  std::vector<Ball> result(box_.size());
  for (const std::size_t k : form_.value.variables()) result[k] = range_of(k, bits, widened);
  return result;
}

/// Guesses the sign to be proved. Any point is good enough.
int Extremum::sign_in_the_middle() {
  for (long bits = 64; bits <= max_bits_; bits *= 4) {
    std::vector<Ball> middle(box_.size());
    for (const std::size_t k : form_.value.variables()) {
      middle[k] = range_of(k, bits, false);
      if (!is_thin(box_[k])) arb_get_mid_arb(middle[k].get(), middle[k].get());
    }
    const Ball* value = form_.value.run(middle, bits);
    if (value == nullptr) continue;
    if (arb_is_positive(value->get()) != 0) return 1;
    if (arb_is_negative(value->get()) != 0) return -1;
  }
  return 0;
}

bool Extremum::move_to_ends() {
  bool is_moved = true;
  while (is_moved) {
    is_moved = false;
    const std::vector<Ball> x = ranges(kBitsOfExtremum, false);
    free_.clear();
    for (const std::size_t k : form_.value.variables()) {
      if (place_[k] != Place::kFree) continue;
      const Ball* slope = form_.first(k).run(x, kBitsOfExtremum);
      if (slope == nullptr) return false;
      // Where sign·f grows, it is least at the lower end.
      if (arb_is_nonnegative(slope->get()) != 0)
        place_[k] = sign_ > 0 ? Place::kLower : Place::kUpper;
      else if (arb_is_nonpositive(slope->get()) != 0)
        place_[k] = sign_ > 0 ? Place::kUpper : Place::kLower;
      else
        free_.push_back(k);
      is_moved = is_moved || place_[k] != Place::kFree;
    }
  }
  return true;
}

/// Shows that sign·f(point) − loss > alpha.
bool Extremum::exceeds_at_point(const std::vector<Ball>& point, const Ball& loss, long bits) {
  const Ball* value = form_.value.run(point, bits);
  const Ball* alpha = bounds_.alpha.run({}, bits);
  if (value == nullptr || alpha == nullptr) return false;
  Ball least;
  arb_mul_si(least.get(), value->get(), sign_, bits);
  arb_sub(least.get(), least.get(), loss.get(), bits);
  return arb_gt(least.get(), alpha->get()) != 0;
}

bool Extremum::exceeds_at_ends() {
  for (long bits = 64; bits <= max_bits_; bits *= 2)
    if (exceeds_at_point(ranges(bits, false), Ball(), bits)) return true;
  return false;
}

/// Shows that the Hessian less a positive diagonal is positive definite over the ranges.
bool Extremum::find_curvature(bool widened) {
  const std::size_t n = free_.size();
  const std::vector<Ball> x = ranges(kBitsOfExtremum, widened);
  BallMatrix H(n, n), rest(n, n), root(n, n);
  std::vector<double> diagonal(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const Ball* value = form_.second(free_[i], free_[j]).run(x, kBitsOfExtremum);
      if (value == nullptr) return false;
      arb_mul_si(H.at(i, j), value->get(), sign_, kBitsOfExtremum);
      arb_set(H.at(j, i), H.at(i, j));
    }
  for (std::size_t i = 0; i < n; ++i) {
    Ball entry;
    arb_set(entry.get(), H.at(i, i));
    diagonal[i] = entry.enclosure().lo;
    if (!(diagonal[i] > 0.0) || !(diagonal[i] < kInfinity)) return false;
  }
  for (const double share : {0.5, 0x1p-4, 0x1p-10, 0x1p-20}) {
    arb_mat_set(rest.get(), H.get());
    for (std::size_t i = 0; i < n; ++i) {
      const Ball part(point(share * diagonal[i]), kBitsOfExtremum);
      arb_sub(rest.at(i, i), rest.at(i, i), part.get(), kBitsOfExtremum);
    }
    if (arb_mat_cho(root.get(), rest.get(), kBitsOfExtremum) == 0) continue;
    curvature_.clear();
    for (const double d : diagonal) curvature_.push_back(share * d);
    return std::all_of(curvature_.begin(), curvature_.end(), [](double c) { return c > 0.0; });
  }
  return false;
}

/// Makes one step of Newton's method, within the ranges. Returns false if no step is possible.
bool Extremum::improve(std::vector<Ball>& point, long bits) {
  const std::size_t n = free_.size();
  BallMatrix H(n, n), slope(n, 1), step(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const Ball* value = form_.first(free_[i]).run(point, bits);
    if (value == nullptr) return false;
    arb_set(slope.at(i, 0), value->get());
    for (std::size_t j = 0; j <= i; ++j) {
      const Ball* second = form_.second(free_[i], free_[j]).run(point, bits);
      if (second == nullptr) return false;
      arb_set(H.at(i, j), second->get());
      arb_set(H.at(j, i), second->get());
    }
  }
  if (arb_mat_solve(step.get(), H.get(), slope.get(), bits) == 0) return false;
  for (std::size_t i = 0; i < n; ++i) {
    Ball& x = point[free_[i]];
    const Ball range = range_of(free_[i], kBitsOfExtremum, widened_);
    arb_sub(x.get(), x.get(), step.at(i, 0), bits);
    arb_get_mid_arb(x.get(), x.get());
    if (arb_contains(range.get(), x.get()) != 0) continue;
    const bool is_above = arf_cmp(arb_midref(x.get()), arb_midref(range.get())) > 0;
    Ball reach;
    arf_set_mag(arb_midref(reach.get()), arb_radref(range.get()));
    // Stay slightly inside the end, so that rounding does not move the point out again.
    arb_mul_si(reach.get(), reach.get(), is_above ? kWithin : -kWithin, bits);
    arb_div_si(reach.get(), reach.get(), kWithin + 1, bits);
    arb_get_mid_arb(x.get(), range.get());
    arb_add(x.get(), x.get(), reach.get(), bits);
    arb_get_mid_arb(x.get(), x.get());
    if (arb_contains(range.get(), x.get()) == 0) return false;
  }
  return true;
}

/// Bounds how far below f(point) a convex f can be: Σ g²/(2·curvature).
std::optional<Ball> Extremum::loss_at(const std::vector<Ball>& point, long bits) {
  Ball loss, part;
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const Ball* slope = form_.first(free_[i]).run(point, bits);
    if (slope == nullptr) return std::nullopt;
    arb_mul(part.get(), slope->get(), slope->get(), bits);
    const Ball twice(verifier::point(2.0 * curvature_[i]), bits);
    arb_div(part.get(), part.get(), twice.get(), bits);
    arb_add(loss.get(), loss.get(), part.get(), bits);
  }
  return loss;
}

bool Extremum::exceeds_where_convex() {
  if (free_.size() > kMostFree) return false;
  widened_ = true;
  if (!find_curvature(true)) {
    widened_ = false;
    if (!find_curvature(false)) return false;
  }
  std::vector<Ball> point;
  for (long bits = kBitsOfExtremum; bits <= max_bits_; bits *= 2) {
    // Each round knows the variables at their ends to more bits.
    const std::vector<Ball> x = ranges(bits, false);
    if (point.empty()) {
      point = x;
      for (const std::size_t k : free_) arb_get_mid_arb(point[k].get(), point[k].get());
    }
    for (const std::size_t k : form_.value.variables())
      if (place_[k] != Place::kFree) point[k] = x[k];
    for (int step = 0; step < (bits == kBitsOfExtremum ? kFirstSteps : 2); ++step)
      if (!improve(point, bits)) return false;
    const auto loss = loss_at(point, bits);
    if (!loss) return false;
    if (exceeds_at_point(point, *loss, bits)) return true;
  }
  return false;
}

}  // namespace regulus::verifier
