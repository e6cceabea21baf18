// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/coupled_axes.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/question/solve/approx_vectors.hpp"

namespace regulus::detail {
namespace {

/// Coefficients below this are not counted: rounding leaves them.
constexpr double kCounted = 1e-12;
/// Sums of so many for each joint are within the digits of a wave.
constexpr long kMostWaves = kWaveBase / (4 * long(kMostJoints));

using Forms = std::array<TrigForm, 3>;

TrigForm dot_of(const Vector3& u, const Forms& f) {
  return u[0] * f[0] + u[1] * f[1] + u[2] * f[2];
}
Forms sum_of(const Forms& f, const Forms& g) { return {f[0] + g[0], f[1] + g[1], f[2] + g[2]}; }
Forms times_matrix(const Matrix3& R, const Forms& f) {
  return {dot_of({R[0], R[1], R[2]}, f), dot_of({R[3], R[4], R[5]}, f),
          dot_of({R[6], R[7], R[8]}, f)};
}
Forms cross_of(const Vector3& u, const Forms& f) {
  return {u[1] * f[2] - u[2] * f[1], u[2] * f[0] - u[0] * f[2], u[0] * f[1] - u[1] * f[0]};
}
Forms constant_of(const Vector3& v) { return {TrigForm(v[0]), TrigForm(v[1]), TrigForm(v[2])}; }

/// The numbers P, |P|², L, P·L, P × L of a line, as a frame sees it.
class LineForms {
 public:
  /// A line through the origin.
  explicit LineForms(const Vector3& axis) : direction(constant_of(axis)) {}

  void move(const LinkFrame& frame) {
    const Forms d = constant_of(frame.d);
    point = times_matrix(frame.R, point), direction = times_matrix(frame.R, direction);
    moment = sum_of(times_matrix(frame.R, moment), cross_of(frame.d, direction));
    square = square + Interval(2.0) * dot_of(frame.d, point) + TrigForm(dot(frame.d, frame.d));
    along = along + dot_of(frame.d, direction);
    point = sum_of(point, d);
  }

  /// Turns it about an axis through the origin by an unknown, as a wave says.
  void turn(const Vector3& axis, std::size_t unknown, long wave) {
    for (Forms* forms : {&point, &direction, &moment}) {
      const TrigForm part = dot_of(axis, *forms);
      const Forms across = cross_of(axis, *forms);
      for (std::size_t i = 0; i < 3; ++i) {
        const TrigForm rest = axis[i] * part;
        (*forms)[i] = rest + ((*forms)[i] - rest).times_cos(unknown, wave) +
                      across[i].times_sin(unknown, wave);
      }
    }
  }

  /// Moves it by v times an unknown.
  void slide(const Vector3& v, std::size_t unknown) {
    const auto times_x = [unknown](const TrigForm& form) { return form.times_unknown(unknown); };
    const Forms across = cross_of(v, direction);
    for (std::size_t i = 0; i < 3; ++i) moment[i] = moment[i] + times_x(across[i]);
    square = square + times_x(Interval(2.0) * dot_of(v, point) + times_x(TrigForm(dot(v, v))));
    along = along + times_x(dot_of(v, direction));
    for (std::size_t i = 0; i < 3; ++i) point[i] = point[i] + times_x(TrigForm(v[i]));
  }

  Forms point, direction, moment;
  TrigForm square, along;
};

/// Returns B_i of the loop.
LinkFrame behind_joint(const ArmChain& chain, const LinkFrame& target, std::size_t i) {
  return i + 1 < chain.size() ? chain[i + 1].origin
                              : compose(inverse(target), chain.front().origin);
}

/// Returns B_iJ_{i+1}…B_{k−1}, around the loop.
LinkFrame frame_between(const ArmChain& chain, const LinkFrame& target, std::size_t i,
                        std::size_t k, std::span<const Interval> unknowns) {
  LinkFrame frame;
  for (;;) {
    frame = compose(frame, behind_joint(chain, target, i));
    i = (i + 1) % chain.size();
    if (i == k) return frame;
    frame = compose(frame, chain[i].moved(chain[i].value_at(unknowns)));
  }
}

/// Which waves the joints of the chain have. A joint whose unknown is left out has none.
struct Waves {
  Waves(const ArmChain& chain, const CoupledChoice& choice)
      : unknown(chain.size(), kFour), wave(chain.size(), 0) {
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const auto at = std::ranges::find(choice.searched, chain[i].unknown);
      if (at == choice.searched.end()) continue;
      unknown[i] = std::size_t(at - choice.searched.begin());
      if (chain[i].turns) wave[i] = wave_of(chain[i].factor, bases[unknown[i]]);
    }
  }

  /// A whole number of times the frequency 1, or a frequency of its own, or the negative of it.
  static long wave_of(const Interval& factor, std::vector<Interval>& bases) {
    if (bases.empty()) bases.emplace_back(1.0);
    if (factor.lo == factor.hi && factor.lo == std::trunc(factor.lo) &&
        std::fabs(factor.lo) < double(kMostWaves))
      return long(factor.lo);
    for (long r = 1, wave = kWaveBase; std::size_t(r) < bases.size(); ++r, wave *= kWaveBase) {
      if (factor == bases[std::size_t(r)]) return wave;
      if (factor == -bases[std::size_t(r)]) return -wave;
    }
    long wave = 1;
    for (std::size_t r = 0; r < bases.size(); ++r) wave *= kWaveBase;
    bases.push_back(factor);
    return wave;
  }

