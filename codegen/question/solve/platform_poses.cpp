// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/platform_poses.hpp"

#include <fmt/format.h>

#include <chrono>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/model/exact/exact_double.hpp"
#include "codegen/question/solve/arm_chain.hpp"
#include "codegen/question/solve/nominal.hpp"
#include "codegen/question/solve/system_solutions.hpp"
#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/solutions/gough_poses.hpp"

namespace regulus {
namespace {

using GiNaC::ex;

constexpr const char* kTheoremOfForty =
    "by the theorem that a platform on six legs has at most 40 isolated complex poses (Ronga & "
    "Vust 1995; Lazard 1993; Mourrain 1993), of which 40 are certain";
constexpr const char* kTheoremOfPairs =
    "by the theorem that a platform on six legs that meet in pairs has at most 16 isolated complex "
    "poses (of Bezout), of which 16 are certain";

}  // namespace

std::vector<ex> squared_lengths(const Request& request) {
  std::vector<ex> squares;
  for (const ex& length : request.motion.legs) squares.push_back(pow(length, 2));
  if (!squares.empty()) return squares;
  const NominalGeometry nominal(request.model);
  const std::vector<ex> pose = pose_of(request.motion);
  GiNaC::exmap values;
  for (std::size_t i = 0; i < pose.size(); ++i) values[request.model.pose[i].symbol] = pose[i];
  for (const ExtensibleLeg& leg : request.model.legs) {
    ex square = 0;
    for (const ex& part : leg.vector) square += pow(nominal.at(part).subs(values), 2);
    squares.push_back(square);
  }
  return squares;
}

namespace {

Interval norm(const Interval& x, const Interval& y) { return sqrt(sqr(x) + sqr(y)); }

/// The origin of the platform is within this distance from the anchor of the base.
Interval reach_of(const ExtensibleLeg& leg, const NominalGeometry& nominal, const ex& square) {
  const auto at = [&](const ex& x) { return enclose_constant(nominal.at(x), "an anchor"); };
  return sqrt(enclose_constant(square, "a length")) +
         norm(at(leg.platform[0]), at(leg.platform[1]));
}

/// Returns for each anchor the first one that is equal to it, exactly.
template <class AnchorOf>
std::array<std::size_t, 6> points_of(const NominalGeometry& nominal, const AnchorOf& anchor_of) {
  std::array<std::size_t, 6> points{};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto is_same = [&](std::size_t k) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (!nominal.at(anchor_of(i)[axis] - anchor_of(k)[axis]).expand().is_zero()) return false;
      return true;
    };
    while (points[i] < i && !is_same(points[i])) ++points[i];
  }
  return points;
}

GoughLegs enclose_legs(const Request& request) {
  const NominalGeometry nominal(request.model);
  const std::vector<ex> squares = squared_lengths(request);
  GoughLegs legs;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const ExtensibleLeg& leg = request.model.legs[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      legs.base[i][axis] = enclose_constant(nominal.at(leg.base[axis]), "an anchor of the base");
      legs.platform[i][axis] =
          enclose_constant(nominal.at(leg.platform[axis]), "an anchor of the platform");
    }
    legs.length[i] = request.motion.legs.empty()
                         ? sqrt(enclose_constant(squares[i], "a length"))
                         : enclose_constant(request.motion.legs[i], "a length");
  }
  const auto& all = request.model.legs;
  legs.base_point = points_of(nominal, [&](std::size_t i) { return all[i].base; });
  legs.platform_point = points_of(nominal, [&](std::size_t i) { return all[i].platform; });
  return legs;
}

Matrix3 rotation_of(const std::array<Interval, 4>& q) {
  const Interval two(2.0), one(1.0);
  return {one - two * (sqr(q[2]) + sqr(q[3])), two * (q[1] * q[2] - q[0] * q[3]),
          two * (q[1] * q[3] + q[0] * q[2]),   two * (q[1] * q[2] + q[0] * q[3]),
          one - two * (sqr(q[1]) + sqr(q[3])), two * (q[2] * q[3] - q[0] * q[1]),
          two * (q[1] * q[3] - q[0] * q[2]),   two * (q[2] * q[3] + q[0] * q[1]),
          one - two * (sqr(q[1]) + sqr(q[2]))};
}

