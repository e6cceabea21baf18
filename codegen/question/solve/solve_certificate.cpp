// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/solve_certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/model/mechanism/serial.hpp"
#include "codegen/question/solve/leg_lines.hpp"
#include "codegen/question/solve/nominal.hpp"
#include "codegen/question/solve/platform_legs.hpp"
#include "codegen/question/solve/system_solutions.hpp"
#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/verifier/verify.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

constexpr const char* kNoSolutionCertain = "no solution is certain, so nothing is claimed";
constexpr const char* kNoProofOfCount =
    "that these are all is shown by a count of complex postures, which has no proof in a file";
constexpr const char* kNoProofOfSlides =
    "a list of postures of an arm with joints that slide has no proof in a file";
constexpr const char* kNoProofOfTolerances =
    "this list is without the tolerances and errors of the file, so it has no proof in a file";
constexpr const char* kAtBorder = "a solution may be at the end of the range of an unknown";

/// The verifier's enclosures of the solutions are within these, also where the given ones are points.
constexpr double kWiderRelative = 0x1p-51, kWiderAbsolute = 0x1p-60;
/// Parts of the width of a tube, which the verifier finds in another way.
constexpr double kWiderTube = 8;
constexpr double kWiderForSearch = 0x1p-36, kUsualCondition = 0x1p-10, kWiderWidth = 0.5,
                 kLeastWider = 0x1p-12;

ex width_of(const Closure& closure, std::size_t unknown) {
  return closure.ranges[unknown].hi - closure.ranges[unknown].lo;
}

const char* verdict_of(const Solutions& solutions) {
  if (solutions.completeness == Completeness::kIncomplete) return format::kIncomplete;
  return solutions.found.empty() ? format::kNone : format::kComplete;
}

/// Requires  MXCSR at nearest.
std::string solution_lines(const Solutions& solutions, double size, bool varies) {
  std::string lines;
  for (const CertainSolution& solution : solutions.found) {
    lines += "solution";
    for (std::size_t i = 0; i < solution.values.size(); ++i) {
      const Interval& x = solution.values[i];
      const double step = kWiderRelative * mag(x) + kWiderAbsolute * (i < 3 ? size : 1) +
                          (varies ? kWiderTube * width_ru(x) + kWiderForSearch * size : 0);
      const Interval wider = x + Interval(-step, step);
      lines += fmt::format(" {:a}:{:a}", wider.lo, wider.hi);
    }
    lines += '\n';
  }
  return lines;
}

/// How far the platform may be from the base.
double size_of(const Request& request, const Solutions& solutions) {
  double size = 0;
  for (const ex& square : squared_lengths(request))
    size = std::max(size, mag(sqrt(enclose_constant(square, "a length"))));
  for (const CertainSolution& solution : solutions.found)
    for (std::size_t i = 0; i < (is_in_plane(request) ? 2U : 3U); ++i)
      size = std::max(size, mag(solution.values[i]));
  return size;
}

/// The roots of the count; without a count the solutions themselves, roughly.
std::vector<std::vector<Complex>> roots_of(const Solutions& solutions) {
  if (solutions.completeness == Completeness::kComplete) return solutions.roots;
  std::vector<std::vector<Complex>> roots;
  for (const CertainSolution& solution : solutions.found) {
    roots.emplace_back();
    for (const Interval& x : solution.values) roots.back().emplace_back(mid(x));
  }
  return roots;
}

std::string root_lines(const std::vector<std::vector<Complex>>& roots) {
  std::string lines;
  for (const auto& root : roots) {
    lines += "root";
    for (const Complex& z : root) lines += fmt::format(" {} {}", z.re, z.im);
    lines += '\n';
  }
  return lines + fmt::format("end {}\n", roots.size());
}

std::string head_with(const Solutions& solutions, const std::string& claim,
                      const std::string& question, const std::string& lines) {
  return head_text(verdict_of(solutions), claim, question + lines);
}

