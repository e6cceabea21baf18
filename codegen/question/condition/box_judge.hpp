// SPDX-License-Identifier: GPL-3.0-or-later
// Decides boxes for the search of a condition number, in one thread.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/question/condition/condition_test.hpp"
#include "codegen/question/condition/stretched_vectors.hpp"
#include "runtime/cluster/bytes.hpp"

namespace regulus::detail {

/// The question for a kernel of the matrix with derivatives of its entries.
struct ConditionQuestion {
  const Problem& problem;
  const MatrixScaling& scaling;  ///< of the kernel's matrix
};

/// A pose of the variety and values of the uncertain quantities, with vectors that show κ there.
struct ConditionWitness {
  std::vector<Interval> variables;  ///< thin, or enclosing the only value
  StretchedVectors shown;
};

/// The finding about one box. It depends on the box alone, but for `attained`.
struct BoxFinding {
  bool is_outside = false, is_undefined = false;
  ConditionBound bound{};
  std::optional<ConditionWitness> attained{};
};

/// Bounds κ over the box of a lane, which has been evaluated and is not outside.
///
/// Rounding  MXCSR at nearest.
void find_bound(RotatedBoxes& boxes, std::size_t lane, BoxFinding& finding);

/// Notes κ at a point, if it is above `attained` and what the finding has.
///
/// Shape     A row-major; encloses the matrix of the problem's kernel there.
/// Rounding  MXCSR at nearest.
void keep_attained(BoxFinding& finding, const std::vector<Interval>& point,
                   std::span<const Interval> A, const Problem& problem, double attained);

/// A judge of boxes (runtime/search/box_judges.hpp). Each thread has its own.
class BoxJudge {
 public:
  using Box = BoxMatrices::Box;
  using Question = ConditionQuestion;
  using Finding = BoxFinding;

  /// The parts of the question must outlive this object.
  explicit BoxJudge(const ConditionQuestion& question);
  BoxJudge(const BoxJudge&) = delete;
  BoxJudge& operator=(const BoxJudge&) = delete;

  /// `attained`, the horizon: a smaller κ is of no use; infinite: no κ is.
  ///
  /// Requires  at most kLanes boxes, and as many findings, which are new.
  /// Rounding  outward; MXCSR at nearest.
  void judge(std::span<const Box> boxes, std::span<BoxFinding> findings, double attained);

  /// ConditionBound::growth is left out: only the judge needs it.
  static void put(cluster::ByteWriter& to, const BoxFinding& finding);
  /// Throws    MalformedMessage.
  [[nodiscard]] static BoxFinding take(cluster::ByteReader& from,
                                       const ConditionQuestion& question);
  [[nodiscard]] static double& bound(BoxFinding& finding) { return finding.bound.upper; }

 private:
  [[nodiscard]] Box corner(const Box& box, Box point, const std::vector<double>& growth) const;

  const Problem& problem_;
  RotatedBoxes rotated_;
  BoxMatrices& matrices_;
};

}  // namespace regulus::detail
