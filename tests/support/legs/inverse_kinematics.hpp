// SPDX-License-Identifier: GPL-3.0-or-later
// The joints of legs that carry a platform, solved in doubles from the legs' description, and their
// rates by differences. None of the code under test.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "tests/support/serial/forward_kinematics.hpp"

namespace regulus::detail::test {

enum class DrivenBy { kLength, kCrank, kCarriage };

/// A leg from A of the base to B of the platform: an actuator, or a rod to the end of a crank or to a
/// carriage on a rail.
struct PlainLeg {
  DrivenBy driven = DrivenBy::kLength;
  Vec base{}, platform{};
  Vec axis{0, 0, 1};  ///< of the crank, or along the rail; of length 1
  double crank = 0, rod = 0;
  bool plus = true;  ///< the working mode
};

inline Vec outer(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The length, the angle of the crank, or the place of the carriage; NaN out of reach.
inline double joint_of(const PlainLeg& leg, const Frame& platform) {
  const Vec e = platform.R * leg.platform + platform.p + -1.0 * leg.base;
  const double square = inner(e, e), along = inner(e, leg.axis), side = leg.plus ? 1 : -1;
  if (leg.driven == DrivenBy::kLength) return std::sqrt(square);
  if (leg.driven == DrivenBy::kCarriage)
    return along + side * std::sqrt(along * along - square + leg.rod * leg.rod);
  // The law of cosines in the plane of the crank, in which e has the length `flat`.
  const double flat = std::sqrt(square - along * along);
  const double cosine =
      (square + leg.crank * leg.crank - leg.rod * leg.rod) / (2 * leg.crank * flat);
  const Vec any = std::fabs(leg.axis[0]) < 0.6 ? Vec{1, 0, 0} : Vec{0, 1, 0};
  const Vec f = any + -inner(any, leg.axis) * leg.axis, g = outer(leg.axis, f);
  return std::atan2(inner(e, g), inner(e, f)) + side * std::acos(cosine);
}

/// The rates of the joint for the six unit twists of the platform; NaN out of reach.
inline std::array<double, 6> rates_of(const PlainLeg& leg, const Frame& platform) {
  constexpr double kStep = 1e-6;
  std::array<double, 6> rates{};
  for (std::size_t k = 0; k < 6; ++k) {
    const auto moved = [&](double step) {
      Frame frame = platform;
      Vec axis{};
      axis.at(k % 3) = 1;
      if (k < 3)
        frame.p = frame.p + step * axis;
      else
        frame.R = turn_about(axis, step) * frame.R;
      return joint_of(leg, frame);
    };
    const double difference = moved(kStep) - moved(-kStep);
    rates.at(k) = std::remainder(difference, 2 * std::acos(-1.0)) / (2 * kStep);
  }
  return rates;
}

}  // namespace regulus::detail::test