/// The rows of the inverse Jacobian: unit vectors along the legs, and their moments.
std::vector<Interval> matrix_at(const GoughLegs& legs, const GoughPose& pose) {
  const Matrix3 R = rotation_of(pose.rotation);
  std::vector<Interval> matrix;
  for (std::size_t i = 0; i < 6; ++i) {
    const Vector3 arm = times(R, legs.platform[i]);
    const Vector3 leg = (Interval(1.0) / legs.length[i]) * (arm + pose.position - legs.base[i]);
    const Vector3 moment = cross(arm, leg);
    matrix.insert(matrix.end(), leg.begin(), leg.end());
    matrix.insert(matrix.end(), moment.begin(), moment.end());
  }
  return matrix;
}

CertainSolution solution_at(const GoughLegs& legs, const GoughPose& pose) {
  CertainSolution solution;
  solution.values.assign(pose.position.begin(), pose.position.end());
  solution.values.insert(solution.values.end(), pose.rotation.begin(), pose.rotation.end());
  const std::vector<Interval> matrix = matrix_at(legs, pose);
  solution.sign = sign_of_determinant(matrix, 6);
  std::vector<double> middles;
  for (const Interval& entry : matrix) middles.push_back(mid(entry));
  solution.condition = approx_condition(middles, 6);
  return solution;
}

Solutions count_poses(const Request& request, const SolveRun& run) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  const auto start = std::chrono::steady_clock::now();
  const GoughLegs legs = enclose_legs(request);
  run.begin();
  const GoughPoses poses = find_gough_poses(legs);
  Solutions solutions;
  for (std::size_t i = 0; i < 3; ++i)
    solutions.unknowns.push_back({request.model.pose[i].name, request.model.pose[i].unit});
  for (const char* name : {"qw", "qx", "qy", "qz"}) solutions.unknowns.push_back({name, "1"});
  for (const GoughPose& pose : poses.poses) solutions.found.push_back(solution_at(legs, pose));
  sort_by_values(solutions.found);
  solutions.complex_found = poses.complex;
  for (const ApproxPose& pose : poses.approx)
    solutions.roots.emplace_back(pose.begin(), pose.end());
  solutions.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (poses.is_complete()) {
    solutions.completeness = Completeness::kComplete;
    solutions.how = poses.most == kPosesOfGough ? kTheoremOfForty : kTheoremOfPairs;
  } else {
    solutions.obstacle = fmt::format(
        "{} complex poses are certain, and a platform on such legs may have {}; this one has "
        "fewer, "
        "or "
        "some meet, or are not isolated",
        poses.complex, poses.most);
  }
  return solutions;
}

}  // namespace

Request planar_request(const Request& request) {
  Request closed;
  Model& model = closed.model;
  model.name = request.model.name;
  model.path = request.model.path;
  model.sha256 = request.model.sha256;
  Closure& closure = model.closure.emplace();
  closure.unknowns = request.model.pose;
  const NominalGeometry nominal(request.model);
  const std::vector<ex> squares = squared_lengths(request);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const auto& vector = request.model.legs[i].vector;
    closure.equations.push_back(
        (pow(nominal.at(vector[0]), 2) + pow(nominal.at(vector[1]), 2) - squares[i]).expand());
  }
  const ExtensibleLeg& leg = request.model.legs.front();
  const ex reach = exact_number(reach_of(leg, nominal, squares.front()).hi);
  for (std::size_t i = 0; i < 3; ++i) {
    const ex half = i < 2 ? reach : is_in_degrees(closure.unknowns[i].unit) ? ex(180) : GiNaC::Pi;
    const ex middle = i < 2 ? nominal.at(leg.base[i]) : ex(0);
    closure.ranges.push_back({middle - half, middle + half});
    closure.start.push_back(middle);
  }
  closed.motion.name = request.motion.name;
  return closed;
}

Solutions solve_platform(const Request& request, const SolveRun& run) {
  if (request.model.legs.size() != 3) return count_poses(request, run);
  PreparedSystem prepared =
      prepare_system(planar_request(request), 0, run.search, run.watch, false);
  run.begin();
  return solve_system(prepared, settings_of(prepared, run.search, run.interrupt), run.progress);
}

}  // namespace regulus
