// SPDX-License-Identifier: GPL-3.0-or-later
// Looks for a proof that a claim about a model is wrong: it samples, then descends from the best.
#pragma once

#include <optional>
#include <string>

#include "runtime/problem/result.hpp"
#include "tests/support/models/model_oracle.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

class Refutation {
 public:
  Refutation(const ModelOracle& oracle, RandomSource& random, int samples)
      : oracle_(oracle), random_(random) {
    look({Parts(oracle.variables(), 0.5)});
    for (int sample = 0; sample < samples && !found_; ++sample) look({random_parts()});
    for (int start = 0; start < 2 && !found_ && best_; ++start) descend(*best_);
    if (best_of_other_sign_ && !found_) descend(*best_of_other_sign_);
    if (!found_) bisect_signs();
  }

  /// Returns why NO SINGULARITY is wrong; nullopt if no reason was found.
  [[nodiscard]] const std::optional<std::string>& found() const { return found_; }
  /// Returns how many sampled points lie in the variety.
  [[nodiscard]] int inside() const { return inside_; }

 private:
  struct Sample {
    Parts parts;
    Fact fact{};
  };

  Parts random_parts() {
    Parts parts;
    for (std::size_t k = 0; k < oracle_.variables(); ++k)
      parts.push_back(random_.one_in(4)   ? double(random_.below(2))
                      : random_.one_in(8) ? 0.5
                                          : random_.unit());
    return parts;
  }

  /// Returns whether the sample lies in the variety and J⁻¹ is defined there.
  bool look(Sample sample) {
    oracle_.confine(sample.parts);
    sample.fact = oracle_.at(sample.parts);
    const Fact& fact = sample.fact;
    if (fact.pose == Defined::kNo && !oracle_.constrained()) found_ = "an undefined pose";
    if (!fact.inside) return false;
    ++inside_;
    if (fact.matrix == Defined::kNo) found_ = "an undefined matrix";
    if (fact.matrix != Defined::kYes) return false;
    Ball size;
    arb_abs(size.get(), fact.determinant.get());
    if (arb_le(size.get(), oracle_.square() ? oracle_.alpha().get() : Ball(0.0).get()) != 0)
      found_ = "a determinant of " + std::to_string(fact.approx);
    keep(sample);
    current_ = std::fabs(fact.approx);
    return true;
  }

  void keep(const Sample& sample) {
    const auto better = [&](const std::optional<Sample>& known) {
      return !known || std::fabs(sample.fact.approx) < std::fabs(known->fact.approx);
    };
    if (best_ && best_->fact.sign() * sample.fact.sign() < 0) {
      refute_by_signs(*best_, sample);
      if (better(best_of_other_sign_)) best_of_other_sign_ = sample;
      if (better(best_)) std::swap(best_, best_of_other_sign_);
    } else if (better(best_)) {
      best_ = sample;
    }
  }

  void refute_by_signs(const Sample& a, const Sample& b) {
    if (found_ || !oracle_.square() || ++sign_checks_ > 8) return;
    // Without constraints the variety is convex. The claim itself states that the matrix is defined
    // everywhere in it.
    if (!oracle_.constrained() ||
        oracle_.joined(oracle_.values_of_parts(a.parts), oracle_.values_of_parts(b.parts), false))
      found_ = "opposite signs";
  }

  void descend(Sample from) {
    double best = std::fabs(from.fact.approx);
    for (double step = 0.25; step > 0x1p-30 && !found_; step /= 4) {
      for (std::size_t k = 0; k < from.parts.size() && !found_; ++k)
        for (const double direction : {-1.0, 1.0}) {
          Sample trial = from;
          trial.parts[k] = std::clamp(trial.parts[k] + direction * step, 0.0, 1.0);
          if (look(trial) && current_ < best) from = trial, best = current_;
        }
    }
  }

  /// Looks for small determinants between points of opposite signs, which constraints may separate.
  void bisect_signs() {
    if (!best_ || !best_of_other_sign_) return;
    Parts a = best_->parts, b = best_of_other_sign_->parts;
    const int sign = best_->fact.sign();
    for (int step = 0; step < 40 && !found_; ++step) {
      Parts middle;
      for (std::size_t k = 0; k < a.size(); ++k) middle.push_back(0.5 * (a[k] + b[k]));
      const Fact fact = oracle_.at(middle);
      look({middle});
      (fact.sign() == sign ? a : b) = middle;
    }
  }

  const ModelOracle& oracle_;
  RandomSource& random_;
  std::optional<Sample> best_, best_of_other_sign_;
  std::optional<std::string> found_;
  double current_ = 0;
  int inside_ = 0, sign_checks_ = 0;
};

/// Returns why the witness of a SINGULARITY is wrong; nullopt if no reason was found. On a segment,
/// only 65 points are tested: Arb's balls cannot decide the end of one on a constraint.
inline std::optional<std::string> fault_of_witness(const ModelOracle& oracle,
                                                   const Result& result) {
  if (!result.witness) return "there is none";
  if (!oracle.square()) return "the matrix is not square";
  const Witness& witness = *result.witness;
  std::vector<std::vector<Ball>> points;
  std::vector<Fact> facts;
  for (const WitnessPoint& point : witness.points) {
    points.push_back(oracle.values(point.variables));
    if (!oracle.possibly_in_range(points.back())) return "a point outside the variety";
    facts.push_back(oracle.look(points.back()));
    if (facts.back().outside) return "constraints that do not hold";
    if (facts.back().matrix == Defined::kNo) return "an undefined point";
  }
  if (result.reason == Reason::kSmallDeterminant) {
    if (points.size() != 1) return "not one point";
    Ball size;
    arb_abs(size.get(), facts[0].determinant.get());
    if (arb_gt(size.get(), oracle.alpha().get()) != 0) return "a determinant above the threshold";
    return std::nullopt;
  }
  if (result.reason != Reason::kOppositeSigns || points.size() != 2) return "not two points";
  if (facts[0].sign() * facts[1].sign() != -1) return "signs that are not opposite";
  if (oracle.leaves(points[0], points[1])) return "a segment that leaves the variety";
  return std::nullopt;
}

/// Returns true if Arb certifies the whole segment between a witness's two points.
inline bool certain_segment(const ModelOracle& oracle, const Witness& witness) {
  return oracle.joined(oracle.values(witness.points[0].variables),
                       oracle.values(witness.points[1].variables), true);
}

}  // namespace regulus::detail::test
