// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the truth about a model at chosen points of its variety, by Arb.
//
// A point is given by its parts: variable k has the value lo + part·(hi − lo) of its true range,
// including ends that are not doubles. For a point in a ball, the parts are moved towards its
// centre until they are in the ball.
#pragma once

#include <arb_mat.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "codegen/question/engine/pipeline.hpp"
#include "tests/support/models/arb_tape.hpp"

namespace regulus::detail::test {

using Parts = std::vector<double>;

/// The known facts about a point, or about each point of a piece of a segment.
struct Fact {
  Defined pose = Defined::kUnknown;    ///< of constraints and motion
  Defined matrix = Defined::kUnknown;  ///< of the matrix and its row scales, as well
  bool inside = false;                 ///< certainly: every constraint ≤ 0
  bool outside = false;                ///< certainly: some constraint > 0
  Ball determinant;  ///< of J⁻¹; for more rows than columns, of A's Gram matrix
  double approx = 0;

  [[nodiscard]] int sign() const {
    return arb_is_positive(determinant.get()) != 0   ? 1
           : arb_is_negative(determinant.get()) != 0 ? -1
                                                     : 0;
  }
};

class ModelOracle {
 public:
  ModelOracle(const Model& model, const Motion& motion, const std::vector<Variable>& variables)
      : model_(model), rows_(model.matrix.rows()), columns_(model.matrix.cols()) {
    for (const Variable& v : variables) {
      lo_.push_back(constant(v.range.lo));
      hi_.push_back(constant(v.range.hi));
      ball_.push_back(v.ball);
    }
    alpha_ = constant(motion.alpha);
    bind_symbols(motion, variables);
  }

  [[nodiscard]] std::size_t variables() const { return lo_.size(); }
  [[nodiscard]] bool square() const { return rows_ == columns_; }
  [[nodiscard]] bool constrained() const { return !constraints_.empty(); }
  [[nodiscard]] const Ball& alpha() const { return alpha_; }
  [[nodiscard]] bool has_threshold() const { return arb_is_zero(alpha_.get()) == 0; }

  /// Moves parts that belong to balls into these balls.
  void confine(Parts& parts) const {
    for (std::size_t b = 0; b < model_.balls.size(); ++b) {
      double norm = 0;
      for (std::size_t k = 0; k < parts.size(); ++k)
        if (ball_[k] == int(b)) norm = std::hypot(norm, 2 * parts[k] - 1);
      if (norm <= 1 - 0x1p-40) continue;
      for (std::size_t k = 0; k < parts.size(); ++k)
        if (ball_[k] == int(b)) parts[k] = 0.5 + 0.5 * (2 * parts[k] - 1) / norm * (1 - 0x1p-40);
    }
  }

  [[nodiscard]] Fact at(const Parts& parts) const {
    std::vector<Ball> inputs;
    for (std::size_t k = 0; k < parts.size(); ++k) inputs.push_back(value(k, Ball(parts[k])));
    return look(inputs);
  }

  /// Returns values of the variables; the middle of the true range for one that is not a double.
  [[nodiscard]] std::vector<Ball> values(const std::vector<Interval>& point) const {
    std::vector<Ball> result;
    for (std::size_t k = 0; k < point.size(); ++k)
      result.push_back(is_thin(point[k]) ? Ball(point[k].lo) : value(k, Ball(0.5)));
    return result;
  }

  /// Returns true unless those values are certainly outside the variety's ranges and balls.
  [[nodiscard]] bool possibly_in_range(const std::vector<Ball>& x) const {
    for (std::size_t k = 0; k < x.size(); ++k)
      if (arb_lt(x[k].get(), lo_[k].get()) != 0 || arb_gt(x[k].get(), hi_[k].get()) != 0)
        return false;
    for (std::size_t b = 0; b < model_.balls.size(); ++b)
      if (certain_outside_ball(x, int(b))) return false;
    return true;
  }