std::string head_of_robot(const Request& request, const Solutions& solutions, const char* robot,
                          const std::string& question, const std::string& lines,
                          std::size_t uncertain = 0) {
  const Model& model = request.model;
  const bool is_arm = model.arm != nullptr;
  return head_with(
      solutions,
      format::describe_solutions_claim({verdict_of(solutions), robot, is_arm ? "posture" : "pose",
                                        is_arm ? "postures" : "poses", solutions.found.size(),
                                        uncertain}),
      fmt::format("model {}\nsha256 {}\nmotion {}\n{}", model.name,
                  model.sha256.empty() ? "-" : model.sha256, request.motion.name, question),
      lines);
}

std::string head_of_platform(const Request& request, const Solutions& solutions,
                             const char* platform, const std::string& lines) {
  const CertifiedLegs legs = certified_legs(request);
  return head_of_robot(request, solutions, platform, legs.lines, lines, legs.uncertain);
}

/// True if the unknown is looked for all around.
bool turns(const Closure& closure, std::size_t unknown) {
  const ex period = period_of(closure, unknown), width = width_of(closure, unknown);
  return !period.is_zero() &&
         !(enclose_constant(width, "a range").hi < enclose_constant(period, "a period").lo);
}

/// Pose parameters have the values of the place. Other parameters become constants.
void fix_parameters(Request& request) {
  Motion& motion = request.motion;
  GiNaC::exmap values;
  for (const MotionParameter& p : motion.parameters)
    if (std::ranges::any_of(request.model.pose,
                            [&](const PoseParameter& q) { return q.symbol.is_equal(p.symbol); }))
      values[p.symbol] = p.range.lo;
    else
      request.model.geometry.push_back({p.symbol, p.name, p.range.lo, 0, "", -1});
  for (ex& x : motion.pose) x = x.subs(values);
  motion.parameters.clear();
}

/// The question at one place: an unknown that turns is looked for within half a turn of the middle of
/// its range, another one in its range.
Request searched_request(const Request& request) {
  Request searched = request;
  searched.motion.alpha = 0;
  Closure& closure = *searched.model.closure;
  for (std::size_t i = 0; i < closure.unknowns.size(); ++i) {
    closure.start[i] = (closure.ranges[i].lo + closure.ranges[i].hi) / 2;
    closure.start_radius[i] =
        (turns(closure, i) ? period_of(closure, i) : width_of(closure, i)) / 2;
  }
  fix_parameters(searched);
  return searched;
}

/// The values of solutions in the lines of a list.
struct Listed {
  std::vector<std::vector<Interval>> tubes;  ///< by solution and unknown
  std::vector<double> sizes;                 ///< a usual size of each unknown
  /// Of solutions that were followed: where they are at the middles of what is uncertain.
  std::vector<std::vector<double>> middles{};
};

/// Wider than the enclosures, so that the verifier's doubles can show that one solution is in each.
///
/// Requires  MXCSR at nearest.
std::vector<std::vector<Interval>> widened(const Solutions& solutions, const Listed& listed,
                                           double part) {
  std::vector<std::vector<Interval>> tubes = listed.tubes;
  for (std::size_t k = 0; k < tubes.size(); ++k) {
    const double worse = std::max(1.0, solutions.found[k].condition * kUsualCondition);
    for (std::size_t i = 0; i < tubes[k].size(); ++i) {
      const double step =
          std::max(part * width_ru(tubes[k][i]), kWiderForSearch * worse * listed.sizes[i]);
      tubes[k][i] += Interval(-step, step);
    }
  }
  return tubes;
}

