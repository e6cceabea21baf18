// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/read_pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "codegen/model/import/approx_quaternion.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

void require_count(std::size_t found, std::size_t expected, const XmlPlace& place) {
  if (found != expected)
    throw InputError::statement(place.file, place.line,
                                fmt::format("{} has {} numbers", place.what, found),
                                fmt::format("there must be {}", expected));
}

bool is_zero(const WrittenNumber& x) { return x.is_zero(); }

/// True for an angle whose sine and cosine are no roots of rationals.
bool is_generic(const WrittenNumber& angle) {
  return !angle.is_zero() && (angle.text.find("pi") == std::string::npos);
}

void require_direction(const std::array<WrittenNumber, 3>& axis, const XmlPlace& place) {
  if (std::ranges::all_of(axis, is_zero))
    throw InputError::statement(place.file, place.line, place.what + " is zero",
                                "it must have a direction");
}

std::array<double, 3> direction(std::size_t axis) {
  std::array<double, 3> result{};
  result.at(axis) = 1;
  return result;
}

Quaternion of_rpy(const std::vector<WrittenNumber>& rpy) {
  return product(turn_about(direction(2), rpy[2].approx()),
                 product(turn_about(direction(1), rpy[1].approx()),
                         turn_about(direction(0), rpy[0].approx())));
}

std::vector<WrittenNumber> numbers_of(std::string_view text, std::size_t count,
                                      const XmlPlace& place, NumberReader& numbers) {
  std::vector<WrittenNumber> found = numbers.lengths(text, place);
  require_count(found.size(), count, place);
  return found;
}

