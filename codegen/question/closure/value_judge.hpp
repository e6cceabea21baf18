// SPDX-License-Identifier: GPL-3.0-or-later
// One box of a bound over a branch: its tube, the value of the quantity there, and at its middle.
#pragma once

#include "codegen/question/closure/branch_value.hpp"
#include "codegen/question/closure/tube_judge.hpp"

namespace regulus::detail {

struct ValueQuestion {
  const Problem& problem;
  ClosureQuestion closure;
  const BranchValue& value;
};

struct ValueFinding {
  TubeFinding tube;
  double upper = kInfinity;      ///< f is at most that over the tube
  double lower = -kInfinity;     ///< and at least that
  std::vector<double> impact{};  ///< by variable: what a split makes smaller
  /// By variable: the slope of f, roughly; empty: not known. Only the judge needs it.
  std::vector<double> growth{};
  /// By unknown: the solution at the tube's centre is so near to it. Empty: within the tube's radius.
  std::vector<double> near_center{};
  /// A tube over a place of the box alone, its middle if possible, and what f is at least in it.
  std::optional<BranchTube> middle{};
  double attained = -kInfinity;
};

/// True if `tube`, over a part of the box of `leaf`, holds the same solutions: both are continuous, and
/// the one at the centre of `tube` is in `leaf`.
///
/// Requires  tube.at is a place of the box of `leaf`; each has exactly one solution at every place.
/// Shape     near: ValueFinding::near_center.
[[nodiscard]] bool holds_solutions_of(const BranchTube& leaf, const BranchTube& tube,
                                      std::span<const double> near);

/// A judge of boxes (runtime/search/box_judges.hpp). Each thread has its own.
class ValueJudge {
 public:
  using Box = SystemBoxes::Box;
  using Question = ValueQuestion;
  using Finding = ValueFinding;

  /// The parts of the question must outlive this object.
  explicit ValueJudge(const ValueQuestion& question)
      : question_(question),
        tubes_(question.closure),
        system_(question.problem, question.closure.scaling, question.closure.shape),
        finder_(system_, question.closure.shape, question.closure.ranges) {}

  /// Without a middle if `horizon` is infinite.
  void judge(std::span<const Box> boxes, std::span<ValueFinding> findings, double horizon);

  [[nodiscard]] static double& bound(ValueFinding& finding) { return finding.upper; }
  static void inherit(ValueFinding& own, const ValueFinding& above) {
    if (!own.tube.tube) own.tube.tube = above.tube.tube;
  }
  static void put(cluster::ByteWriter& to, const ValueFinding& finding);
  /// Throws    MalformedMessage.
  [[nodiscard]] static ValueFinding take(cluster::ByteReader& from, const ValueQuestion& question);

 private:
  [[nodiscard]] std::vector<Interval> values_of(std::span<const TubeTrial> tubes,
                                                std::span<ValueFinding* const> findings);

  void judge_middles(std::span<const TubeTrial> tubes, std::span<ValueFinding* const> findings);
  [[nodiscard]] BranchPoint place_in(const TubeTrial& trial, const ValueFinding& finding) const;
  [[nodiscard]] Interval singular_value_of(const TubeTrial& trial,
                                           const TubeFinder::Measured& measured,
                                           ValueFinding* finding) const;
  [[nodiscard]] Box middle_of(const Box& box, const std::vector<double>& at) const;

  const ValueQuestion question_;
  TubeJudge tubes_;
  SystemBoxes system_;
  TubeFinder finder_;
};

}  // namespace regulus::detail
