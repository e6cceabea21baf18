// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/hexapod.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/model/import/body_graph.hpp"
#include "codegen/model/import/serial_text.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using Connections = std::vector<Connection>;

constexpr std::size_t kLegs = 6;
constexpr std::size_t kLongestLeg = 12;

bool are_parallel(const Point& u, const Point& v) {
  return std::ranges::all_of(cross(u, v), [](const GiNaC::ex& e) { return is_certainly_zero(e); });
}

Point difference(const Point& u, const Point& v) { return sum(u, scaled(-1, v)); }

bool coincide(const Point& u, const Point& v) {
  return std::ranges::all_of(difference(u, v),
                             [](const GiNaC::ex& e) { return is_certainly_zero(e); });
}

bool is_on_axis(const Point& point, const Connection& joint) {
  return are_parallel(difference(point, joint.point), joint.axis);
}

std::array<double, 3> approx(const Point& v) {
  return {number_of(reduced(v[0])).approx(), number_of(reduced(v[1])).approx(),
          number_of(reduced(v[2])).approx()};
}

/// The angle between two lines, near zero.
double approx_angle(const Point& u, const Point& v) {
  const auto length = [](const Point& w) {
    const auto [x, y, z] = approx(w);
    return std::hypot(x, y, z);
  };
  return length(cross(u, v)) / (length(u) * length(v));
}

/// The point where two axes meet.
std::optional<Point> meeting(const Connection& a, const Connection& b) {
  const Point normal = reduced(cross(a.axis, b.axis)), between = difference(b.point, a.point);
  const GiNaC::ex square = reduced(dot(normal, normal));
  if (!is_certainly_nonzero(square) || !is_certainly_zero(dot(between, normal)))
    return std::nullopt;
  const GiNaC::ex along = dot(cross(between, b.axis), normal) / square;
  return reduced(sum(a.point, scaled(along, a.axis)));
}

/// The joints on one side of the slider.
struct Turning {
  std::optional<Point> point;  ///< about which they turn
  int freedoms = 0;
};

Turning turning_of(const Connections& joints) {
  Turning result;
  for (const Connection& joint : joints) {
    const bool ball = joint.kind == ConnectionKind::kBall;
    if (ball || joint.kind == ConnectionKind::kUniversal) result.point = joint.point;
    result.freedoms += ball ? 3 : joint.kind == ConnectionKind::kUniversal ? 2 : 1;
  }
  for (std::size_t i = 0; i + 1 < joints.size() && !result.point; ++i)
    result.point = meeting(joints[i], joints[i + 1]);
  for (const Connection& joint : joints) {
    if (!result.point) return {};
    const bool through = joint.kind == ConnectionKind::kRevolute
                             ? is_on_axis(*result.point, joint)
                             : coincide(*result.point, joint.point);
    if (!through) return {};
  }
  return result;
}

class HexapodFinder {
 public:
  HexapodFinder(const Mechanism& mechanism, const std::string& file)
      : graph_(mechanism), file_(file) {}

  std::optional<Hexapod> find(const std::string& base_link) const {
    std::vector<std::size_t> hubs;
    for (std::size_t body = 0; body < graph_.bodies(); ++body) {
      const std::size_t count = graph_.of_body(body).size();
      if (count == kLegs) hubs.push_back(body);
      if (count == 1 || (count > 2 && count != kLegs)) return std::nullopt;
    }
    if (hubs.size() != 2) return std::nullopt;
    if (!base_link.empty() && graph_.body_of(base_link) == hubs[1]) std::swap(hubs[0], hubs[1]);
    Hexapod result;
    result.base = graph_.link_of(hubs[0]);
    result.platform = graph_.link_of(hubs[1]);
    result.home = graph_.placement(result.platform);
    const auto starts = graph_.of_body(hubs[0]);
    for (std::size_t i = 0; i < kLegs; ++i) {
      const auto joints = walk(starts[i], hubs[0], hubs[1]);
      if (!joints) return std::nullopt;
      result.legs[i] = leg_of(*joints, i + 1);
    }
    return result;
  }

 private:
  /// The connections of a leg from the base to the platform.
  std::optional<Connections> walk(std::size_t connection, std::size_t from, std::size_t to) const {
    Connections joints;
    for (std::size_t body = from; joints.size() < kLongestLeg;) {
      const Connection& next = graph_.connections()[connection];
      joints.push_back(next);
      body = next.first == body ? next.second : next.first;
      if (body == to) return joints;
      const auto both = graph_.of_body(body);
      if (body == from || both.size() != 2) return std::nullopt;
      connection = both[0] == connection ? both[1] : both[0];
    }
    return std::nullopt;
  }

