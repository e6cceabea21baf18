// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/planar_legs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "codegen/model/import/serial_text.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

constexpr std::size_t kPlanarLegs = 3;
constexpr std::size_t kLongestWalk = 12;

/// A joint of a leg in the plane.
struct PlanarJoint {
  std::string name;
  bool slides = false;
  PlanePoint point;  ///< or the direction of a joint that slides
};
using PlanarJoints = std::vector<PlanarJoint>;

bool vanishes(const ex& e) { return is_certainly_zero(e); }

double approx_reduced(const ex& e) { return number_of(reduced(e)).approx(); }

PlanePoint minus(const PlanePoint& a, const PlanePoint& b) { return {a[0] - b[0], a[1] - b[1]}; }
ex cross(const PlanePoint& a, const PlanePoint& b) { return a[0] * b[1] - a[1] * b[0]; }
ex dot(const PlanePoint& a, const PlanePoint& b) { return a[0] * b[0] + a[1] * b[1]; }

/// Equal but for a file's rounding.
bool are_near(const PlanePoint& a, const PlanePoint& b) {
  constexpr double kRounding = 1e-6;
  return std::hypot(approx_reduced(a[0] - b[0]), approx_reduced(a[1] - b[1])) < kRounding;
}

/// The numbers of the two axes of the plane, in the positive sense of its normal.
std::optional<std::array<std::size_t, 2>> plane_of(const std::vector<Connection>& connections) {
  for (std::size_t n = 0; n < 3; ++n) {
    const std::size_t u = (n + 1) % 3, v = (n + 2) % 3;
    const auto lies_in_plane = [&](const Connection& c) {
      if (c.kind == ConnectionKind::kRevolute) return vanishes(c.axis[u]) && vanishes(c.axis[v]);
      return c.kind == ConnectionKind::kBall ||
             (c.kind == ConnectionKind::kPrismatic && vanishes(c.axis[n]));
    };
    const auto turns = [](const Connection& c) { return c.kind == ConnectionKind::kRevolute; };
    if (std::ranges::all_of(connections, lies_in_plane) && std::ranges::any_of(connections, turns))
      return std::array{u, v};
  }
  return std::nullopt;
}

class PlanarFinder {
 public:
  PlanarFinder(const Mechanism& mechanism, const std::string& file,
               const std::vector<std::string>& actuated)
      : graph_(mechanism), file_(file), actuated_(actuated) {}

  std::optional<PlanarRobot> find(const std::string& base_link) {
    const auto plane = plane_of(graph_.connections());
    if (!plane) return std::nullopt;
    axes_ = *plane;
    std::vector<std::size_t> hubs;
    for (std::size_t body = 0; body < graph_.bodies(); ++body) {
      const std::size_t count = graph_.of_body(body).size();
      if (count == kPlanarLegs) hubs.push_back(body);
      if (count == 1 || count > kPlanarLegs) return std::nullopt;
    }
    PlanarRobot robot;
    robot.plane = std::string{"xyz"[axes_[0]], "xyz"[axes_[1]]};
    if (hubs.size() == 2) {
      if (!base_link.empty() && graph_.body_of(base_link) == hubs[1]) std::swap(hubs[0], hubs[1]);
      if (!find_platform(robot, hubs)) return std::nullopt;
    } else if (!hubs.empty() || !find_point(robot, base_link)) {
      return std::nullopt;
    }
    choose_actuated(robot);
    return robot;
  }

 private:
  [[nodiscard]] PlanePoint flat(const Point& p) const {
    return {reduced(p)[axes_[0]], reduced(p)[axes_[1]]};
  }

  bool find_platform(PlanarRobot& robot, const std::vector<std::size_t>& hubs) {
    robot.base = graph_.link_of(hubs[0]);
    robot.platform = graph_.link_of(hubs[1]);
    robot.home = flat(graph_.placement(robot.platform).p);
    for (const std::size_t start : graph_.of_body(hubs[0])) {
      const auto joints = walk(start, hubs[0], hubs[1]);
      if (!joints) return false;
      if (joints->size() != kPlanarLegs) refuse(*joints);
      robot.legs.push_back(leg_of(*joints));
    }
    return true;
  }

  /// One loop of five joints through the base: two legs end in the joint opposite to it.
  bool find_point(PlanarRobot& robot, const std::string& base_link) {
    const std::size_t base = base_link.empty() ? first_in_loop() : graph_.body_of(base_link);
    const auto starts = graph_.of_body(base);
    if (starts.size() != 2) return false;
    const auto joints = walk(starts[0], base, base);
    if (!joints || joints->size() != 5) return false;
    robot.base = graph_.link_of(base);
    const auto& all = *joints;
    robot.legs = {leg_of({all[0], all[1], all[2]}), leg_of({all[4], all[3], all[2]})};
    robot.home = robot.legs.front().end;
    return true;
  }