std::array<double, 3> approx_direction(const WrittenNumber* first, const XmlPlace& place) {
  const std::array<WrittenNumber, 3> exact = {first[0], first[1], first[2]};
  require_direction(exact, place);
  const std::array<double, 3> v = {first[0].approx(), first[1].approx(), first[2].approx()};
  const double length = std::hypot(v[0], v[1], v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

/// The quaternion of the rotation with these columns.
Quaternion of_columns(const std::array<double, 3>& x, const std::array<double, 3>& y,
                      const std::array<double, 3>& z) {
  const double w = 1 + x[0] + y[1] + z[2], a = 1 + x[0] - y[1] - z[2];
  const double b = 1 - x[0] + y[1] - z[2], c = 1 - x[0] - y[1] + z[2];
  const double most = std::max({w, a, b, c});
  const double yz = y[2] - z[1], zx = z[0] - x[2], xy = x[1] - y[0];
  if (most == w) return {w, yz, zx, xy};
  if (most == a) return {yz, a, x[1] + y[0], x[2] + z[0]};
  if (most == b) return {zx, x[1] + y[0], b, y[2] + z[1]};
  return {xy, x[2] + z[0], y[2] + z[1], c};
}

std::string describe_turn(const Pose& pose) {
  std::string text;
  for (const WrittenNumber& number : pose.angles) text += (text.empty() ? "" : ", ") + number.text;
  return (pose.orientation == OrientationForm::kRpy ? "rpy [" : "quaternion [") + text + "]";
}

/// A quaternion of few digits may have been meant as a turn by multiples of pi/12.
void note_near_turn(const Quaternion& q, Snap snap, NumberReader& numbers) {
  constexpr int kCoarsest = -3, kFinest = -8;
  for (int exponent = kFinest; exponent <= kCoarsest; ++exponent) {
    const double tolerance = std::pow(10.0, exponent);
    Pose meant;
    if (!set_simple_turn(meant, q, tolerance) && !set_turn_of_cube(meant, q, tolerance)) continue;
    snap.after = meant.angles.empty() ? "no turn" : describe_turn(meant);
    return numbers.note_near(std::move(snap), exponent);
  }
}

std::array<double, 3> cross(const std::array<double, 3>& u, const std::array<double, 3>& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

}  // namespace

std::array<WrittenNumber, 3> read_vector(std::string_view text, const XmlPlace& place,
                                         NumberReader& numbers) {
  const std::vector<WrittenNumber> found = numbers_of(text, 3, place, numbers);
  return {found[0], found[1], found[2]};
}

std::array<WrittenNumber, 3> read_direction(std::string_view text, const XmlPlace& place,
                                            NumberReader& numbers) {
  std::vector<WrittenNumber> found;
  for (const std::string_view word : words_of(text))
    found.push_back(numbers.component(word, place));
  require_count(found.size(), 3, place);
  std::array<WrittenNumber, 3> axis = {found[0], found[1], found[2]};
  require_direction(axis, place);
  return axis;
}

void set_rpy(Pose& pose, std::string_view text, AngleUnit unit, const XmlPlace& place,
             NumberReader& numbers) {
  std::vector<WrittenNumber> angles = numbers.angles(text, unit, place);
  require_count(angles.size(), 3, place);
  if (std::ranges::all_of(angles, is_zero)) return;
  // Entries of several such turns would be long sums.
  if (!numbers.tolerance().is_zero() && std::ranges::count_if(angles, is_generic) > 1)
    return set_approx(pose, of_rpy(angles), place, std::string(text), numbers);
  pose.orientation = OrientationForm::kRpy;
  pose.angles = std::move(angles);
}

void set_euler(Pose& pose, std::string_view text, const EulerConvention& convention,
               const XmlPlace& place, NumberReader& numbers) {
  const std::vector<WrittenNumber> angles = numbers.angles(text, convention.unit, place);
  require_count(angles.size(), 3, place);
  const auto axis_of = [&](std::size_t i) {
    return static_cast<std::size_t>(std::tolower(convention.sequence.at(i)) - 'x');
  };
  const auto turns = 3 - std::ranges::count_if(angles, is_zero);
  if (turns == 0) return;
  const bool is_rpy = convention.sequence == "XYZ", is_ypr = convention.sequence == "zyx";
  if (turns == 1 || is_rpy || is_ypr) {
    pose.orientation = OrientationForm::kRpy;
    pose.angles.assign(3, WrittenNumber{});
    for (std::size_t i = 0; i < 3; ++i)
      if (!angles[i].is_zero()) pose.angles[axis_of(i)] = angles[i];
    return;
  }
  Quaternion q = {1, 0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const Quaternion next = turn_about(direction(axis_of(i)), angles[i].approx());
    q = std::islower(convention.sequence[i]) != 0 ? product(q, next) : product(next, q);
  }
  set_approx(pose, q, place, std::string(text), numbers);
}

void set_axis_angle(Pose& pose, std::string_view text, AngleUnit unit, const XmlPlace& place,
                    NumberReader& numbers) {
  const auto words = words_of(text);
  require_count(words.size(), 4, place);
  std::vector<WrittenNumber> axis;
  for (std::size_t i = 0; i < 3; ++i) axis.push_back(numbers.length(words[i], place));
  const WrittenNumber angle = numbers.angle(words[3], unit, place);
  const std::array<double, 3> about = approx_direction(axis.data(), place);
  if (angle.is_zero()) return;
  for (std::size_t i = 0; i < 3; ++i) {
    if (axis[(i + 1) % 3].is_zero() && axis[(i + 2) % 3].is_zero()) {
      pose.orientation = OrientationForm::kRpy;
      pose.angles.assign(3, WrittenNumber{});
      pose.angles[i] = about[i] > 0 ? angle : negated(angle);
      return;
    }
  }
  set_approx(pose, turn_about(about, angle.approx()), place, std::string(text), numbers);
}

void set_axes(Pose& pose, std::string_view text, const XmlPlace& place, NumberReader& numbers) {
  const std::vector<WrittenNumber> found = numbers_of(text, 6, place, numbers);
  const std::array<double, 3> x = approx_direction(found.data(), place);
  std::array<double, 3> y = approx_direction(found.data() + 3, place);
  std::array<double, 3> z = cross(x, y);
  const double length = std::hypot(z[0], z[1], z[2]);
  if (!(length > 1e-6))
    throw InputError::statement(place.file, place.line, place.what + " has two parallel axes",
                                "write axes with different directions");
  for (double& component : z) component /= length;
  y = cross(z, x);
  set_approx(pose, of_columns(x, y, z), place, std::string(text), numbers);
}

void set_z_axis(Pose& pose, std::string_view text, const XmlPlace& place, NumberReader& numbers) {
  const std::vector<WrittenNumber> found = numbers_of(text, 3, place, numbers);
  const std::array<double, 3> z = approx_direction(found.data(), place);
  const std::array<double, 3> about = {-z[1], z[0], 0};
  if (found[0].is_zero() && found[1].is_zero()) {
    if (z[2] > 0) return;
    pose.orientation = OrientationForm::kRpy;
    pose.angles = {twelfths_of_pi(12), {}, {}};
    return;
  }
  set_approx(pose, turn_about(about, std::acos(std::clamp(z[2], -1.0, 1.0))), place,
             std::string(text), numbers);
}

void set_quaternion(Pose& pose, std::string_view text, const XmlPlace& place,
                    NumberReader& numbers) {
  std::vector<WrittenNumber> q = numbers_of(text, 4, place, numbers);
  if (std::ranges::all_of(q, is_zero))
    throw InputError::statement(place.file, place.line, place.what + " is zero",
                                "a quaternion must have a direction");
  const Quaternion approx = {q[0].approx(), q[1].approx(), q[2].approx(), q[3].approx()};
  const double tolerance = numbers.tolerance().to_double();
  const Snap snap{place.line, place.what, std::string(text), {}};
  if (tolerance > 0 && (set_simple_turn(pose, approx, tolerance) ||
                        (!is_turn_of_cube(q) && set_turn_of_cube(pose, approx, tolerance)))) {
    if (!pose.angles.empty())
      numbers.record({snap.line, snap.what, snap.before, describe_turn(pose)});
    return;
  }
  if (tolerance > 0 && !is_turn_of_cube(q)) note_near_turn(approx, snap, numbers);
  pose.orientation = OrientationForm::kQuaternion;
  pose.angles = std::move(q);
}

}  // namespace regulus::detail