  HexapodLeg leg_of(const Connections& joints, std::size_t number) const {
    const auto refuse = [&](const std::string& problem) {
      throw InputError::statement(file_, joints.front().line,
                                  fmt::format("leg {} of the platform {}", number, problem),
                                  "a leg needs a joint that slides, and joints about a point at "
                                  "each end, with six freedoms "
                                  "in all");
    };
    for (const Connection& joint : joints) require_independent(joint, file_);
    const auto slides = [](const Connection& c) { return c.kind == ConnectionKind::kPrismatic; };
    const auto other = [](const Connection& c) { return c.kind == ConnectionKind::kOther; };
    if (std::ranges::count_if(joints, slides) != 1) refuse("has not one joint that slides");
    if (std::ranges::any_of(joints, other)) refuse("has a joint of another type");
    const auto slider = std::ranges::find_if(joints, slides);
    const Turning before = turning_of({joints.begin(), slider});
    const Turning behind = turning_of({slider + 1, joints.end()});
    if (!before.point || !behind.point) refuse("does not turn about one point at each end");
    if (before.freedoms + behind.freedoms < 5)
      refuse(fmt::format("has {} freedoms", before.freedoms + behind.freedoms + 1));
    const Point along = reduced(difference(*behind.point, *before.point));
    // A file may have rounded directions; the model has the line between the ends.
    constexpr double kRounding = 1e-5;
    if (coincide(*before.point, *behind.point) || !(approx_angle(along, slider->axis) < kRounding))
      refuse("does not slide along the line between its ends");
    return {*before.point, *behind.point, slider->name};
  }

  const BodyGraph graph_;
  const std::string& file_;
};

std::string point_text(const Point& point) {
  std::string text;
  for (const GiNaC::ex& x : point)
    text += (text.empty() ? "" : ", ") + toml_number(number_of(reduced(x)));
  return "[" + text + "]";
}

std::string decimal(double value) { return fmt::format("{:.6g}", value + 0.0); }

/// ± a twentieth of the mean length of the legs.
double some_distance(const Hexapod& hexapod) {
  double sum_of_lengths = 0;
  for (const HexapodLeg& leg : hexapod.legs) {
    const auto [x, y, z] = approx(difference(leg.platform, leg.base));
    sum_of_lengths += std::hypot(x, y, z);
  }
  return sum_of_lengths / kLegs / 20;
}

}  // namespace

std::optional<Hexapod> find_hexapod(const Mechanism& mechanism, const std::string& file,
                                    const std::string& base) {
  if (!mechanism.has_loops()) return std::nullopt;
  if (!base.empty() && !mechanism.has_link(base)) return std::nullopt;
  return HexapodFinder(mechanism, file).find(base);
}

std::string hexapod_text(const Hexapod& hexapod, std::vector<std::string>& notes) {
  constexpr std::array<const char*, 6> kPose = {"x", "y", "z", "roll", "pitch", "yaw"};
  std::string base, platform;
  for (const HexapodLeg& leg : hexapod.legs) {
    base += fmt::format("  {}, # {}\n", point_text(leg.base), in_quotes(leg.slider));
    // In a frame at the platform's origin that is parallel to the world's at home.
    platform += fmt::format("  {},\n", point_text(difference(leg.platform, hexapod.home.p)));
  }
  std::string text = fmt::format(
      "[gough] # from {} to {}; the joints that slide are driven\nunit = \"m\"\norientation = "
      "\"roll-pitch-yaw\"\nbase = [\n{}]\nplatform = [\n{}]\n",
      in_quotes(hexapod.base), in_quotes(hexapod.platform), base, platform);
  std::string home = "\n[motion.home] # every joint at zero\n";
  std::string around = "\n[motion.around_home] # a guess: give it the ranges of your robot\n";
  const double distance = some_distance(hexapod);
  for (std::size_t i = 0; i < kPose.size(); ++i) {
    const WrittenNumber at = i < 3 ? number_of(reduced(hexapod.home.p[i])) : WrittenNumber{};
    home += fmt::format("{} = {}\n", kPose[i], toml_number(at));
    around += i < 3 ? fmt::format("{} = [{}, {}]\n", kPose[i], decimal(at.approx() - distance),
                                  decimal(at.approx() + distance))
                    : fmt::format("{} = [\"-5*deg\", \"5*deg\"]\n", kPose[i]);
  }
  notes.emplace_back("angles are zero where every joint of the file is at zero");
  notes.emplace_back(
      "the claim is about the six legs; the joints at their ends may have singular poses "
      "of their own; joint ranges are not taken over");
  return text + home + around;
}

}  // namespace regulus::detail