  [[nodiscard]] Fact look(const std::vector<Ball>& inputs) const {
    const ArbTape::Values values = tape_.run(inputs);
    Fact fact;
    fact.pose = worst(values, motion_nodes_);
    fact.matrix = ArbTape::worse(fact.pose, worst(values, matrix_nodes_));
    fact.inside = fact.pose == Defined::kYes;
    for (const ArbTape::Node c : constraints_) {
      fact.inside = fact.inside && arb_is_nonpositive(values.of[c].get()) != 0;
      fact.outside = fact.outside || arb_is_positive(values.of[c].get()) != 0;
    }
    if (fact.matrix == Defined::kYes) fact.determinant = determinant_of(values);
    if (fact.matrix != Defined::kYes) arb_zero_pm_inf(fact.determinant.get());
    fact.approx = arf_get_d(arb_midref(fact.determinant.get()), ARF_RND_NEAR);
    return fact;
  }

  /// Returns true if the segment certainly stays in the variety; `everywhere`: and has J⁻¹ defined.
  [[nodiscard]] bool joined(const std::vector<Ball>& from, const std::vector<Ball>& to,
                            bool everywhere) const {
    std::vector<std::pair<double, double>> waiting{{0.0, 1.0}};
    for (int pieces = 0; !waiting.empty(); ++pieces) {
      if (pieces == 400) return false;
      const auto [a, b] = waiting.back();
      waiting.pop_back();
      const Fact fact = look(between(from, to, a, b));
      if (fact.inside && (!everywhere || fact.matrix == Defined::kYes)) continue;
      if (b - a < 0x1p-12) return false;
      waiting.emplace_back(a, 0.5 * (a + b));
      waiting.emplace_back(0.5 * (a + b), b);
    }
    return true;
  }

  /// Returns true if some point of the segment is certainly outside, or J⁻¹ is undefined there.
  [[nodiscard]] bool leaves(const std::vector<Ball>& from, const std::vector<Ball>& to) const {
    for (int i = 0; i <= 64; ++i) {
      const Fact fact = look(between(from, to, i / 64.0, i / 64.0));
      if (fact.outside || fact.matrix == Defined::kNo) return true;
    }
    return false;
  }

  [[nodiscard]] std::vector<Ball> values_of_parts(const Parts& parts) const {
    std::vector<Ball> result;
    for (std::size_t k = 0; k < parts.size(); ++k) result.push_back(value(k, Ball(parts[k])));
    return result;
  }

 private:
  static Ball constant(const GiNaC::ex& e) {
    ArbTape tape;
    tape.read(e);
    return tape.run({}).of.back();
  }

  void bind_symbols(const Motion& motion, const std::vector<Variable>& variables) {
    std::vector<std::pair<GiNaC::ex, ArbTape::Node>> shared;
    const auto bind = [&](const GiNaC::ex& symbol, ArbTape::Node node) {
      tape_.bind(symbol, node);
      shared.emplace_back(symbol, node);
    };
    std::size_t next = 0;
    for (const auto& p : motion.parameters) bind(p.symbol, tape_.input(next++));
    for (const auto& g : model_.geometry) {
      const GiNaC::ex spread = g.ball >= 0 ? model_.balls[std::size_t(g.ball)].radius : g.tolerance;
      bind(g.symbol, spread.is_zero() ? tape_.read(g.value) : tape_.input(next++));
    }
    std::vector<ArbTape::Node> commanded, actual;
    for (std::size_t i = 0; i < model_.pose.size(); ++i) {
      commanded.push_back(tape_.read(motion.pose[i]));
      const bool exact = motion.error.empty() || motion.error[i].is_zero();
      actual.push_back(exact ? commanded[i] : tape_.sum(commanded[i], tape_.input(next++)));
    }
    if (next != variables.size()) throw std::logic_error("another number of variables");
    for (std::size_t i = 0; i < commanded.size(); ++i)
      tape_.bind(model_.pose[i].symbol, commanded[i]);
    motion_nodes_ = commanded;
    for (const GiNaC::ex& e : motion.must_be_defined) motion_nodes_.push_back(tape_.read(e));
    for (const GiNaC::ex& e : motion.constraints) constraints_.push_back(tape_.read(e));
    motion_nodes_.insert(motion_nodes_.end(), constraints_.begin(), constraints_.end());
    tape_.forget_symbols();
    for (const auto& [symbol, node] : shared) tape_.bind(symbol, node);
    for (std::size_t i = 0; i < actual.size(); ++i) tape_.bind(model_.pose[i].symbol, actual[i]);
    for (unsigned i = 0; i < rows_; ++i)
      for (unsigned j = 0; j < columns_; ++j) entries_.push_back(tape_.read(model_.matrix(i, j)));
    for (const GiNaC::ex& scale : model_.row_scale) scales_.push_back(tape_.read(scale));
    matrix_nodes_ = entries_;
    matrix_nodes_.insert(matrix_nodes_.end(), scales_.begin(), scales_.end());
    for (const GiNaC::ex& e : model_.must_be_defined) matrix_nodes_.push_back(tape_.read(e));
  }

