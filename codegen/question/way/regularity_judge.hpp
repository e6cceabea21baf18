// SPDX-License-Identifier: GPL-3.0-or-later
// Decides about boxes that enclose parts of a trajectory.
#pragma once

#include <span>
#include <vector>

#include "codegen/question/way/path_steps.hpp"
#include "runtime/cluster/bytes.hpp"
#include "runtime/search/decider.hpp"

namespace regulus::detail {

struct RegularityFinding {
  bool is_decided = false;
  PathStep step{};
  std::vector<TrialOutcome> trials{};  ///< of a batch, in its first box: the threshold learns them
};

/// The kernel of all pieces, and how its boxes are decided.
struct RegularityQuestion {
  const Problem& problem;
  const Settings& settings;
};

/// A judge of boxes (runtime/search/box_judges.hpp). Its horizon is the threshold of costly tests. The
/// last interval of a box is its depth, which says which tests are tried.
class RegularityJudge {
 public:
  using Question = RegularityQuestion;
  using Finding = RegularityFinding;

  static std::size_t intervals(const RegularityQuestion& question) {
    return question.problem.outer.size() + 1;
  }

  explicit RegularityJudge(const RegularityQuestion& question);
  RegularityJudge(const RegularityJudge&) = delete;
  RegularityJudge& operator=(const RegularityJudge&) = delete;

  /// Rounding  to nearest.
  void judge(std::span<const std::vector<Interval>> boxes, std::span<RegularityFinding> findings,
             double threshold);

  static void put(cluster::ByteWriter& to, const RegularityFinding& finding);
  /// Throws    MalformedMessage.
  [[nodiscard]] static RegularityFinding take(cluster::ByteReader& from,
                                              const RegularityQuestion& question);

 private:
  const RowStructure structure_;
  Decider decider_;
  Decisions decisions_;
};

}  // namespace regulus::detail
