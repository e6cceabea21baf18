// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/half_angles.hpp"

#include <algorithm>
#include <utility>

#include "codegen/model/mechanism/joint_polynomial.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

struct SineAndCosine {
  ex sine = 0, cosine = 1;
};

SineAndCosine turned_by(const SineAndCosine& a, const SineAndCosine& b) {
  return {a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
}

std::vector<ex> terms_of(const ex& sum) {
  if (!GiNaC::is_a<GiNaC::add>(sum)) return {sum};
  return {sum.begin(), sum.end()};
}

struct NotPolynomial {};

}  // namespace

HalfAngles::HalfAngles(const std::vector<PoseParameter>& pose) {
  for (std::size_t j = 0; j < pose.size(); ++j) {
    joints_.emplace_back(pose[j].symbol);
    if (pose[j].unit == "rad")
      angles_.push_back({j, pose[j].symbol, GiNaC::realsymbol("s"), GiNaC::realsymbol("c"),
                         GiNaC::realsymbol("t")});
  }
}

std::optional<ex> HalfAngles::polynomial(const ex& e) const {
  struct Replacement : GiNaC::map_function {
    explicit Replacement(const std::vector<Angle>& known) : angles(known) {}

    SineAndCosine of(const ex& argument) const {
      SineAndCosine result;
      for (const ex& term : terms_of(argument.expand())) {
        const auto at = std::ranges::find_if(
            angles, [&term](const Angle& a) { return term.is_equal(a.q) || term.is_equal(-a.q); });
        if (at == angles.end()) throw NotPolynomial{};
        const bool negative = !term.is_equal(at->q);
        result = turned_by(result, {negative ? ex(-at->sine) : at->sine, at->cosine});
      }
      return result;
    }

    ex operator()(const ex& part) override {
      if (GiNaC::is_the_function<GiNaC::sin_SERIAL>(part)) return of(part.op(0)).sine;
      if (GiNaC::is_the_function<GiNaC::cos_SERIAL>(part)) return of(part.op(0)).cosine;
      if (GiNaC::is_a<GiNaC::function>(part)) throw NotPolynomial{};
      return part.map(*this);
    }

    const std::vector<Angle>& angles;
  };
  try {
    const ex result = Replacement(angles_)(e).expand();
    if (!result.info(GiNaC::info_flags::rational_polynomial)) return std::nullopt;
    return result;
  } catch (const NotPolynomial&) {
    return std::nullopt;
  }
}

ex HalfAngles::without_squares(const ex& p) const {
  ex result = p.expand();
  for (const Angle& a : angles_) {
    const ex square = 1 - pow(a.cosine, 2);
    ex reduced = 0;
    for (int k = result.ldegree(a.sine); k <= result.degree(a.sine); ++k)
      reduced += result.coeff(a.sine, k) * pow(square, k / 2) * pow(a.sine, k % 2);
    result = reduced.expand();
  }
  return result;
}

std::vector<ex> HalfAngles::take_common(ex& p) const {
  std::vector<ex> common;
  for (const Angle& a : angles_)
    for (const auto& [symbol, function] :
         {std::pair(a.sine, sin(a.q)), std::pair(a.cosine, cos(a.q))}) {
      const int times = p.is_zero() ? 0 : p.ldegree(symbol);
      for (int k = 0; k < times; ++k) common.push_back(function);
      if (times > 0) p = (p / pow(symbol, times)).expand();
    }
  return common;
}

ex HalfAngles::in_angles(const ex& p) const {
  GiNaC::exmap values;
  for (const Angle& a : angles_) values[a.sine] = sin(a.q), values[a.cosine] = cos(a.q);
  return p.subs(values, GiNaC::subs_options::no_pattern);
}