  std::vector<std::size_t> unknown;  ///< by joint: its place among those searched
  std::vector<long> wave;
  WaveBases bases;
};

/// The line of axis b seen from axis a, through the joints from one to the other.
class Sides {
 public:
  Sides(ArmChain chain, LinkFrame target, const CoupledChoice& choice)
      : arm_{std::move(chain), target}, choice_(choice), waves_(arm_.chain, choice) {
    move_origins(arm_, nullptr);
  }

  [[nodiscard]] LineForms between() const {
    LineForms line(arm_.chain[choice_.b].axis);
    for (std::size_t i = choice_.b;;) {
      i = (i + arm_.chain.size() - 1) % arm_.chain.size();
      line.move(behind_joint(arm_.chain, arm_.target, i));
      if (i == choice_.a) return line;
      pass(line, i, 1);
    }
  }
  [[nodiscard]] LineForms around() const {
    LineForms line(arm_.chain[choice_.b].axis);
    for (std::size_t i = choice_.b;;) {
      line.move(inverse(behind_joint(arm_.chain, arm_.target, i)));
      i = (i + 1) % arm_.chain.size();
      if (i == choice_.a) return line;
      pass(line, i, -1);
    }
  }

 private:
  /// Applies a joint, or its inverse for the sign −1.
  void pass(LineForms& line, std::size_t i, int sign) const {
    const ArmJoint& joint = arm_.chain[i];
    if (joint.turns)
      line.turn(joint.axis, waves_.unknown[i], sign * waves_.wave[i]);
    else
      line.slide(Interval(sign) * (joint.factor * joint.axis), waves_.unknown[i]);
  }

  ArmLoop arm_;
  const CoupledChoice choice_;
  const Waves waves_;
};

std::vector<TrigForm> equations_of(const ArmChain& chain, const LinkFrame& target,
                                   const CoupledChoice& choice) {
  const Sides sides(chain, target, choice);
  const LineForms one = sides.between(), other = sides.around();
  const Vector3& k = chain[choice.a].axis;
  const auto difference = [&](const Vector3& u, Forms LineForms::*part) {
    return dot_of(u, one.*part) - dot_of(u, other.*part);
  };
  if (chain[choice.a].turns)
    return {difference(k, &LineForms::point), difference(k, &LineForms::direction),
            one.square - other.square, one.along - other.along, difference(k, &LineForms::moment)};
  const Vector3 e = cross(k, farthest_unit(k)), f = cross(k, e);
  return {difference(e, &LineForms::point), difference(f, &LineForms::point),
          difference(e, &LineForms::direction), difference(f, &LineForms::direction),
          difference(k, &LineForms::direction)};
}

}  // namespace

TrigForms coupled_equations(const ArmChain& chain, const LinkFrame& target,
                            const CoupledChoice& choice) {
  return {equations_of(chain, target, choice), Waves(chain, choice).bases};
}

std::size_t terms_of(const ArmChain& chain, const LinkFrame& target, const CoupledChoice& choice) {
  std::size_t terms = 0;
  for (const TrigForm& form : equations_of(chain, target, choice))
    terms += std::size_t(std::ranges::count_if(
        form.terms(), [](const auto& term) { return mag(term.second) > kCounted; }));
  return terms;
}

CoupledAxes::Rows CoupledAxes::rows_of(std::size_t unknowns, bool turns) {
  if (unknowns == kFour) return {{0, 1, 2, 3}, {4}};
  return turns ? Rows{{0, 2}, {}} : Rows{{0, 1}, {}};
}

std::optional<RootSystem::Values> CoupledAxes::at(std::size_t lane) const {
  const std::size_t n = rows_.searched.size();
  Box box = boxes_[lane];
  box.resize(kFour, Interval(0.0));
  const TrigForms::Values functions = equations_->functions_at(box);
  const auto derivative = [&](std::size_t equation, std::initializer_list<std::size_t> by) {
    std::array<std::size_t, kFour> orders{};
    for (const std::size_t unknown : by) ++orders[unknown];
    return equations_->value(equation, functions, orders);
  };
  Values values;
  for (const std::size_t e : rows_.searched) {
    values.value.push_back(derivative(e, {}));
    for (std::size_t j = 0; j < n; ++j) values.by_unknown.push_back(derivative(e, {j}));
  }
  for (const std::size_t e : rows_.also) values.also.push_back(derivative(e, {}));
  for (std::size_t k = 0; has_rates_ && k < n; ++k)
    for (const std::size_t e : rows_.searched)
      for (std::size_t j = 0; j < n; ++j) values.rates_by_unknown.push_back(derivative(e, {j, k}));
  return values;
}

PairInLoop pair_in_loop(const ArmChain& chain, const LinkFrame& target, const CoupledChoice& choice,
                        std::span<const Interval> searched) {
  std::vector<Interval> values(kJoints, Interval(0.0));
  for (std::size_t i = 0; i < searched.size(); ++i) values[choice.searched[i]] = searched[i];
  return {chain[choice.a], chain[choice.b],
          frame_between(chain, target, choice.a, choice.b, values),
          inverse(frame_between(chain, target, choice.b, choice.a, values))};
}

}  // namespace regulus::detail
