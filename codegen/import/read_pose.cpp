// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/import/read_pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/model/decimal.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::inline importing {
namespace {

void require_count(std::size_t found, std::size_t expected, const XmlPlace& place) {
  if (found != expected)
    throw InputError::statement(place.file, place.line,
                                fmt::format("{} has {} numbers", place.what, found),
                                fmt::format("there must be {}", expected));
}

bool is_generic(const ExactNumber& angle) {
  return !angle.is_zero() && angle.text.find("pi") == std::string::npos;
}

/// The quaternion of Rz(yaw)·Ry(pitch)·Rx(roll), to twelve decimals.
std::vector<ExactNumber> approx_quaternion(const std::vector<ExactNumber>& rpy) {
  std::array<double, 3> c{}, s{};
  for (std::size_t i = 0; i < 3; ++i) {
    c[i] = std::cos(rpy[i].approx() / 2);
    s[i] = std::sin(rpy[i].approx() / 2);
  }
  const std::array<double, 4> q = {
      c[0] * c[1] * c[2] + s[0] * s[1] * s[2], s[0] * c[1] * c[2] - c[0] * s[1] * s[2],
      c[0] * s[1] * c[2] + s[0] * c[1] * s[2], c[0] * c[1] * s[2] - s[0] * s[1] * c[2]};
  std::vector<ExactNumber> result;
  for (const double component : q) {
    const auto rounded = static_cast<std::int64_t>(std::llround(component * 1e12));
    const GiNaC::numeric value = exact_integer(rounded) / exact_integer(1'000'000'000'000);
    result.push_back({value, decimal_text(value)});
  }
  return result;
}

std::string joined(const std::vector<ExactNumber>& numbers) {
  std::string text;
  for (const ExactNumber& number : numbers) text += (text.empty() ? "" : ", ") + number.text;
  return "[" + text + "]";
}

}  // namespace

std::array<ExactNumber, 3> read_vector(std::string_view text, const XmlPlace& place,
                                       NumberReader& numbers) {
  const std::vector<ExactNumber> found = numbers.lengths(text, place);
  require_count(found.size(), 3, place);
  return {found[0], found[1], found[2]};
}

void require_direction(const std::array<ExactNumber, 3>& axis, const XmlPlace& place) {
  if (std::ranges::all_of(axis, &ExactNumber::is_zero))
    throw InputError::statement(place.file, place.line, place.what + " is zero",
                                "an axis must have a direction");
}

void set_rpy(Pose& pose, std::string_view text, AngleUnit unit, const XmlPlace& place,
             NumberReader& numbers) {
  std::vector<ExactNumber> angles = numbers.angles(text, unit, place);
  require_count(angles.size(), 3, place);
  if (std::ranges::all_of(angles, &ExactNumber::is_zero)) return;
  // The quaternion is within 1e-11 of the angles.
  const bool may_move = numbers.tolerance() >= GiNaC::numeric(1, 100'000'000'000);
  if (may_move && std::ranges::count_if(angles, is_generic) > 1) {
    pose.orientation = Orientation::kQuaternion;
    pose.angles = approx_quaternion(angles);
    numbers.record({place.line, place.what, joined(angles), "quaternion " + joined(pose.angles)});
    return;
  }
  pose.orientation = Orientation::kRpy;
  pose.angles = std::move(angles);
}

void set_quaternion(Pose& pose, std::string_view text, const XmlPlace& place,
                    NumberReader& numbers) {
  std::vector<ExactNumber> q = numbers.lengths(text, place);
  require_count(q.size(), 4, place);
  if (std::ranges::all_of(q, &ExactNumber::is_zero))
    throw InputError::statement(place.file, place.line, place.what + " is zero",
                                "a quaternion must have a direction");
  pose.orientation = Orientation::kQuaternion;
  pose.angles = std::move(q);
  if (std::all_of(pose.angles.begin() + 1, pose.angles.end(),
                  [](const ExactNumber& x) { return x.is_zero(); })) {
    pose.orientation = Orientation::kNone;
    pose.angles.clear();
  }
}

}  // namespace regulus::importing
