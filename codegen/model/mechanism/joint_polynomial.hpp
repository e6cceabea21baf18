// SPDX-License-Identifier: GPL-3.0-or-later
// Polynomials in joint variables: sines and cosines of sums of angles, powers of displacements.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "codegen/support/work_meter.hpp"

namespace regulus::detail {

/// Counts the terms that are formed, so that a hostile model ends with a message.
class TermBudget {
 public:
  static constexpr std::size_t kMost = 200'000;
  static constexpr std::size_t kMostOfCoefficient = 200;

  /// `meter`: null, or it outlives this object.
  explicit TermBudget(WorkMeter* meter = nullptr) : meter_(meter) {}

  /// Returns the coefficient, reduced.
  ///
  /// Throws    ParseRefusal if it has too many terms, or all so far have; what the meter throws.
  [[nodiscard]] GiNaC::ex counted(const GiNaC::ex& coefficient);

 private:
  WorkMeter* meter_;
  std::size_t spent_ = 0;
};

/// The joints of a chain whose angles may be added. Joints with parallel axes that follow each other
/// form a group: rotations by q2 and q3 are one by q2 + q3.
struct JointGroups {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::vector<std::size_t> of_joint;  ///< by joint; kNone for one that slides
  std::size_t count = 0;
  std::shared_ptr<TermBudget> budget;
};

/// Σ coefficient · Π sin or cos(Σ ±q) · Π q^e, at most one sine or cosine for each group.
///
/// The form is canonical, products of sines and cosines of a group being sums of such: so equal
/// polynomials have equal terms, and cos(q2)·cos(q3) − sin(q2)·sin(q3) is cos(q2 + q3).
class JointPolynomial {
 public:
  /// By joint the multiple of its angle, or the power of its displacement; then by group whether its
  /// sine is meant.
  using Key = std::vector<int>;
  using Terms = std::map<Key, GiNaC::ex>;

  explicit JointPolynomial(const JointGroups& groups) : groups_(&groups) {}
  JointPolynomial(const JointGroups& groups, const GiNaC::ex& constant);

  [[nodiscard]] const Terms& terms() const noexcept { return terms_; }
  [[nodiscard]] bool is_zero() const noexcept { return terms_.empty(); }

  /// Adds factor · other.
  void add(const JointPolynomial& other, const GiNaC::ex& factor);
  [[nodiscard]] JointPolynomial times_cosine(std::size_t joint) const;
  [[nodiscard]] JointPolynomial times_sine(std::size_t joint) const;
  [[nodiscard]] JointPolynomial times_displacement(std::size_t joint) const;

  /// Returns the number of joint variables that are written in it, with repetitions.
  [[nodiscard]] std::size_t occurrences() const;

  /// `joints`: the symbol of each joint.
  [[nodiscard]] GiNaC::ex expression(const std::vector<GiNaC::ex>& joints) const;

 private:
  void add_term(Key key, const GiNaC::ex& coefficient);
  [[nodiscard]] JointPolynomial times_turn(std::size_t joint, bool sine) const;
  [[nodiscard]] std::vector<std::size_t> members(std::size_t group) const;

  const JointGroups* groups_;
  Terms terms_;
};

using PolynomialVector = std::array<JointPolynomial, 3>;

}  // namespace regulus::detail
