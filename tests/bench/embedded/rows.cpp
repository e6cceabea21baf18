// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/embedded/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "codegen/question/engine/pipeline.hpp"
#include "runtime/embedded/checker.hpp"

namespace regulus::detail::bench {
namespace {

/// A trajectory of robot 1, and the pieces into which the checks divide it.
struct EmbeddedQuestion {
  const char* name;
  const char* motion;
  const char* tolerance;
  unsigned pieces;
  const char* explanation;
  double most_microseconds;  ///< the target
};

constexpr EmbeddedQuestion kQuestions[] = {
    {"T1, exact, whole", "T1", "0", 1, "one parameter, exact geometry", 3},
    {"T2, exact, whole", "T2", "0", 1, "one parameter, exact geometry", 5},
    {"T2, exact, a hundredth", "T2", "0", 100, "what a control loop asks ahead of time", 5},
    {"T2, all uncertainties, whole", "T2_errors", "0.05", 1,
     "anchors ±0.05 cm, control errors 0.01 cm and 0.001 rad", 25},
    {"T2, all uncertainties, a hundredth", "T2_errors", "0.05", 100, "the same", 25},
};

/// Checks a trajectory, piece after piece.
class Trajectory {
 public:
  explicit Trajectory(const EmbeddedQuestion& question)
      : preparation_(prepared_search(question)),
        checker_(preparation_.kernel->functions(), preparation_.variety.outer, kMaxBoxes) {
    if (checker_.kernel().motion_variables != 1)
      throw std::logic_error("a trajectory has one motion parameter");
    const Interval whole = preparation_.variety.outer.front();
    double lo = whole.lo;
    for (unsigned i = 1; i <= question.pieces; ++i) {
      const double hi =
          i == question.pieces ? whole.hi : whole.lo + (whole.hi - whole.lo) * i / question.pieces;
      pieces_.emplace_back(lo, hi);
      lo = hi;
    }
  }

  [[nodiscard]] std::size_t pieces() const noexcept { return pieces_.size(); }
  [[nodiscard]] unsigned most_boxes() const noexcept { return most_boxes_; }

  void check() {
    for (const Interval& piece : pieces_) {
      const Check check = checker_.check({&piece, 1});
      if (check.verdict != Verdict::kNoSingularity) throw std::logic_error("no proof");
      most_boxes_ = std::max(most_boxes_, check.boxes);
    }
  }

 private:
  static constexpr unsigned kMaxBoxes = 1000;

  static PreparedSearch prepared_search(const EmbeddedQuestion& question) {
    ModelOptions options;
    options.path = REGULUS_SOURCE_DIR "/models/robot_1.toml";
    options.motion = question.motion;
    options.tolerances = {fmt::format("base,platform={}", question.tolerance)};
    return prepare(options, {});
  }

  PreparedSearch preparation_;
  Checker checker_;
  std::vector<Interval> pieces_;
  unsigned most_boxes_ = 0;
};

}  // namespace

Section embedded_rows() {
  Section section{"embedded",
                  "A check in a control loop",
                  "`Checker::check` of `runtime/embedded`, robot 1, the kernel in memory, on the "
                  "best instruction set; one check of the whole trajectory or of a piece of it.",
                  {}};
  for (const EmbeddedQuestion& question : kQuestions) {
    Trajectory trajectory(question);
    const Contender only[] = {
        {question.name, static_cast<double>(trajectory.pieces()), [&] { trajectory.check(); }}};
    Row row = timed_row(question.name, compare(only).front(), 1e6, "µs", "");
    row.ratio.reset();
    row.target = value_at_most(question.most_microseconds);
    const unsigned boxes = trajectory.most_boxes();
    row.explanation =
        fmt::format("{}; {} box{} at most", question.explanation, boxes, boxes == 1 ? "" : "es");
    section.rows.push_back(std::move(row));
  }
  return section;
}

}  // namespace regulus::detail::bench
