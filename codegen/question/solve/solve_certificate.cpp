// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/solve_certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/model/mechanism/serial.hpp"
#include "codegen/question/solve/leg_lines.hpp"
#include "codegen/question/solve/listed_solutions.hpp"
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
constexpr const char* kNoProofOfJoints =
    "a list of postures that a search over all six joints found has no proof in a file";
constexpr const char* kNoProofOfFollowers =
    "a list of postures of an arm with joints that follow others has no proof in a file";
constexpr const char* kNoProofOfFour =
    "a list of postures of an arm that turns about one direction has no proof in a file";
constexpr const char* kNoProofOfTolerances =
    "this list is without the tolerances and errors of the file, so it has no proof in a file";
constexpr const char* kAtBorder = "a solution may be at the end of the range of an unknown";

/// The verifier's enclosures of the solutions are within these, also where the given ones are points.
constexpr double kWiderRelative = 0x1p-51, kWiderAbsolute = 0x1p-60;
/// Parts of the width of a tube, which the verifier finds in another way.
constexpr double kWiderTube = 8;

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
    joints += is_free ? "" : "held-";
    joints += (joint.kind == JointKind::kPrismatic ? "sliding-joint " : "joint ") +
              expressions(numbers) + '\n';
    if (is_free) values += "joint-value " + expression_text(value) + '\n';
  }
  if (!is_by_tool) return joints + values;
  return joints + "tip " + expressions(numbers_of(model.arm->tool, stated)) + "\ntool " +
         expressions(request.motion.tool) + '\n';
}

std::string head_of_arm(const Request& request, const Solutions& solutions,
                        const std::string& lines) {
  return head_of_robot(request, solutions, format::kOfArm, arm_lines(request, solutions), lines,
                       uncertain_names(request).size());
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
  if (!request.model.arm) return "";
  const std::vector<SerialJoint>& joints = request.model.arm->joints;
  if (std::ranges::any_of(joints,
                          [](const SerialJoint& joint) { return joint.follows.has_value(); }))
    return kNoProofOfFollowers;
  if (solutions.unknowns.size() < 6) return kNoProofOfFour;
  if (solutions.opposite != 0) return "";
  const bool all_turn = std::ranges::all_of(
      joints, [](const SerialJoint& joint) { return joint.kind == JointKind::kRevolute; });
  return all_turn ? kNoProofOfCount : kNoProofOfJoints;
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
  const std::string proof =
      (is_arm ? fmt::format("opposite {}\n", solutions.opposite) : "") + proof_of(listed);
  try_proof(lines_of(solutions, listed), proof);
  const ListProof first = list;
  // The verifier's tubes of postures are wider than those that follow the uncertain quantities, of all joints.
  for (const double part : {0.25, 1.0, 4.0}) {
    if (!is_arm || !varies || list.doubt.empty()) break;
    if (const auto lines = wider_lines_of(solutions, listed, part)) try_proof(*lines, proof);
  }
  return list.doubt.empty() ? list : first;
}

}  // namespace regulus::detail