ex HalfAngles::numerator(const ex& p) const {
  ex result = p;
  for (const Angle& a : angles_) {
    const ex &t = a.tangent, norm = 1 + pow(t, 2);
    const int most = result.degree(a.sine) + result.degree(a.cosine);
    ex product = 0;
    for (int i = 0; i <= result.degree(a.sine); ++i) {
      const ex of_sine = result.coeff(a.sine, i);
      for (int j = 0; j <= of_sine.degree(a.cosine); ++j)
        product += of_sine.coeff(a.cosine, j) * pow(2 * t, i) * pow(1 - pow(t, 2), j) *
                   pow(norm, most - i - j);
    }
    result = product.expand();
    // 1 + t² has no zero.
    for (ex quotient; GiNaC::divide(result, norm, quotient, false); result = quotient)
      if (result.is_zero()) break;
  }
  return result;
}

/// A turn by pi, t → −1/t, exchanges the two factors of a trigonometric polynomial that is a product
/// over the half angles: t and 1, 1 + t and 1 − t.
std::optional<std::vector<ex>> HalfAngles::paired(std::vector<ex> factors) const {
  for (const Angle& a : angles_) {
    const ex& t = a.tangent;
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const int degree = factors[i].degree(t);
      if (degree % 2 == 0 || factors[i].is_equal(t)) continue;
      const ex turned = (factors[i].subs(t == -1 / t) * pow(t, degree)).expand();
      const auto partner = std::find_if(
          factors.begin() + static_cast<std::ptrdiff_t>(i) + 1, factors.end(),
          [&turned](const ex& f) { return (f - turned).is_zero() || (f + turned).is_zero(); });
      if (partner == factors.end()) return std::nullopt;
      factors[i] = (factors[i] * *partner).expand();
      factors.erase(partner);
    }
  }
  return factors;
}

ex HalfAngles::trigonometric(const ex& factor) const {
  JointGroups single, sums;
  single.budget = sums.budget = std::make_shared<TermBudget>();
  single.of_joint.assign(joints_.size(), JointGroups::kNone);
  sums.of_joint = single.of_joint;
  sums.count = 1;
  for (const Angle& a : angles_) {
    single.of_joint[a.joint] = single.count++;
    sums.of_joint[a.joint] = 0;
  }
  std::optional<ex> best;
  std::size_t fewest = 0;
  for (const JointGroups* groups : {&single, &sums}) {
    std::vector<std::pair<ex, JointPolynomial>> parts = {{factor, JointPolynomial(*groups, 1)}};
    for (const Angle& a : angles_) {
      const int halves = (factor.degree(a.tangent) + 1) / 2;
      std::vector<std::pair<ex, JointPolynomial>> next;
      for (const auto& [rest, product] : parts)
        for (int k = 0; k <= rest.degree(a.tangent); ++k) {
          if (rest.coeff(a.tangent, k).is_zero()) continue;
          // t^k/(1 + t²)^m from sin = 2t/(1 + t²), 1 ± cos = 2/(1 + t²), 2t²/(1 + t²).
          JointPolynomial term = product;
          for (int i = 0; i < k / 2; ++i) {
            JointPolynomial lower = term;
            lower.add(term.times_cosine(a.joint), -1);
            term = lower;
          }
          if (k % 2 != 0) term = term.times_sine(a.joint);
          for (int i = 0; i < halves - (k + 1) / 2; ++i) {
            JointPolynomial upper = term;
            upper.add(term.times_cosine(a.joint), 1);
            term = upper;
          }
          next.emplace_back(rest.coeff(a.tangent, k), term);
        }
      parts = std::move(next);
    }
    JointPolynomial sum(*groups);
    for (const auto& [rest, product] : parts) sum.add(product, rest);
    if (best && sum.terms().size() >= fewest) continue;
    fewest = sum.terms().size();
    best = sum.expression(joints_).expand();
  }
  return *best;
}

std::vector<std::size_t> HalfAngles::joints_in(const ex& factor) const {
  std::vector<std::size_t> result;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const auto angle = std::ranges::find(angles_, j, &Angle::joint);
    if (factor.has(joints_[j]) || (angle != angles_.end() && factor.has(angle->tangent)))
      result.push_back(j);
  }
  return result;
}

}  // namespace regulus::detail