bool are_disjoint(const std::vector<std::vector<Interval>>& tubes) {
  for (std::size_t a = 0; a < tubes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (std::ranges::equal(tubes[a], tubes[b], [](const Interval& x, const Interval& y) {
            return !certain_disjoint(x, y);
          }))
        return false;
  return true;
}

/// Returns the lines `solution`. Those of solutions that were followed are only so much wider that they
/// stay apart.
std::string lines_of(const Solutions& solutions, const Listed& listed) {
  std::vector<std::vector<Interval>> tubes = widened(solutions, listed, kWiderWidth);
  for (double part = kWiderWidth / 4; !listed.middles.empty() && part > kLeastWider; part /= 4) {
    if (are_disjoint(tubes)) break;
    tubes = widened(solutions, listed, part);
  }
  std::string lines;
  for (const auto& tube : tubes) {
    lines += "solution";
    for (const Interval& x : tube) lines += fmt::format(" {:a}:{:a}", x.lo, x.hi);
    lines += '\n';
  }
  return lines;
}

/// Returns the proof of a search: empty but for where solutions were followed from.
std::string proof_of(const Listed& listed) {
  std::string lines;
  for (const auto& middle : listed.middles) {
    lines += "from";
    for (const double x : middle) lines += fmt::format(" {}", x);
    lines += '\n';
  }
  return lines + "end\n";
}

/// The values of an unknown that turns, in radians, within less than a turn if they are not all around.
std::vector<Interval> angles_of(const Solutions& solutions, std::size_t unknown) {
  const Interval turn = Interval(2.0) * enclose_constant(GiNaC::Pi, "pi");
  const Interval unit = turn / Interval(solutions.unknowns[unknown].period);
  std::vector<Interval> angles;
  std::vector<double> order;
  for (const CertainSolution& solution : solutions.found) {
    const Interval angle = solution.values[unknown] * unit;
    angles.push_back(angle - Interval(std::floor(mid(angle) / mid(turn))) * turn);
    order.push_back(mid(angles.back()));
  }
  std::ranges::sort(order);
  double first = 0, gap = -1;  // the angle after the widest gap
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double before = i == 0 ? order.back() - mid(turn) : order[i - 1];
    if (order[i] - before > gap) gap = order[i] - before, first = order[i];
  }
  for (Interval& angle : angles)
    if (mid(angle) < first) angle += turn;
  return angles;
}

/// Returns x moved by whole periods to be near another number.
double moved_near(double x, double other, double period) {
  return x - std::round((x - other) / period) * period;
}

Listed planar_list(const Request& request, const Solutions& solutions) {
  const std::vector<Interval> angles = angles_of(solutions, 2);
  const double size = size_of(request, solutions), turn = 2 * std::numbers::pi;
  Listed listed{{}, {size, size, 1}};
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const CertainSolution& solution = solutions.found[k];
    listed.tubes.push_back({solution.values[0], solution.values[1], angles[k]});
    if (solution.middle.empty()) continue;
    const double angle = solution.middle[2] * turn / solutions.unknowns[2].period;
    listed.middles.push_back(
        {solution.middle[0], solution.middle[1], moved_near(angle, mid(angles[k]), turn)});
  }
  return listed;
}

// An arm.

std::string expressions(const std::vector<ex>& values) {
  std::string text;
  for (const ex& value : values) text += (text.empty() ? "" : " | ") + expression_text(value);
  return text;
}

/// The rotation row by row, and the place.
template <class Stated>
std::vector<ex> numbers_of(const Placement& placement, const Stated& stated) {
  std::vector<ex> numbers;
  for (unsigned i = 0; i < 3; ++i)
    for (unsigned j = 0; j < 3; ++j) numbers.push_back(stated(placement.R(i, j)));
  for (const ex& x : placement.p) numbers.push_back(stated(x));
  return numbers;
}