  [[nodiscard]] std::size_t first_in_loop() const {
    for (std::size_t body = 0; body < graph_.bodies(); ++body)
      if (graph_.of_body(body).size() == 2) return body;
    return 0;
  }

  /// Returns the joints between two bodies. Joints one after another that turn about one point are
  /// one joint: in the plane, the bodies between them have no place of their own.
  [[nodiscard]] std::optional<PlanarJoints> walk(std::size_t connection, std::size_t from,
                                                 std::size_t to) const {
    PlanarJoints joints;
    std::size_t body = from;
    for (std::size_t steps = 0; steps < kLongestWalk; ++steps) {
      const Connection& next = graph_.connections()[connection];
      require_independent(next, file_);
      add(joints, next);
      body = next.first == body ? next.second : next.first;
      if (body == to) return joints;
      const auto both = graph_.of_body(body);
      if (both.size() != 2) return std::nullopt;
      connection = both[0] == connection ? both[1] : both[0];
    }
    return std::nullopt;
  }

  void add(PlanarJoints& joints, const Connection& c) const {
    const bool slides = c.kind == ConnectionKind::kPrismatic;
    const PlanarJoint joint{c.name, slides, flat(slides ? c.axis : c.point)};
    const bool is_same = !joints.empty() && !slides && !joints.back().slides &&
                         are_near(joints.back().point, joint.point);
    if (!is_same) joints.push_back(joint);
  }

  [[noreturn]] void refuse(const PlanarJoints& joints) const {
    std::string kinds, names;
    for (const PlanarJoint& joint : joints) {
      kinds += joint.slides ? 'P' : 'R';
      names += (names.empty() ? "" : ", ") + in_quotes(joint.name);
    }
    throw InputError::statement(
        file_, 0, fmt::format("a leg in the plane has the joints {} ({})", kinds, names),
        "RRR, PRR, and RPR with the slide along the leg are read; write the matrix of other legs "
        "in a model");
  }

  [[nodiscard]] PlanarLeg leg_of(const PlanarJoints& joints) const {
    PlanarLeg leg;
    for (const PlanarJoint& joint : joints) {
      leg.type += joint.slides ? 'P' : 'R';
      leg.names.push_back(joint.name);
    }
    leg.end = joints[2].point;
    leg.elbow = joints[1].point;
    if (leg.type == "RRR") leg.base = joints[0].point;
    if (leg.type == "PRR") leg.base = leg.elbow, leg.slide = joints[0].point;
    if (leg.type == "RPR")
      leg.base = joints[0].point, leg.slide = joints[1].point, leg.actuated = 2;
    const bool is_known =
        leg.type == "RRR" || leg.type == "PRR" || (leg.type == "RPR" && slides_along(leg));
    if (!is_known) refuse(joints);
    const bool is_stretched =
        leg.type == "RRR" && vanishes(cross(minus(leg.end, leg.base), minus(leg.elbow, leg.base)));
    if (is_stretched)
      throw InputError::statement(
          file_, 0,
          fmt::format("the leg of joint {} is stretched or folded with every joint at zero",
                      in_quotes(leg.names.front())),
          "draw the robot with a bend in this leg: the side to which it is bent is its mode");
    return leg;
  }

  static bool slides_along(const PlanarLeg& leg) {
    const PlanePoint along = minus(leg.end, leg.base);
    const double length = std::hypot(approx_reduced(along[0]), approx_reduced(along[1]));
    const double axis = std::hypot(approx_reduced(leg.slide[0]), approx_reduced(leg.slide[1]));
    return length > 0 && std::abs(approx_reduced(cross(along, leg.slide))) < 1e-5 * length * axis;
  }

  void choose_actuated(PlanarRobot& robot) const {
    std::set<std::size_t> chosen;
    for (const std::string& name : actuated_) {
      bool is_found = false;
      for (std::size_t i = 0; i < robot.legs.size() && !is_found; ++i) {
        const auto& names = robot.legs[i].names;
        const auto at = std::ranges::find(names, name);
        if (at == names.end()) continue;
        is_found = true;
        if (!chosen.insert(i).second)
          throw UsageError("--actuated: the leg of " + in_quotes(name) +
                           " has another driven joint already; name one joint of each leg");
        robot.legs[i].actuated = static_cast<int>(at - names.begin()) + 1;
      }
      if (!is_found)
        throw UsageError("--actuated: no leg has the joint " + in_quotes(name) +
                         "; the legs have " + listed(robot));
    }
  }

