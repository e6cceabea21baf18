// SPDX-License-Identifier: GPL-3.0-or-later
// Decides boxes for the search over a branch, in one thread: is there a tube in which the equations
// have exactly one solution for every place of the box?
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/question/closure/branch_tracker.hpp"
#include "runtime/cluster/bytes.hpp"
#include "runtime/existence/branch_tube.hpp"

namespace regulus::detail {

struct ClosureQuestion {
  const Problem& problem;  ///< of the kernel of a ClosedSystem
  const MatrixScaling& scaling;
  ClosedShape shape;
  BranchPoint start;             ///< approximately; of uncertain quantities the middles
  std::vector<Interval> ranges;  ///< by unknown: where its values may be
};

/// The finding about one box. It depends on the box alone.
struct TubeFinding {
  bool is_outside = false, is_undefined = false;
  bool is_lost = false;  ///< the branch could not be followed to the middle of the box
  /// There is no tube even where the motion parameters are at their middles.
  bool is_too_uncertain = false;
  std::optional<BranchTube> tube{};
  std::vector<double> impact{};  ///< by variable; empty: not known
};

/// Returns the tube with a larger radius if exactly one solution is in it for every place of `box`;
/// nullopt if this is not shown. The tube comes without a radius.
///
/// Rounding  outward; MXCSR at nearest.
struct TubeTrial {
  SystemBoxes::Box box;  ///< of the variables
  BranchTube tube;
  std::vector<double> inverse;
};

/// Finds the radius of 1…8 tubes, so that the test of branch_tube.hpp holds with some room.
class TubeFinder {
 public:
  /// `least_radius`: relative to 1 or to the unknown.
  TubeFinder(SystemBoxes& system, const ClosedShape& shape, std::vector<Interval> ranges,
             double least_radius = 0x1p-44)
      : system_(system), shape_(shape), ranges_(std::move(ranges)), least_radius_(least_radius) {}

  /// Requires  at most kLanes trials, and as many findings.
  /// Ensures   a finding has a tube only if the test holds for it over its box.
  void find(std::span<const TubeTrial> trials, std::span<TubeFinding> findings);

  /// A system over a tube for which the test holds.
  struct Measured {
    std::vector<double> inverse;  ///< K of the test
    TubeImage image;
    SystemBoxes::System over;
    std::vector<Interval> center_by_unknown;  ///< encloses Φ_p(x₀, c)
  };
  /// Evaluates at most kLanes tubes over their boxes, with other inverses than the trials'; nullopt:
  /// the test does not hold with them.
  [[nodiscard]] std::vector<std::optional<Measured>> measure(std::span<const TubeTrial> tubes);

 private:
  [[nodiscard]] std::vector<std::optional<SystemBoxes::System>> centers_of(
      std::span<const TubeTrial> trials);
  [[nodiscard]] SystemBoxes::Box reach_of(const TubeTrial& trial,
                                          const std::vector<double>& radius) const;

  SystemBoxes& system_;
  const ClosedShape shape_;
  const std::vector<Interval> ranges_;
  const double least_radius_;
};

/// A judge of boxes (runtime/search/box_judges.hpp). Each thread has its own.
class TubeJudge {
 public:
  using Box = SystemBoxes::Box;
  using Question = ClosureQuestion;
  using Finding = TubeFinding;

  /// The parts of the question must outlive this object.
  explicit TubeJudge(const ClosureQuestion& question)
      : question_(question),
        system_(question.problem, question.scaling, question.shape),
        finder_(system_, question.shape, question.ranges, kRadiusForNeighbours) {}
  TubeJudge(const TubeJudge&) = delete;
  TubeJudge& operator=(const TubeJudge&) = delete;

  /// Requires  at most kLanes boxes, and as many findings, which are new.
  /// Rounding  outward; MXCSR at nearest.
  void judge(std::span<const Box> boxes, std::span<TubeFinding> findings, double horizon);

  static void put(cluster::ByteWriter& to, const TubeFinding& finding);
  /// Throws    MalformedMessage.
  [[nodiscard]] static TubeFinding take(cluster::ByteReader& from, const ClosureQuestion& question);

 private:
  /// Above what rounding makes of a solution's radius: a tube of a leaf must hold it.
  static constexpr double kRadiusForNeighbours = 0x1p-36;

  void measure_uncertainty(std::span<const TubeTrial> trials, std::span<TubeFinding> tubes);

  const ClosureQuestion question_;
  SystemBoxes system_;
  TubeFinder finder_;
};

}  // namespace regulus::detail
