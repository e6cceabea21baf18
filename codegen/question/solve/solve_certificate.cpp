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
#include "codegen/model/degrees.hpp"
#include "codegen/model/mechanism/serial.hpp"
#include "codegen/question/solve/leg_lines.hpp"
#include "codegen/question/solve/listed_solutions.hpp"
#include "codegen/question/solve/nominal.hpp"
#include "codegen/question/solve/platform_legs.hpp"
#include "codegen/question/solve/system_solutions.hpp"
#include "codegen/question/solve/turning_tool.hpp"
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

/// The lines of an arm, in the order in which they are written.
class ArmLines {
 public:
  /// `solutions`: its unknowns are the joints that are free.
  ArmLines(const Request& request, const Solutions& solutions)
      : model_(request.model), request_(request), solutions_(solutions), nominal_(request.model) {
    std::size_t next = 0;
    for (const SerialJoint& joint : model_.arm->joints)
      number_.push_back(joint.follows ? 0 : next++);
  }

  [[nodiscard]] std::string text() const {
    std::string text = varies_ ? geometry_lines(model_, uncertain_names(request_)) : "", values;
    for (std::size_t k = 0; k < model_.arm->joints.size(); ++k) {
      text += joint_line(k);
      if (is_free(k)) values += "joint-value " + expression_text(value_of(k)) + '\n';
    }
    text += range_lines();
    if (!is_by_tool_) return text + values;
    return text + "tip " + expressions(stated(model_.arm->tool)) + "\ntool " +
           expressions(request_.motion.tool) + '\n';
  }

  [[nodiscard]] std::string robot() const {
    return format::describe_arm(
        solutions_.unknowns.size(), is_turn_of_tool(model_, model_.pose.size() - 1),
        std::ranges::any_of(model_.arm->joints,
                            [](const SerialJoint& joint) { return joint.follows.has_value(); }),
        !range_lines().empty());
  }

 private:
  [[nodiscard]] ex stated(const ex& x) const { return varies_ ? x : nominal_.at(x); }
  [[nodiscard]] std::vector<ex> stated(const Placement& frame) const {
    return numbers_of(frame, [this](const ex& x) { return stated(x); });
  }
  [[nodiscard]] const PoseParameter& pose(std::size_t joint) const {
    return model_.pose[number_[joint]];
  }
  [[nodiscard]] bool is_free(std::size_t joint) const {
    return !model_.arm->joints[joint].follows &&
           std::ranges::find(solutions_.unknowns, pose(joint).name, &SolvedUnknown::name) !=
               solutions_.unknowns.end();
  }
  /// In lengths or radians. The tool brings free joints to others.
  [[nodiscard]] ex value_of(std::size_t joint) const {
    const ex unit = is_in_degrees(pose(joint).unit) ? one_degree() : ex(1);
    return is_by_tool_ && is_free(joint) ? ex(0) : nominal_.at(values_[number_[joint]] * unit);
  }

  [[nodiscard]] std::string joint_line(std::size_t k) const {
    const SerialJoint& joint = model_.arm->joints[k];
    std::vector<ex> numbers = stated(joint.origin);
    if (!joint.follows && is_turn_of_tool(model_, number_[k]))
      return "turning-tool " + expressions(numbers) + '\n';
    for (const ex& x : joint.axis) numbers.push_back(stated(x));
    if (joint.follows)
      numbers.insert(numbers.end(), {ex(static_cast<unsigned long>(joint.follows->leader + 1)),
                                     joint.follows->multiplier, joint.follows->offset});
    else if (!is_free(k))
      numbers.push_back(value_of(k));
    return fmt::format("{}{} {}\n",
                       joint.follows ? "following-"
                       : is_free(k)  ? ""
                                     : "held-",
                       joint.kind == JointKind::kPrismatic ? "sliding-joint" : "joint",
                       expressions(numbers));
  }

  /// Returns a line for each joint that was looked for in a range.
  [[nodiscard]] std::string range_lines() const {
    std::string text;
    for (std::size_t k = 0; k < solutions_.unknowns.size() && solutions_.left_out; ++k) {
      const auto& range = solutions_.unknowns[k].range;
      if (range && std::ranges::find(*solutions_.left_out, k + 1) == solutions_.left_out->end())
        text += fmt::format("joint-range {} in {} : {}\n", k + 1, range->lo, range->hi);
    }
    return text;
  }

  const Model& model_;
  const Request& request_;
  const Solutions& solutions_;
  const NominalGeometry nominal_;
  const bool is_by_tool_ = !request_.motion.tool.empty(), varies_ = has_tolerances(request_);
  const std::vector<ex> values_ = is_by_tool_ ? request_.motion.pose : pose_of(request_.motion);
  std::vector<std::size_t> number_;  ///< by joint: its parameter of the pose, if it follows none
};

std::string head_of_arm(const Request& request, const Solutions& solutions,
                        const std::string& lines) {
  const ArmLines arm(request, solutions);
  return head_of_robot(request, solutions, arm.robot(), arm.text(), lines,
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
  constexpr std::uint64_t kTriedOfSearched = 8, kMostTried = 1 << 15;
  most_boxes = std::clamp(kTriedOfSearched * solutions.boxes, kTriedBoxes, kMostTried);
  ListProof first;
  for (const TubeWidths& widths : kWidthsOfPostures) {
    Listed tried = listed;
    if (!widths.is_followed) tried.middles.clear();
    const auto lines = wider_lines_of(solutions, listed, widths.own, widths.widest);
    if (!lines || tried.middles.empty() == widths.is_followed) continue;
    try_proof(*lines, search + proof_of(tried));
    if (list.doubt.empty()) return {list, is_verified};
    if (first.head.empty()) first = list;
  }
  if (first.head.empty()) first.obstacle = kTubesOverlap;
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
