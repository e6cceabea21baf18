// SPDX-License-Identifier: Apache-2.0
// The search for all claims about boxes that are not regularity: threads, workers, limits, progress,
// the tree and its continuation. (Regularity has search.hpp.)
//
// A judge (box_judges.hpp) says what is true of a box. A goal knows what is asked: which boxes are
// judged next, and what follows from the findings. A type of goals has
//
//     kJudgesWhenMade          true: boxes are judged when they are made, so that the open ones have
//                              findings, and the root is judged in any case. false: when they are
//                              taken
//     void start(TreeBox root) the root is the only box; it also is if a search ends before the tree
//                              of an earlier run is judged again
//     bool has_ended()         asked before each round
//     void fill(vector<Box>& boxes, uint64_t left)
//                              gives the boxes of the next round; `left`: of the limit. None: the
//                              search ends
//     double horizon()         of the judges; 0 if they have none
//     void conclude(span<Finding>)
//                              about those boxes, in their order. The goal moves what it keeps
//     size_t open()            the number of boxes that are left
//
// and to continue a search, if its boxes are those of a BoxCourse,
//
//     size_t splittable()                  the number of variables, from the first, that are halved
//     void describe(SavedTree&)            adds the open boxes, those that showed more, own numbers
//     void recall(TreeBox, Finding&)       a box that showed more
//     void resume(TreeBox, Finding&, bool is_leaf)
//                                          a leaf, or an open box that has a finding
//     void reopen(TreeBox)                 a box that is not judged yet
//     void resume_own(span<const uint64_t>)                     throws SavedTreeError
//     size_t reopened(span<const uint64_t> own, size_t open)
//                                          if only so many open boxes, the last ones, are not judged
//     void revise(const Box&, Finding&)    if not all findings are of use
//
// A goal whose boxes are not halves of others continues in its own way. In the place of these, but for
// describe(), it has
//
//     bool retrace(const SavedTree&, const JudgeMany&)
//                                          proves again what the text says, and counts the boxes.
//                                          Returns false if judging ended early
//
// Rounds, and so the boxes of a search, do not depend on threads, workers or time.
#pragma once

#include <chrono>
#include <functional>
#include <utility>
#include <vector>

#include "runtime/search/tree_proof.hpp"

namespace regulus::detail {

struct BoxSearchSettings {
  unsigned threads = 1;  ///< at least 1; only the time depends on it
  std::uint64_t max_boxes = std::numeric_limits<std::uint64_t>::max();
  double time_limit = std::numeric_limits<double>::infinity();  ///< seconds
  const std::atomic<bool>* interrupt = nullptr;
  /// Judge boxes, too; null: only the threads do. Only the time depends on it.
  cluster::Workers* workers = nullptr;
  std::uint64_t boxes_before_workers = BoxSharing{}.boxes_before;
  const SavedTree* from = nullptr;  ///< continue from there
  /// Called between rounds, now and then and when the search stops.
  std::function<void(const SavedTree&)> save{};
  double save_every = 10;  ///< seconds, at most, between two saves
};

/// A box of a search that halves boxes.
struct TreeBox {
  BoxId id = 0;
  std::uint32_t depth = 0;
  std::vector<Interval> box;
};

/// Moves the last `count` open boxes into a round, the last one first, and adds them to `boxes`.
inline void take_last(std::vector<TreeBox>& open, std::size_t count, std::vector<TreeBox>& round,
                      std::vector<std::vector<Interval>>& boxes) {
  for (; count > 0; --count) {
    boxes.push_back(open.back().box);
    round.push_back(std::move(open.back()));
    open.pop_back();
  }
}

/// Returns the variable with the greatest impact, or else with the widest part of its range; nullopt
/// if none can be halved. `ranges`: the widths of the ranges of the variables, from the first, that
/// are halved. `impact`: by variable; NaN, or an empty list: not known. A variable is not halved if
/// it has at most the part `least` of its range.
[[nodiscard]] std::optional<std::size_t> choose_variable(std::span<const Interval> box,
                                                         std::span<const double> ranges,
                                                         std::span<const double> impact,
                                                         double least);

/// What a search counts, obeys, tells and saves.
class BoxCourse {
 public:
  using Describe = std::function<void(SavedTree&)>;

  /// `progress` may be null. It receives every split before those below it. All must outlive this
  /// object.
  BoxCourse(const Problem& problem, const BoxSearchSettings& settings, Observer* progress)
      : problem_(problem), settings_(settings), progress_(progress) {}

