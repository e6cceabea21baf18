// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/joint_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/exact/sign.hpp"
#include "codegen/model/way/trajectory.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kSamples = 16;  ///< of a parameter, or of a piece, besides its beginning

std::string shown(const Range& range) {
  std::ostringstream text;
  const auto number = [](const ex& e) { return approx_value(e).value_or(std::nan("")); };
  if (range.lo.is_equal(range.hi))
    text << number(range.lo);
  else
    text << '[' << number(range.lo) << ", " << number(range.hi) << ']';
  return text.str();
}

ex value_at(const PieceOfPose& piece, const numeric& s) {
  ex value = 0;
  for (std::size_t k = piece.power.size(); k-- > 0;) value = value * s + piece.power[k];
  return value + piece.cosine * GiNaC::cos(piece.turn * s) +
         piece.sine * GiNaC::sin(piece.turn * s);
}

class ExcursionFinder {
 public:
  ExcursionFinder(const Model& model, const Motion& motion) : model_(model), motion_(motion) {
    for (const Range& limits : model.limits)
      approx_.push_back({approx_value(limits.lo).value_or(kInfinity),
                         approx_value(limits.hi).value_or(-kInfinity)});
  }

  std::optional<Excursion> find() const {
    for (std::size_t i = 0; i < model_.limits.size(); ++i)
      if (auto found = motion_.trajectory ? along_pieces(i) : in_motion(i)) return found;
    return std::nullopt;
  }

 private:
  /// Returns the excursion if the values leave the limits of joint i.
  std::optional<Excursion> check(std::size_t i, const Range& values) const {
    const Range& limits = model_.limits[i];
    if (!leaves(values, limits)) return std::nullopt;
    const PoseParameter& p = model_.pose[i];
    return Excursion{p.name, p.name + " takes " + shown(values) + " " + p.unit +
                                 ", beyond its limits " + shown(limits) + " " + p.unit};
  }

  std::optional<Excursion> in_motion(std::size_t i) const {
    const ex& value = motion_.pose[i];
    for (const MotionParameter& p : motion_.parameters)
      if (value.is_equal(p.symbol)) return check(i, p.range);
    for (int sample = 0; sample <= kSamples; ++sample) {
      const ex at = value.subs(place(sample), GiNaC::subs_options::no_pattern);
      if (auto found = check(i, {at, at})) return found;
      if (at.is_equal(value)) break;  // a constant
    }
    return std::nullopt;
  }

  /// A sample of the parameters: each at the same share of its range.
  GiNaC::exmap place(int sample) const {
    GiNaC::exmap values;
    for (const MotionParameter& p : motion_.parameters)
      values[p.symbol] = p.range.lo + (p.range.hi - p.range.lo) * numeric(sample, kSamples);
    return values;
  }

  std::optional<Excursion> along_pieces(std::size_t i) const {
    for (const TrajectoryPiece& piece : motion_.trajectory->pieces) {
      const int step = is_straight(piece.pose[i]) ? kSamples : 1;
      for (int sample = 0; sample <= kSamples; sample += step) {
        const ex at = value_at(piece.pose[i], numeric(sample, kSamples));
        if (is_clearly_inside(i, at)) continue;
        auto found = check(i, {at, at});
        if (!found) continue;
        found->file = motion_.trajectory->file;
        found->line = sample == 0 ? piece.first_line : piece.last_line;
        return found;
      }
    }
    return std::nullopt;
  }

  /// A shortcut for files of many way-points; exact signs decide the others.
  bool is_clearly_inside(std::size_t i, const ex& value) const {
    const double slack = 1e-6 * (std::fabs(approx_[i].first) + std::fabs(approx_[i].second));
    const std::optional<double> x = approx_value(value);
    return x && *x > approx_[i].first + slack && *x < approx_[i].second - slack;
  }

  static bool is_straight(const PieceOfPose& piece) {
    return piece.power[2].is_zero() && piece.power[3].is_zero() && piece.cosine.is_zero() &&
           piece.sine.is_zero();
  }

  const Model& model_;
  const Motion& motion_;
  std::vector<std::pair<double, double>> approx_;  ///< the limits
};

}  // namespace

bool leaves(const Range& range, const Range& limits) {
  const auto is_negative = [](const ex& e) {
    return symbols_of(e).empty() && certain_sign(e) == CertainSign::kNegative;
  };
  return is_negative(range.lo - limits.lo) || is_negative(limits.hi - range.hi);
}

std::vector<Range> limits_of_joints(const Model& model) {
  const auto limits = std::ranges::find(model.motions, "limits", &Motion::name);
  if (limits == model.motions.end()) return {};
  std::vector<Range> ranges;
  for (const PoseParameter& p : model.pose)
    for (const MotionParameter& parameter : limits->parameters)
      if (parameter.symbol.is_equal(p.symbol)) ranges.push_back(parameter.range);
  if (ranges.size() != model.pose.size()) ranges.clear();
  return ranges;
}

std::optional<Excursion> find_excursion(const Model& model, const Motion& motion) {
  return ExcursionFinder(model, motion).find();
}

}  // namespace regulus::detail