/// `solutions`: its unknowns are the joints that are free.
std::string arm_lines(const Request& request, const Solutions& solutions) {
  const Model& model = request.model;
  const NominalGeometry nominal(model);
  const bool is_by_tool = !request.motion.tool.empty();
  const std::vector<ex> pose = is_by_tool ? request.motion.pose : pose_of(request.motion);
  const bool varies = has_tolerances(request);
  std::string joints = varies ? geometry_lines(model, uncertain_names(request)) : "", values;
  const auto stated = [&](const ex& x) { return varies ? x : nominal.at(x); };
  for (std::size_t k = 0; k < model.arm->joints.size(); ++k) {
    const SerialJoint& joint = model.arm->joints[k];
    std::vector<ex> numbers = numbers_of(joint.origin, stated);
    for (const ex& x : joint.axis) numbers.push_back(stated(x));
    const bool is_free = std::ranges::any_of(solutions.unknowns, [&](const SolvedUnknown& unknown) {
      return unknown.name == model.pose[k].name;
    });
    const ex unit = is_in_degrees(model.pose[k].unit) ? one_degree() : ex(1);
    const ex value = is_by_tool && is_free ? ex(0) : nominal.at(pose[k] * unit);
    if (!is_free) numbers.push_back(value);
    joints += (is_free ? "joint " : "held-joint ") + expressions(numbers) + '\n';
    if (is_free) values += "joint-value " + expression_text(value) + '\n';
  }
  if (!is_by_tool) return joints + values;
  return joints + "tip " + expressions(numbers_of(model.arm->tool, stated)) + "\ntool " +
         expressions(request.motion.tool) + '\n';
}

Listed posture_list(const Solutions& solutions) {
  std::vector<std::vector<Interval>> angles;
  for (std::size_t i = 0; i < solutions.unknowns.size(); ++i)
    angles.push_back(angles_of(solutions, i));
  Listed listed{{}, std::vector<double>(angles.size(), 1)};
  for (std::size_t k = 0; k < solutions.found.size(); ++k) {
    auto& tube = listed.tubes.emplace_back();
    for (const auto& of_joint : angles) tube.push_back(of_joint[k]);
  }
  return listed;
}

std::string head_of_arm(const Request& request, const Solutions& solutions,
                        const std::string& lines) {
  return head_of_robot(request, solutions, format::kOfArm, arm_lines(request, solutions), lines,
                       uncertain_names(request).size());
}

// A platform in space.

Listed pose_list(const Request& request, const Solutions& solutions) {
  const double size = size_of(request, solutions);
  Listed listed{{}, {size, size, size, 1, 1, 1, 1}};
  for (const CertainSolution& solution : solutions.found) {
    listed.tubes.push_back(solution.values);
    if (!solution.middle.empty()) listed.middles.push_back(solution.middle);
  }
  return listed;
}

// A closure.

Listed configuration_list(const Request& request, const Solutions& solutions) {
  const Request searched = searched_request(request);
  const Closure& closure = *searched.model.closure;
  std::vector<Interval> periods;  // 0: it does not turn
  std::vector<double> middles;    // of the ranges
  for (std::size_t i = 0; i < closure.unknowns.size(); ++i) {
    periods.push_back(turns(closure, i) ? enclose_constant(period_of(closure, i), "a period")
                                        : Interval(0.0));
    middles.push_back(mid(enclose_constant(closure.start[i], "a range")));
  }
  Listed listed{{}, usual_sizes(solutions)};
  for (const CertainSolution& solution : solutions.found) {
    std::vector<Interval> tube = solution.values;
    std::vector<double> middle = solution.middle;
    for (std::size_t i = 0; i < tube.size(); ++i) {
      if (periods[i] == Interval(0.0)) continue;
      const double period = mid(periods[i]);
      tube[i] -= Interval(std::round((mid(tube[i]) - middles[i]) / period)) * periods[i];
      if (!middle.empty()) middle[i] = moved_near(middle[i], mid(tube[i]), period);
    }
    listed.tubes.push_back(std::move(tube));
    if (!middle.empty()) listed.middles.push_back(std::move(middle));
  }
  return listed;
}

std::string head_of_equations(const Request& request, const Solutions& solutions,
                              const std::string& lines) {
  const Request searched = searched_request(request);
  const std::set<std::string> uncertain = uncertain_names(searched);
  const std::size_t count = claimed_set(searched, uncertain).uncertain;
  return head_with(
      solutions,
      format::describe_solutions_claim({verdict_of(solutions), format::kOfUnknowns, "configuration",
                                        "configurations", solutions.found.size(), count}),
      certified_question(searched, uncertain).text, lines);
}