  [[nodiscard]] const BoxSearchSettings& settings() const { return settings_; }
  [[nodiscard]] TreeBox root() const { return {0, 0, problem_.outer}; }
  [[nodiscard]] std::uint64_t boxes() const { return boxes_; }
  [[nodiscard]] double seconds() const;
  [[nodiscard]] std::chrono::steady_clock::time_point deadline() const;
  /// The limit that ended the search; nullopt: none did.
  [[nodiscard]] std::optional<Reason> stopped_by() const { return stopped_by_; }
  /// False: the search ended before the tree of an earlier run was restored.
  [[nodiscard]] bool is_continued() const { return is_continued_; }

  // For goals.

  /// Requires  choose_variable() has chosen it. `at`: where it is cut, which is saved; nullopt: in
  ///           the middle.
  [[nodiscard]] std::pair<TreeBox, TreeBox> split(TreeBox parent, std::size_t variable,
                                                  std::optional<double> at = {});
  /// The box is not split any more.
  void leaf(const TreeBox& box, Rule rule, double bound = std::numeric_limits<double>::infinity());
  /// The same, after the search.
  void leave_open(const TreeBox& box, Rule rule);
  /// Saves the search as it is now, and no more: a limit cuts the next round.
  void save_last(const Describe& describe);
  /// Moves the last open boxes into a round: at most `most`, and `left`. The search is saved before a
  /// limit cuts the round.
  void take_round(std::vector<TreeBox>& open, std::size_t most, std::uint64_t left,
                  std::vector<TreeBox>& round, std::vector<std::vector<Interval>>& boxes,
                  const Describe& describe) {
    std::size_t count = std::min(most, open.size());
    if (count > left) save_last(describe), count = left;
    take_last(open, count, round, boxes);
  }

  // For the search.

  void announce();
  void count(std::uint64_t boxes) { boxes_ += boxes; }
  /// For a goal that continues: so many were judged, which are not those of the tree.
  void recount(std::uint64_t boxes) { boxes_ = boxes; }
  [[nodiscard]] std::uint64_t left() const {
    return settings_.max_boxes - std::min(boxes_, settings_.max_boxes);
  }
  void note_lack_of_memory() { is_out_of_memory_ = true; }
  [[nodiscard]] bool lacks_memory() const { return is_out_of_memory_; }
  void note_lack_of_continuation() { is_continued_ = false; }
  /// True if a limit is reached.
  [[nodiscard]] bool must_stop();
  /// The same without the limit of boxes.
  [[nodiscard]] bool must_pause();
  void tell_progress(std::size_t open);
  void tell_end();
  void save_now_and_then(const Describe& describe);
  void save(const Describe& describe);
  void note_saved() { saved_ = seconds(); }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool stop(Reason reason);
  [[nodiscard]] Statistics statistics() const;

  const Problem& problem_;
  const BoxSearchSettings& settings_;
  Observer* const progress_;
  const Clock::time_point start_ = Clock::now();
  std::uint64_t boxes_ = 0;
  BoxId next_id_ = 1;
  std::optional<Reason> stopped_by_;
  bool is_out_of_memory_ = false, is_continued_ = true, is_saved_last_ = false;
  SavedTree tree_;  ///< without its open boxes
  double saved_ = 0, seconds_of_save_ = 0;
};

template <class Judge, class Goal>
class BoxSearch {
 public:
  /// Judges any number of boxes, and returns false if it ends early.
  using JudgeMany = std::function<bool(std::span<const std::vector<Interval>>,
                                       std::span<typename Judge::Finding>)>;

  /// `most`: the number of boxes of a usual round. All must outlive this object.
  BoxSearch(const typename Judge::Question& question, std::size_t most, BoxCourse& course,
            Goal& goal)
      : problem_(question.problem),
        course_(course),
        goal_(goal),
        judges_(question, course.settings().threads, most, sharing(course.settings())) {}

  /// Throws    SavedTreeError if settings().from is no tree of this problem; the exceptions of the
  ///           workers.
  void run() {
    course_.announce();
    if (!begin()) return;
    while (!goal_.has_ended() && !course_.must_stop())
      if (!judge_round()) break;
    if constexpr (kCanContinue) course_.save(describe());
  }

 private:
  using Finding = typename Judge::Finding;
  static constexpr bool kCanContinue = requires(Goal & goal, SavedTree& tree) {
    goal.describe(tree);
  };

  static BoxSharing sharing(const BoxSearchSettings& settings) {
    return {settings.workers, settings.boxes_before_workers, settings.time_limit,
            settings.interrupt};
  }
  [[nodiscard]] BoxCourse::Describe describe() {
    return [this](SavedTree& tree) { goal_.describe(tree); };
  }

