// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/platform_poses.hpp"

#include <fmt/format.h>

#include <chrono>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/model/exact/exact_double.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/question/solve/arm_chain.hpp"
#include "codegen/question/solve/interval_matrices.hpp"
#include "codegen/question/solve/nominal.hpp"
#include "codegen/question/solve/platform_legs.hpp"
#include "codegen/question/solve/pose_search.hpp"
#include "codegen/question/solve/system_solutions.hpp"
#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/solutions/gough_poses.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

constexpr const char* kTheoremOfForty =
    "by the theorem that a platform on six legs has at most 40 isolated complex poses (Ronga & "
    "Vust 1995; Lazard 1993; Mourrain 1993), of which 40 are certain";
constexpr const char* kTheoremOfPairs =
    "by the theorem that a platform on six legs that meet in pairs has at most 16 isolated complex "
    "poses (of Bezout), of which 16 are certain";

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Interval norm(const Interval& x, const Interval& y) { return sqrt(sqr(x) + sqr(y)); }

/// The origin of the platform is within this distance from the middle of the anchor of the base.
Interval reach_of(const Model& model, const ExtensibleLeg& leg, const ex& most_square) {
  const NominalGeometry nominal(model);
  const auto all = [&](const ex& x) { return enclose_uncertain(model, x, "an anchor"); };
  const auto shift = [&](const ex& x) {
    return all(x) - enclose_constant(nominal.at(x), "an anchor");
  };
  return sqrt(enclose_constant(most_square, "a length")) +
         norm(all(leg.platform[0]), all(leg.platform[1])) +
         norm(shift(leg.base[0]), shift(leg.base[1]));
}

/// The rows of the inverse Jacobian: unit vectors along the legs, and their moments.
std::vector<Interval> matrix_at(const GoughLegs& legs, const GoughPose& pose) {
  const Matrix3 R = rotation_matrix(pose.rotation);
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

std::vector<Interval> values_of(const GoughPose& pose) {
  std::vector<Interval> values(pose.position.begin(), pose.position.end());
  values.insert(values.end(), pose.rotation.begin(), pose.rotation.end());
  return values;
}

CertainSolution solution_at(const GoughLegs& legs, const GoughPose& pose) {
  CertainSolution solution{values_of(pose)};
  const std::vector<Interval> matrix = matrix_at(legs, pose);
  solution.sign = sign_of_determinant(matrix, 6);
  std::vector<double> middles;
  for (const Interval& entry : matrix) middles.push_back(mid(entry));
  solution.condition = approx_condition(middles, 6);
  return solution;
}

void list(Solutions& solutions, const GoughLegs& legs, const std::vector<GoughPose>& poses) {
  solutions.found.clear();
  for (const GoughPose& pose : poses) solutions.found.push_back(solution_at(legs, pose));
  sort_by_values(solutions.found);
}

std::string place_of(const GoughPose& pose) {
  return fmt::format("x = {:.6g}, y = {:.6g}, z = {:.6g}", mid(pose.position[0]),
                     mid(pose.position[1]), mid(pose.position[2]));
}

std::string obstacle_of(const PoseList& list, const GoughPoses& counted) {
  if (!list.is_searched)
    return fmt::format(
        "{} complex poses are certain, and a platform on such legs may have {}; its anchors are "
        "too special "
        "for a search",
        counted.complex, counted.most);
  if (list.stopped_by) return describe(*list.stopped_by);
  return fmt::format("{} near {}",
                     list.is_doubtful ? "two poses are not told apart"
                                      : "several poses meet, or there are infinitely many,",
                     place_of(list.open.front()));
}

/// For a platform that has fewer complex poses than the theorem allows. Returns the poses if these are all.
std::vector<GoughPose> search_poses(Solutions& solutions, const GoughLegs& legs,
                                    const GoughPoses& counted, const SolveRun& run) {
  PoseList found = search_poses(legs, root_settings_of(run), run.progress);
  solutions.boxes = found.boxes;
  solutions.stopped_by = found.stopped_by;
  if (found.is_complete) {
    list(solutions, legs, found.poses);
    solutions.completeness = Completeness::kComplete;
    solutions.how =
        fmt::format("by a search of {} boxes over all rotations", in_thousands(found.boxes));
    return std::move(found.poses);
  }
  if (found.poses.size() > solutions.found.size()) list(solutions, legs, found.poses);
  for (const GoughPose& box : found.open) solutions.open.push_back(values_of(box));
  solutions.obstacle = obstacle_of(found, counted);
  return {};
}

/// Widens the poses of the nominal legs to where they are within tolerances and errors.
void follow(Solutions& solutions, const Request& request, const GoughLegs& legs,
            const std::vector<GoughPose>& poses, const RootSettings& settings, Observer* progress) {
  const GoughLegs uncertain = enclose_uncertain_legs(request);
  const PoseTubes tubes = follow_poses(legs, uncertain, poses, settings, progress);
  solutions.boxes += tubes.boxes;
  solutions.found.clear();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!tubes.tubes[i]) continue;
    CertainSolution& solution = solutions.found.emplace_back(solution_at(legs, poses[i]));
    for (const Interval& value : solution.values) solution.middle.push_back(mid(value));
    solution.values = values_of(*tubes.tubes[i]);
  }
  sort_by_values(solutions.found);
  if (tubes.are_all) {
    solutions.how += fmt::format(
        ", and by a search of {} boxes, none of which has a singular pose within the tolerances "
        "and "
        "errors",
        in_thousands(tubes.boxes));
    return;
  }
  solutions.completeness = Completeness::kIncomplete;
  solutions.stopped_by = tubes.stopped_by;
  solutions.open.clear();
  for (const GoughPose& box : tubes.open) solutions.open.push_back(values_of(box));
  const std::string why = tubes.stopped_by ? describe(*tubes.stopped_by)
                          : tubes.open.empty()
                              ? "the tolerances are too large for a search"
                              : "within them two may meet near " + place_of(tubes.open.front());
  solutions.obstacle = fmt::format("without tolerances and errors {} pose{} all; {}", poses.size(),
                                   poses.size() == 1 ? " is" : "s are", why);
}

