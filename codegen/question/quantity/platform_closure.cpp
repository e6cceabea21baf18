// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/quantity/platform_closure.hpp"

#include <algorithm>

#include "codegen/model/exact/exact_algebra.hpp"
#include "codegen/model/mechanism/closure_matrix.hpp"
#include "codegen/model/mechanism/orientation.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// The start is exact, so any small radius is one.
constexpr int kPartsOfRadius = 1 << 20;
/// No deviation of a closed branch is larger.
constexpr int kFarthest = 1000, kLargestAngle = 1;

class PlatformClosure {
 public:
  explicit PlatformClosure(const Request& given) : given_(given), request_(given) {
    const Model& model = given.model;
    if (model.legs.empty() || model.legs.size() != model.pose.size())
      throw UsageError(
          "finite errors are those of a [closure], or of a platform on six telescopic legs, or on "
          "three in the plane, with its orientation by angles; ask for error, to first order");
    if (!given.motion.reach.empty())
      throw UsageError("finite errors have no motion with 'where'; give its ranges");
    if (!std::ranges::all_of(given.motion.error, [](const ex& e) { return e.is_zero(); }))
      throw UsageError(
          "finite errors are those of the legs and of the geometry: give [actuators] error, and "
          "leave the motion's error of the pose out");
  }

  Request build() {
    for (const GeometryParameter& g : given_.model.geometry) nominal_[g.symbol] = g.value;
    request_.motion.pose.resize(given_.model.pose.size());
    add_unknowns();
    for (std::size_t k = 0; k < given_.model.legs.size(); ++k) add_leg(k);
    set_start();
    Model& model = request_.model;
    model.closure = std::move(closure_);
    model.matrix = closure_matrix(*model.closure);
    model.row_scale.clear(), model.twist.clear(), model.must_be_defined.clear();
    model.actuators = {};
    return std::move(request_);
  }

 private:
  [[nodiscard]] bool is_planar() const { return given_.model.legs.size() == 3; }
  [[nodiscard]] std::size_t dimension() const { return is_planar() ? 2 : 3; }

  void add_unknown(const std::string& of, const std::string& unit) {
    const std::string name = of + "_deviation";
    closure_.unknowns.push_back({GiNaC::realsymbol(name), name, unit});
    closure_.start.emplace_back(0);
    closure_.start_radius.emplace_back(GiNaC::numeric(1, kPartsOfRadius));
    const int most = unit == "rad" ? kLargestAngle : kFarthest;
    closure_.ranges.push_back({-most, most});
  }

  void add_unknowns() {
    for (std::size_t axis = 0; axis < dimension(); ++axis)
      add_unknown(given_.model.pose[axis].name, given_.model.pose[axis].unit);
    if (is_planar())
      add_unknown(given_.model.pose[2].name, "rad");
    else
      for (const char* angle : {"roll", "pitch", "yaw"}) add_unknown(angle, "rad");
  }

  [[nodiscard]] ex unknown(std::size_t i) const { return closure_.unknowns[i].symbol; }

  /// Returns Eᵀv.
  [[nodiscard]] Point turned_back(const Point& v) const {
    if (is_planar()) {
      const ex c = cos(unknown(2)), s = sin(unknown(2));
      return {c * v[0] + s * v[1], c * v[1] - s * v[0], 0};
    }
    const ScaledRotation E =
        scaled_rotation(Orientation::kRollPitchYaw, {unknown(3), unknown(4), unknown(5)});
    return transposed_times(E.S, v);
  }

  /// |Eᵀ(X + e − a) + R·b|² is the squared length, since E keeps lengths.
  void add_leg(std::size_t k) {
    const ExtensibleLeg& leg = given_.model.legs[k];
    const Point a{leg.base[0], leg.base[1], leg.base[2]};
    Point X{0, 0, 0}, moved{0, 0, 0};
    ex commanded = 0, square = 0;
    for (std::size_t axis = 0; axis < dimension(); ++axis) {
      X[axis] = given_.model.pose[axis].symbol;
      moved[axis] = X[axis] + unknown(axis) - a[axis];
      commanded += pow(leg.vector[axis].subs(nominal_), 2);
    }
    const Point back = turned_back(moved);
    for (std::size_t axis = 0; axis < dimension(); ++axis)
      square += pow(back[axis] + (leg.vector[axis] - X[axis] + a[axis]), 2);
    closure_.equations.push_back(square - pow(sqrt(commanded) + error_of_leg(k), 2));
  }

  /// Adds a pose parameter that is commanded to be 0.
  ex error_of_leg(std::size_t k) {
    const std::string name = "leg_" + std::to_string(k + 1);
    const std::vector<ex>& errors = given_.model.actuators.error;
    const PoseParameter error{GiNaC::realsymbol(name), name, given_.model.pose[0].unit, true};
    request_.model.pose.push_back(error);
    request_.motion.pose.emplace_back(0);
    request_.motion.error.resize(request_.motion.pose.size() - 1, 0);
    request_.motion.error.push_back(errors.empty() ? ex(0) : errors[k]);
    return error.symbol;
  }

  /// The first way-point; or the middles of the ranges of pose parameters, and the lower ends of other
  /// parameters.
  void set_start() {
    if (given_.motion.trajectory) return set_start_of_way(*given_.motion.trajectory);
    GiNaC::exmap start;
    for (const MotionParameter& p : given_.motion.parameters) {
      const bool is_pose = std::ranges::any_of(
          given_.model.pose, [&](const PoseParameter& q) { return q.symbol.is_equal(p.symbol); });
      start[p.symbol] = is_pose ? (p.range.lo + p.range.hi) / 2 : p.range.lo;
    }
    for (const ex& value : request_.motion.pose) closure_.start_pose.push_back(value.subs(start));
  }

  /// The errors of the legs are commanded to be 0.
  void set_start_of_way(const Trajectory& way) {
    for (const PieceOfPose& pose : way.pieces.front().pose)
      closure_.start_pose.push_back(pose.power[0] + pose.cosine);
    closure_.start_pose.resize(request_.motion.pose.size(), 0);
  }

  const Request& given_;
  Request request_;
  Closure closure_;
  GiNaC::exmap nominal_;
};

}  // namespace

Request closure_of_platform(const Request& given) { return PlatformClosure(given).build(); }

}  // namespace regulus::detail