  static std::string listed(const PlanarRobot& robot) {
    std::vector<std::string> names;
    for (const PlanarLeg& leg : robot.legs)
      for (const std::string& name : leg.names) names.push_back(in_quotes(name));
    return fmt::format("{}", fmt::join(names, ", "));
  }

  const BodyGraph graph_;
  const std::string& file_;
  const std::vector<std::string>& actuated_;
  std::array<std::size_t, 2> axes_{};
};

std::string number_text(const ex& value) { return toml_number(number_of(reduced(value))); }

std::string point_text(const PlanePoint& p) {
  return fmt::format("[{}, {}]", number_text(p[0]), number_text(p[1]));
}

/// Returns the distance between two points, exactly.
std::string distance_text(const PlanePoint& a, const PlanePoint& b) {
  const PlanePoint d = minus(a, b);
  return number_text(sqrt(reduced(dot(d, d))));
}

std::string leg_text(const PlanarLeg& leg, const PlanarRobot& robot) {
  std::string text = fmt::format("\n[[legs.leg]] # {}\ntype = \"{}\"\nbase = {}\n",
                                 fmt::join(leg.names, ", "), leg.type, point_text(leg.base));
  if (!robot.platform.empty())
    text += fmt::format("platform = {}\n", point_text(minus(leg.end, robot.home)));
  if (leg.type == "RRR") {
    const bool is_left =
        approx_reduced(cross(minus(leg.end, leg.base), minus(leg.elbow, leg.base))) > 0;
    text += fmt::format("crank = {}\nrod = {}\nmode = \"{}\"\n", distance_text(leg.elbow, leg.base),
                        distance_text(leg.end, leg.elbow), is_left ? '+' : '-');
  }
  if (leg.type == "PRR") {
    const bool is_farther = approx_reduced(dot(minus(leg.end, leg.base), leg.slide)) < 0;
    text += fmt::format("axis = {}\nrod = {}\nmode = \"{}\"\n", point_text(leg.slide),
                        distance_text(leg.end, leg.elbow), is_farther ? '+' : '-');
  }
  return text + fmt::format("actuated = {}\n", leg.actuated);
}

/// A twentieth of the mean distance between the ends of the legs.
double some_distance(const PlanarRobot& robot) {
  double sum = 0;
  for (const PlanarLeg& leg : robot.legs) {
    const PlanePoint d = minus(leg.end, leg.base);
    sum += std::hypot(approx_reduced(d[0]), approx_reduced(d[1]));
  }
  return sum / static_cast<double>(robot.legs.size()) / 20;
}

std::string motions_text(const PlanarRobot& robot) {
  std::string home = "\n[motion.home] # every joint at zero\n";
  std::string around = "\n[motion.around_home] # a guess: give it the ranges of your robot\n";
  const double distance = some_distance(robot);
  for (std::size_t i = 0; i < 2; ++i) {
    const double at = approx_reduced(robot.home[i]);
    home += fmt::format("{} = {}\n", "xy"[i], number_text(robot.home[i]));
    around += fmt::format("{} = [{:.6g}, {:.6g}]\n", "xy"[i], at - distance, at + distance);
  }
  if (robot.platform.empty()) return home + around;
  return home + "phi = 0\n" + around + "phi = [\"-5*deg\", \"5*deg\"]\n";
}

}  // namespace

std::optional<PlanarRobot> find_planar_robot(const Mechanism& mechanism, const std::string& file,
                                             const std::string& base,
                                             const std::vector<std::string>& actuated) {
  if (!mechanism.has_loops()) return std::nullopt;
  if (!base.empty() && !mechanism.has_link(base)) return std::nullopt;
  return PlanarFinder(mechanism, file, actuated).find(base);
}

std::string planar_text(const PlanarRobot& robot, std::vector<std::string>& notes) {
  std::string text = fmt::format(
      "[legs] # from {} to {}; x y of the model is the plane {} of the file\nunit = \"m\"\n",
      in_quotes(robot.base), robot.platform.empty() ? "a point" : in_quotes(robot.platform),
      robot.plane);
  if (robot.platform.empty()) text += "orientation = \"point\"\n";
  std::vector<std::string> driven;
  for (const PlanarLeg& leg : robot.legs) {
    text += leg_text(leg, robot);
    driven.push_back(in_quotes(leg.names.at(std::size_t(leg.actuated - 1))));
  }
  notes.push_back(fmt::format("driven: {}; --actuated names others", fmt::join(driven, ", ")));
  notes.emplace_back(
      "each leg stays bent to the side that the file draws; joint ranges are not "
      "taken over: write `range` into the legs");
  return text + motions_text(robot);
}

}  // namespace regulus::detail