std::string head_of(const Request& request, const Solutions& solutions, const std::string& lines) {
  if (request.model.arm) return head_of_arm(request, solutions, lines);
  if (request.model.closure) return head_of_equations(request, solutions, lines);
  return head_of_platform(request, solutions,
                          is_in_plane(request) ? format::kOfThreeLegs : format::kOfSixLegs, lines);
}

Listed list_of(const Request& request, const Solutions& solutions) {
  if (request.model.arm) return posture_list(solutions);
  if (request.model.closure) return configuration_list(request, solutions);
  return is_in_plane(request) ? planar_list(request, solutions) : pose_list(request, solutions);
}

std::string obstacle_of(const Request& request, const Solutions& solutions) {
  const bool is_complete = solutions.completeness == Completeness::kComplete;
  if (!is_complete && solutions.found.empty()) return kNoSolutionCertain;
  if (request.model.closure)
    return std::ranges::any_of(
               solutions.found,
               [](const CertainSolution& s) { return s.limits == WithinLimits::kUnknown; })
               ? kAtBorder
               : "";
  if (solutions.is_nominal) return kNoProofOfTolerances;
  if (request.model.arm) {
    if (std::ranges::any_of(request.model.arm->joints, [](const SerialJoint& joint) {
          return joint.kind == JointKind::kPrismatic;
        }))
      return kNoProofOfSlides;
    return solutions.opposite == 0 ? kNoProofOfCount : "";
  }
  return "";
}

struct Trial {
  bool is_verified;
  std::string doubt;  ///< why the verifier may not finish
};

/// Lets the verifier evaluate a few boxes. A solution that is almost a double one stops it before the first.
Trial trial_of(const std::string& head, const std::string& proof) {
  constexpr std::uint64_t kTriedBoxes = 1 << 10;
  std::istringstream text(head + proof);
  verifier::Options options;
  options.max_boxes = kTriedBoxes;
  const verifier::Verification tried = verifier::verify(text, options);
  const bool is_stopped = tried.boxes > kTriedBoxes;
  return {tried.outcome == verifier::Outcome::kVerified,
          tried.outcome == verifier::Outcome::kUnfinished && !is_stopped
              ? "the verifier may not finish: " + tried.reason
              : ""};
}

}  // namespace

ListProof prove_list(const Request& request, const Solutions& solutions) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  ListProof list;
  list.obstacle = obstacle_of(request, solutions);
  if (!list.obstacle.empty()) return list;
  const bool is_arm = request.model.arm != nullptr, varies = has_tolerances(request),
             is_complete = solutions.completeness == Completeness::kComplete,
             is_in_space = !is_arm && !request.model.closure && !is_in_plane(request),
             is_counted = is_in_space && (!is_complete || solutions.is_counted);
  Listed listed = list_of(request, solutions);
  if (!is_complete) listed.middles.clear();
  const auto try_proof = [&](const std::string& lines, const std::string& proof) {
    list.head = head_of(request, solutions, lines);
    list.proof = proof;
    list.obstacle = obstacle_of_head(list.head);
    if (!list.obstacle.empty()) return true;
    const Trial trial = trial_of(list.head, list.proof);
    list.doubt = trial.doubt;
    return trial.is_verified;
  };
  if (is_counted && (try_proof(solution_lines(solutions, size_of(request, solutions), varies),
                               root_lines(roots_of(solutions))) ||
                     listed.middles.empty()))
    return list;
  // A search proves wider tubes. And legs that meet in the middle of the tolerances have 16 complex
  // poses there, and others elsewhere.
  try_proof(lines_of(solutions, listed),
            (is_arm ? fmt::format("opposite {}\n", solutions.opposite) : "") + proof_of(listed));
  return list;
}

}  // namespace regulus::detail
