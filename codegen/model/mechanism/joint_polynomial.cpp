// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/joint_polynomial.hpp"

#include <algorithm>
#include <cstdlib>

#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/model/exact/parsed_expression.hpp"

namespace regulus::detail {

using GiNaC::ex;

JointPolynomial::JointPolynomial(const JointGroups& groups, const ex& constant) : groups_(&groups) {
  add_term(Key(groups.of_joint.size() + groups.count, 0), constant);
}

ex TermBudget::counted(const ex& coefficient) {
  ex result = reduced(coefficient);
  const std::size_t terms = GiNaC::is_a<GiNaC::add>(result) ? result.nops() : 1;
  spent_ += terms;
  constexpr std::size_t kSteps = 100;  // of algebra, of the order of those that a meter counts
  spend(meter_, kSteps * terms);
  if (spent_ > kMost || terms > kMostOfCoefficient)
    throw ParseRefusal{
        "an arm whose matrix has too many terms",
        "fewer joints, or fewer angles that are not multiples of pi/12; quaternion = [w, x, "
        "y, z] gives a rotation whose entries are single numbers"};
  return result;
}

void JointPolynomial::add_term(Key key, const ex& coefficient) {
  const auto [at, inserted] = terms_.emplace(std::move(key), groups_->budget->counted(coefficient));
  if (!inserted) at->second = groups_->budget->counted(at->second + coefficient);
  if (at->second.is_zero()) terms_.erase(at);
}

void JointPolynomial::add(const JointPolynomial& other, const ex& factor) {
  if (factor.is_zero()) return;
  for (const auto& [key, coefficient] : other.terms_) add_term(key, factor * coefficient);
}

std::vector<std::size_t> JointPolynomial::members(std::size_t group) const {
  std::vector<std::size_t> result;
  for (std::size_t j = 0; j < groups_->of_joint.size(); ++j)
    if (groups_->of_joint[j] == group) result.push_back(j);
  return result;
}

/// With α the angle of the term and β = ±q: 2·cos α·cos β = cos(α + β) + cos(α − β), and so on.
JointPolynomial JointPolynomial::times_turn(std::size_t joint, bool sine) const {
  const std::size_t flag = groups_->of_joint.size() + groups_->of_joint[joint];
  const auto angles = members(groups_->of_joint[joint]);
  JointPolynomial result(*groups_);
  for (const auto& [key, coefficient] : terms_) {
    const bool has_angle = std::ranges::any_of(
        angles, [&exponents = key](std::size_t j) { return exponents[j] != 0; });
    if (!has_angle) {
      Key product = key;
      product[joint] = 1;
      product[flag] = sine ? 1 : 0;
      result.add_term(std::move(product), coefficient);
      continue;
    }
    const bool sine_before = key[flag] != 0;
    for (const int sign : {1, -1}) {
      Key product = key;
      product[joint] += sign;
      product[flag] = sine != sine_before ? 1 : 0;
      int factor = sine && (sine_before ? sign > 0 : sign < 0) ? -1 : 1;
      const auto first =
          std::ranges::find_if(angles, [&](std::size_t j) { return product[j] != 0; });
      if (first == angles.end()) {
        if (product[flag] != 0) continue;  // sin 0
      } else if (product[*first] < 0) {
        for (const std::size_t j : angles) product[j] = -product[j];
        if (product[flag] != 0) factor = -factor;
      }
      result.add_term(std::move(product), coefficient * factor / 2);
    }
  }
  return result;
}

JointPolynomial JointPolynomial::times_cosine(std::size_t joint) const {
  return times_turn(joint, false);
}

JointPolynomial JointPolynomial::times_sine(std::size_t joint) const {
  return times_turn(joint, true);
}

JointPolynomial JointPolynomial::times_displacement(std::size_t joint) const {
  JointPolynomial result(*groups_);
  for (const auto& [key, coefficient] : terms_) {
    Key product = key;
    ++product[joint];
    result.add_term(std::move(product), coefficient);
  }
  return result;
}

std::size_t JointPolynomial::occurrences() const {
  std::size_t count = 0;
  for (const auto& [key, coefficient] : terms_)
    for (std::size_t j = 0; j < groups_->of_joint.size(); ++j) count += key[j] != 0 ? 1 : 0;
  return count;
}

ex JointPolynomial::expression(const std::vector<ex>& joints) const {
  ex result = 0;
  for (const auto& [key, coefficient] : terms_) {
    ex term = coefficient;
    std::vector<ex> angles(groups_->count, 0);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const std::size_t group = groups_->of_joint[j];
      if (group == JointGroups::kNone)
        term *= key[j] == 0 ? ex(1) : pow(joints[j], key[j]);  // GiNaC has no 0^0
      else
        angles[group] += key[j] * joints[j];
    }
    // Followers can turn their leader's angle back: the sum is 0 then, and so is its sine.
    for (std::size_t g = 0; g < angles.size(); ++g)
      term *= key[joints.size() + g] != 0 ? GiNaC::sin(angles[g]) : GiNaC::cos(angles[g]);
    result += term;
  }
  return result;
}

}  // namespace regulus::detail
