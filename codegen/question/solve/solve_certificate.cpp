// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/solve_certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <sstream>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/mechanism/serial.hpp"
#include "codegen/question/solve/arm_lines.hpp"
#include "codegen/question/solve/leg_lines.hpp"
#include "codegen/question/solve/listed_solutions.hpp"
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
constexpr const char* kNoProofOfTolerances =
    "this list is without the tolerances and errors of the file, so it has no proof in a file";
constexpr const char* kTubesOverlap =
    "the tubes of postures overlap, if they have room for a proof";
constexpr const char* kTrialDidNotEnd =
    "the verifier may take long, or not finish: a trial of it did not end";
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

std::string head_of_robot(const Request& request, const Solutions& solutions,
                          const std::string& robot, const std::string& question,
                          const std::string& lines, std::size_t uncertain = 0) {
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

std::string head_of_arm(const Request& request, const Solutions& solutions,
                        const std::string& lines) {
  const CertifiedArm arm = certified_arm(request, solutions);
  return head_of_robot(request, solutions, arm.robot, arm.lines, lines,
                       uncertain_names(request).size());
}

/// Returns the line that says how an arm was searched.
std::string search_line(const Solutions& solutions) {
  if (solutions.opposite != 0) return fmt::format("opposite {}\n", solutions.opposite);
  const std::vector<std::size_t>& pair = *solutions.left_out;
  return pair.empty() ? "left-out none\n" : fmt::format("left-out {} {}\n", pair[0], pair[1]);
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
  if (!request.model.arm || solutions.opposite != 0 || solutions.left_out) return "";
  return kNoProofOfCount;
}

struct Trial {
  bool is_verified;
  std::uint64_t boxes;
  std::string doubt;  ///< why the verifier may not finish
};

constexpr std::uint64_t kTriedBoxes = 1 << 10;

/// Lets the verifier evaluate a few boxes. A solution that is almost a double one stops it before the first.
Trial trial_of(const std::string& head, const std::string& proof, std::uint64_t most_boxes) {
  std::istringstream text(head + proof);
  verifier::Options options;
  options.max_boxes = most_boxes;
  const verifier::Verification tried = verifier::verify(text, options);
  const bool is_stopped = tried.boxes > most_boxes;
  return {tried.outcome == verifier::Outcome::kVerified, tried.boxes,
          tried.outcome != verifier::Outcome::kVerified && !is_stopped
              ? "the verifier may not finish: " + tried.reason
              : ""};
}

/// How much wider the lines of postures within tolerances are than their tubes: by parts of its own width, and of the
/// widest of its posture.
struct TubeWidths {
  bool is_followed;
  double own, widest;
};
/// A verifier that follows postures needs little room; one that shows them in one step has wider tubes of all joints.
constexpr std::array<TubeWidths, 6> kWidthsOfPostures = {{{true, 0.125, 0},
                                                          {true, 0.5, 0.125},
                                                          {false, 0.5, 0},
                                                          {false, 0.5, 0.25},
                                                          {false, 0.5, 1},
                                                          {false, 0.5, 4}}};

struct TriedProof {
  ListProof list;
  bool is_verified = false;
};

TriedProof try_list(const Request& request, const Solutions& solutions) {
  ListProof list;
  bool is_verified = false;
  const bool is_arm = request.model.arm != nullptr, varies = has_tolerances(request),
             is_complete = solutions.completeness == Completeness::kComplete,
             is_in_space = !is_arm && !request.model.closure && !is_in_plane(request),
             is_counted = is_in_space && (!is_complete || solutions.is_counted);
  Listed listed = list_of(request, solutions);
  // A list in space that is not whole is shown pose by pose, and so is one of which some were not followed.
  if ((!is_complete && is_in_space) || listed.middles.size() != listed.tubes.size())
    listed.middles.clear();
  std::uint64_t most_boxes = kTriedBoxes;
  const auto try_proof = [&](const std::string& lines, const std::string& proof) {
    list.head = head_of(request, solutions, lines);
    list.proof = proof;
    list.obstacle = obstacle_of_head(list.head);
    if (!list.obstacle.empty()) return true;
    const Trial trial = trial_of(list.head, list.proof, most_boxes);
    list.doubt = trial.doubt;
    most_boxes -= std::min(most_boxes - kTriedBoxes, trial.boxes);  // all trials share them
    return is_verified = trial.is_verified;
  };
  if (is_counted && (try_proof(solution_lines(solutions, size_of(request, solutions), varies),
                               root_lines(roots_of(solutions))) ||
                     listed.middles.empty()))
    return {list, is_verified};
  // A search proves wider tubes. And legs that meet in the middle of the tolerances have 16 complex
  // poses there, and others elsewhere.
  const std::string search = is_arm ? search_line(solutions) : "";
  if (!is_arm || !varies) {
    try_proof(lines_of(solutions, listed), search + proof_of(listed));
    return {list, is_verified};
  }
  // A line without room is found late: at boxes on its border, after those that are nowhere near it.
  constexpr std::uint64_t kTriedOfSearched = 8, kLeastTried = 1 << 13, kMostTried = 1 << 15;
  most_boxes = std::clamp(kTriedOfSearched * solutions.boxes, kLeastTried, kMostTried);
  ListProof first;  // of those that may be verified, if there is one
  for (const TubeWidths& widths : kWidthsOfPostures) {
    Listed tried = listed;
    if (!widths.is_followed) tried.middles.clear();
    const auto lines = wider_lines_of(solutions, listed, widths.own, widths.widest);
    if (!lines || tried.middles.empty() == widths.is_followed) continue;
    try_proof(*lines, search + proof_of(tried));
    if (is_verified || !list.obstacle.empty()) return {list, is_verified};
    if (first.head.empty() || (list.doubt.empty() && !first.doubt.empty())) first = list;
  }
  if (first.head.empty()) first.obstacle = kTubesOverlap;
  if (first.obstacle.empty() && first.doubt.empty()) first.doubt = kTrialDidNotEnd;
  return {first, is_verified};
}

/// The searches of an arm that the verifier may take in the place of one by all joints: without one that slides and one
/// that turns.
std::vector<std::vector<std::size_t>> pairs_of(const Request& request, const Solutions& solutions) {
  std::vector<std::vector<std::size_t>> pairs;
  const bool is_by_all = solutions.left_out && solutions.left_out->empty();
  if (!is_by_all || solutions.unknowns.size() < 6) return pairs;
  std::vector<std::size_t> slides, turning;
  const std::vector<SerialJoint>& joints = request.model.arm->joints;
  for (std::size_t j = 0, pose = 0; j < joints.size(); ++j) {
    if (joints[j].follows) continue;
    const auto at = std::ranges::find(solutions.unknowns, request.model.pose[pose++].name,
                                      &SolvedUnknown::name);
    const bool has_followers = std::ranges::any_of(joints, [j](const SerialJoint& other) {
      return other.follows && other.follows->leader == j;
    });
    if (at == solutions.unknowns.end() || has_followers) continue;
    (joints[j].kind == JointKind::kPrismatic ? slides : turning)
        .push_back(std::size_t(at - solutions.unknowns.begin()) + 1);
  }
  for (const std::size_t a : slides)
    for (const std::size_t b : turning) pairs.push_back({a, b});
  return pairs;
}

}  // namespace

ListProof prove_list(const Request& request, const Solutions& solutions) {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  if (const std::string obstacle = obstacle_of(request, solutions); !obstacle.empty()) {
    ListProof none;
    none.obstacle = obstacle;
    return none;
  }
  Solutions as = solutions;
  for (const std::vector<std::size_t>& pair : pairs_of(request, solutions)) {
    as.left_out = pair;
    if (TriedProof tried = try_list(request, as); tried.is_verified) return std::move(tried.list);
  }
  return try_list(request, solutions).list;
}

}  // namespace regulus::detail