  /// Returns false if the search ends before its first round.
  bool begin() {
    if constexpr (requires(const SavedTree& from, const JudgeMany& judge) {
                    goal_.retrace(from, judge);
                  }) {
      if (const SavedTree* from = course_.settings().from) return retrace(*from);
    } else if constexpr (kCanContinue) {
      if (const SavedTree* from = course_.settings().from) return continue_from(*from);
    }
    goal_.start(course_.root());
    return !Goal::kJudgesWhenMade || judge_round();
  }

  /// Returns false if there was nothing to judge.
  bool judge_round() {
    boxes_.clear();
    goal_.fill(boxes_, course_.left());
    if (boxes_.empty()) return false;
    findings_.assign(boxes_.size(), {});
    course_.count(boxes_.size());
    if (!judges_.judge(boxes_, findings_, goal_.horizon())) course_.note_lack_of_memory();
    goal_.conclude(findings_);
    course_.tell_progress(goal_.open());
    if constexpr (kCanContinue) course_.save_now_and_then(describe());
    return true;
  }

  /// Nothing rests on the text but the splits.
  bool continue_from(const SavedTree& from) {
    const RestoredTree tree(from, problem_.outer, goal_.splittable());
    const std::size_t judged = tree.leaves().size() - reopened(from, tree.open());
    course_.count(tree.size() - (tree.leaves().size() - judged));
    TreeProof<Judge> proof(
        tree, judges_, [this] { return course_.must_pause(); }, revise());
    if (!proof.prove(judged, from.shown)) return give_up();
    for (std::size_t i = 0; i < from.shown.size(); ++i)
      goal_.recall(box_of(tree, from.shown[i]), proof.shown()[i]);
    goal_.resume_own(from.own);
    repeat(tree, proof);
    course_.note_saved();
    return true;
  }

  /// Judging the tree again has ended early.
  bool give_up() {
    if (!course_.must_pause())
      course_.note_lack_of_memory(), static_cast<void>(course_.must_pause());
    course_.note_lack_of_continuation();
    goal_.start(course_.root());
    return false;
  }

  bool retrace(const SavedTree& from) {
    const JudgeMany judge = [this](std::span<const std::vector<Interval>> boxes,
                                   std::span<typename Judge::Finding> findings) {
      for (std::size_t at = 0; at < boxes.size(); at += kJudgedAtOnce) {
        const std::size_t count = std::min(kJudgedAtOnce, boxes.size() - at);
        if (course_.must_pause() ||
            !judges_.judge(boxes.subspan(at, count), findings.subspan(at, count), 0))
          return false;
      }
      return true;
    };
    if (!goal_.retrace(from, judge)) return give_up();
    course_.note_saved();
    course_.tell_progress(goal_.open());
    return true;
  }

  [[nodiscard]] std::size_t reopened(const SavedTree& from, std::size_t open) const {
    if constexpr (requires { goal_.reopened(from.own, open); })
      return std::min(open, goal_.reopened(from.own, open));
    else
      return Goal::kJudgesWhenMade ? 0 : open;
  }
  [[nodiscard]] typename TreeProof<Judge>::Revise revise() const {
    if constexpr (requires(Finding & finding) { goal_.revise(boxes_.front(), finding); })
      return [this](const std::vector<Interval>& box, Finding& f) { goal_.revise(box, f); };
    else
      return {};
  }

  /// Tells of the splits and leaves in their order.
  void repeat(const RestoredTree& tree, TreeProof<Judge>& proof) {
    std::size_t leaf = 0;
    BoxId lower = 1;
    for (const RestoredTree::Step& step : tree.steps()) {
      if (!step.variable) {
        goal_.resume(box_of(tree, step.box), proof.leaves()[leaf++], true);
        continue;
      }
      static_cast<void>(tree.box(lower));  // it can be halved
      static_cast<void>(course_.split(box_of(tree, step.box), *step.variable));
      lower += 2;
    }
    for (; leaf < tree.leaves().size(); ++leaf) {
      TreeBox box = box_of(tree, tree.leaves()[leaf].box);
      if (leaf < proof.leaves().size())
        goal_.resume(std::move(box), proof.leaves()[leaf], false);
      else
        goal_.reopen(std::move(box));
    }
    course_.tell_progress(goal_.open());
  }

  static TreeBox box_of(const RestoredTree& tree, BoxId id) {
    return {id, tree.depth(id), tree.box(id)};
  }

  const Problem& problem_;
  BoxCourse& course_;
  Goal& goal_;
  BoxJudges<Judge> judges_;
  std::vector<std::vector<Interval>> boxes_;
  std::vector<Finding> findings_;
};

}  // namespace regulus::detail
