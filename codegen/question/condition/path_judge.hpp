// SPDX-License-Identifier: GPL-3.0-or-later
// Decides boxes for the search of a condition number along a trajectory, in one thread.
#pragma once

#include <span>
#include <vector>

#include "codegen/question/condition/box_judge.hpp"
#include "codegen/question/way/path_variety.hpp"

namespace regulus::detail {

/// The question for a kernel of the matrix at every pose of the hull of the trajectory.
struct PathConditionQuestion {
  const Problem& problem;  ///< of the variety: the search
  const PathVariety& path;
  const MatrixScaling& scaling;  ///< of the kernel's matrix
};

/// A judge of boxes (runtime/search/box_judges.hpp) of a PathVariety. What is true at every pose of a
/// box of the kernel is so on the part of the path in it; only places on the path show a condition
/// number. Each thread has its own.
class PathJudge {
 public:
  using Box = PathVariety::Box;
  using Question = PathConditionQuestion;
  using Finding = BoxFinding;

  /// The parts of the question must outlive this object.
  explicit PathJudge(const PathConditionQuestion& question);
  PathJudge(const PathJudge&) = delete;
  PathJudge& operator=(const PathJudge&) = delete;

  /// As BoxJudge::judge().
  void judge(std::span<const Box> boxes, std::span<BoxFinding> findings, double attained);

  static void put(cluster::ByteWriter& to, const BoxFinding& finding) {
    BoxJudge::put(to, finding);
  }
  /// Throws    MalformedMessage.
  [[nodiscard]] static BoxFinding take(cluster::ByteReader& from,
                                       const PathConditionQuestion& question) {
    return BoxJudge::take(from, {question.problem, question.scaling});
  }
  [[nodiscard]] static double& bound(BoxFinding& finding) { return finding.bound.upper; }

 private:
  void show(std::span<const Box> places, std::span<BoxFinding* const> of, double attained);

  const PathVariety& path_;
  RotatedBoxes rotated_;
  BoxMatrices& matrices_;
};

}  // namespace regulus::detail