  static Defined worst(const ArbTape::Values& values, const std::vector<ArbTape::Node>& nodes) {
    Defined result = Defined::kYes;
    for (const ArbTape::Node node : nodes) result = ArbTape::worse(result, values.defined[node]);
    return result;
  }

  [[nodiscard]] Ball value(std::size_t k, const Ball& part) const {
    Ball width, result;
    arb_sub(width.get(), hi_[k].get(), lo_[k].get(), kTapeBits);
    arb_mul(width.get(), width.get(), part.get(), kTapeBits);
    arb_add(result.get(), lo_[k].get(), width.get(), kTapeBits);
    if (arb_equal(part.get(), Ball(1.0).get()) != 0) return hi_[k];
    return result;
  }

  [[nodiscard]] bool certain_outside_ball(const std::vector<Ball>& x, int ball) const {
    Ball sum, radius;
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (ball_[k] != ball) continue;
      Ball off;
      arb_sub(radius.get(), hi_[k].get(), lo_[k].get(), kTapeBits);
      arb_add(off.get(), hi_[k].get(), lo_[k].get(), kTapeBits);
      arb_mul_2exp_si(off.get(), off.get(), -1);
      arb_sub(off.get(), x[k].get(), off.get(), kTapeBits);
      arb_addmul(sum.get(), off.get(), off.get(), kTapeBits);
    }
    arb_mul_2exp_si(radius.get(), radius.get(), -1);
    arb_mul(radius.get(), radius.get(), radius.get(), kTapeBits);
    return arb_gt(sum.get(), radius.get()) != 0;
  }

  static std::vector<Ball> between(const std::vector<Ball>& from, const std::vector<Ball>& to,
                                   double a, double b) {
    const Ball part(Interval(a, b), kTapeBits);
    std::vector<Ball> result(from.size());
    for (std::size_t k = 0; k < from.size(); ++k) {
      arb_sub(result[k].get(), to[k].get(), from[k].get(), kTapeBits);
      arb_mul(result[k].get(), result[k].get(), part.get(), kTapeBits);
      arb_add(result[k].get(), result[k].get(), from[k].get(), kTapeBits);
    }
    return result;
  }

  [[nodiscard]] Ball determinant_of(const ArbTape::Values& values) const {
    arb_mat_t A, transposed, gram;
    arb_mat_init(A, rows_, columns_);
    arb_mat_init(transposed, columns_, rows_);
    arb_mat_init(gram, columns_, columns_);
    for (unsigned i = 0; i < rows_; ++i)
      for (unsigned j = 0; j < columns_; ++j)
        arb_set(arb_mat_entry(A, i, j), values.of[entries_[i * columns_ + j]].get());
    Ball result;
    if (square()) {
      arb_mat_det(result.get(), A, kTapeBits);
      for (const ArbTape::Node scale : scales_)
        arb_mul(result.get(), result.get(), values.of[scale].get(), kTapeBits);
    } else {
      arb_mat_transpose(transposed, A);
      arb_mat_mul(gram, transposed, A, kTapeBits);
      arb_mat_det(result.get(), gram, kTapeBits);
    }
    arb_mat_clear(A);
    arb_mat_clear(transposed);
    arb_mat_clear(gram);
    return result;
  }

  const Model& model_;
  unsigned rows_, columns_;
  std::vector<Ball> lo_, hi_;
  std::vector<int> ball_;
  Ball alpha_;
  ArbTape tape_;
  std::vector<ArbTape::Node> entries_, scales_, constraints_, motion_nodes_, matrix_nodes_;
};

}  // namespace regulus::detail::test
