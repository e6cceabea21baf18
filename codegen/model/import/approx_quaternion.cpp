// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/approx_quaternion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "codegen/model/exact/decimal.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

constexpr double kUnit = 1e12;  ///< decimals of a component, the largest being 1

/// The quaternion with the largest component 1, to twelve decimals.
std::vector<WrittenNumber> rounded(const Quaternion& q) {
  double largest = 0;
  for (const double x : q)
    if (std::fabs(x) > std::fabs(largest)) largest = x;
  std::vector<WrittenNumber> result;
  for (const double x : q) {
    const GiNaC::numeric value =
        exact_integer(std::llround(x / largest * kUnit)) / exact_integer(std::llround(kUnit));
    result.push_back({value, decimal_text(value)});
  }
  return result;
}

std::string joined(const std::vector<WrittenNumber>& numbers) {
  std::string text;
  for (const WrittenNumber& number : numbers) text += (text.empty() ? "" : ", ") + number.text;
  return "[" + text + "]";
}

}  // namespace

Quaternion turn_about(const std::array<double, 3>& axis, double angle) {
  const double length = std::hypot(axis[0], axis[1], axis[2]), s = std::sin(angle / 2) / length;
  return {std::cos(angle / 2), s * axis[0], s * axis[1], s * axis[2]};
}

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

bool set_simple_turn(Pose& pose, const Quaternion& q, double tolerance) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  std::size_t axis = 1;
  for (const std::size_t i : {2U, 3U})
    if (std::fabs(q[i]) > std::fabs(q[axis])) axis = i;
  for (const std::size_t i : {1U, 2U, 3U})
    if (i != axis && std::fabs(q[i]) > length * tolerance) return false;
  const double angle = std::remainder(2 * std::atan2(q[axis], q[0]), 2 * std::numbers::pi);
  const long twelfths = std::lround(angle * 12 / std::numbers::pi);
  if (!(std::fabs(angle - static_cast<double>(twelfths) * std::numbers::pi / 12) <= tolerance))
    return false;
  pose.orientation = twelfths == 0 ? OrientationForm::kNone : OrientationForm::kRpy;
  pose.angles.assign(twelfths == 0 ? 0 : 3, WrittenNumber{});
  if (twelfths != 0) pose.angles[axis - 1] = twelfths_of_pi(twelfths);
  return true;
}

bool is_turn_of_cube(const std::vector<WrittenNumber>& q) {
  GiNaC::ex square = 0;
  int count = 0;
  for (const WrittenNumber& x : q) {
    if (x.is_zero()) continue;
    if (++count > 1 && !(x.value * x.value).is_equal(square)) return false;
    square = x.value * x.value;
  }
  return count == 1 || count == 2 || count == 4;
}

bool set_turn_of_cube(Pose& pose, const Quaternion& q, double tolerance) {
  double largest = 0;
  for (const double x : q) largest = std::max(largest, std::fabs(x));
  std::vector<WrittenNumber> components;
  for (const double x : q) {
    const long sign = std::lround(x / largest);
    if (!(std::fabs(x / largest - static_cast<double>(sign)) <= tolerance)) return false;
    components.push_back(whole(sign));
  }
  if (!is_turn_of_cube(components)) return false;
  pose.orientation = OrientationForm::kQuaternion;
  pose.angles = std::move(components);
  return true;
}

void set_approx(Pose& pose, const Quaternion& q, const XmlPlace& place, const std::string& before,
                NumberReader& numbers) {
  if (numbers.tolerance() < GiNaC::numeric(1, 100'000'000'000))
    throw InputError::statement(
        place.file, place.line, place.what + " has no exact numbers that a model can have",
        "allow --snap 1e-11 or more, or write the orientation as a quaternion");
  if (set_simple_turn(pose, q, 1e-11)) {
    const std::string after = pose.angles.empty() ? "no turn" : "rpy " + joined(pose.angles);
    return numbers.record({place.line, place.what, before, after});
  }
  pose.orientation = OrientationForm::kQuaternion;
  pose.angles = rounded(q);
  numbers.record({place.line, place.what, before, "quaternion " + joined(pose.angles)});
}

}  // namespace regulus::detail