Solutions poses_in_space(const Request& request, const SolveRun& run) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  const auto start = Clock::now();
  const GoughLegs legs = enclose_legs(request);
  run.begin();
  const GoughPoses counted = find_gough_poses(legs);
  std::vector<GoughPose> poses = counted.poses;
  Solutions solutions;
  for (std::size_t i = 0; i < 3; ++i)
    solutions.unknowns.push_back({request.model.pose[i].name, request.model.pose[i].unit});
  for (const char* name : {"qw", "qx", "qy", "qz"}) solutions.unknowns.push_back({name, "1"});
  list(solutions, legs, counted.poses);
  solutions.complex_found = counted.complex;
  if (counted.is_complete()) {
    solutions.completeness = Completeness::kComplete;
    solutions.is_counted = true;
    solutions.how = counted.most == kPosesOfGough ? kTheoremOfForty : kTheoremOfPairs;
  } else {
    poses = search_poses(solutions, legs, counted, run);
  }
  if (has_tolerances(request)) {
    solutions.is_nominal = solutions.completeness != Completeness::kComplete;
    RootSettings left = root_settings_of(run);
    left.time_limit -= seconds_since(start);
    if (!solutions.is_nominal) follow(solutions, request, legs, poses, left, run.progress);
  }
  for (const ApproxPose& pose : counted.approx)
    solutions.roots.emplace_back(pose.begin(), pose.end());
  solutions.seconds = seconds_since(start);
  return solutions;
}

}  // namespace

Request planar_request(const Request& request) {
  Request closed;
  Model& model = closed.model;
  model.name = request.model.name;
  model.path = request.model.path;
  model.sha256 = request.model.sha256;
  model.geometry = request.model.geometry;
  model.balls = request.model.balls;
  Closure& closure = model.closure.emplace();
  closure.unknowns = request.model.pose;
  const NominalGeometry nominal(request.model);
  const std::vector<ex> squares = squared_lengths(request), errors = errors_of_squares(request);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const auto& vector = request.model.legs[i].vector;
    ex square = squares[i];
    if (!errors[i].is_zero()) {
      const std::string name = fmt::format("square_of_leg_{}_error", i + 1);
      const GiNaC::realsymbol error(name);
      model.geometry.push_back({error, name, 0, errors[i], "", -1});
      square += error;
    }
    closure.equations.push_back((pow(vector[0], 2) + pow(vector[1], 2) - square).expand());
  }
  const ExtensibleLeg& leg = request.model.legs.front();
  const ex reach = exact_number(reach_of(request.model, leg, squares.front() + errors.front()).hi);
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
  if (request.model.legs.size() != 3) return poses_in_space(request, run);
  PreparedSystem prepared =
      prepare_system(planar_request(request), 0, run.search, run.watch, DerivativesBy::kUnknowns);
  run.begin();
  return solve_system(prepared, root_settings_of(run, prepared), run.progress);
}

}  // namespace regulus::detail
