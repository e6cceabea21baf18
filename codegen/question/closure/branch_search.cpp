// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/branch_search.hpp"

#include <algorithm>
#include <utility>

#include "runtime/problem/observers.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kBoxesOfRound = 256;
constexpr double kSlackOfWidth = 1 + 0x1p-30;
/// If no branch leads to a box after so many splits, there may be a singular configuration on the way;
/// it is looked for again where there are so many for each parameter.
constexpr std::uint32_t kSplitsBeforeDoubt = 6, kSplitsBeforeAsking = 10;
/// And it is looked for in all of the motion after so many boxes: of many variables the boxes become
/// small late.
constexpr std::uint64_t kBoxesBeforeAsking = 512;

/// The goal of the search: box_search.hpp. The last box that was made is judged first.
class BranchGoal {
 public:
  static constexpr bool kJudgesWhenMade = false;

  BranchGoal(BoxCourse& course, const ClosureQuestion& question, const BranchSettings& settings,
             BranchTree& tree)
      : course_(course),
        settings_(settings),
        tree_(tree),
        parameters_(question.shape.parameters),
        variables_(question.shape.variables) {
    for (std::size_t k = 0; k < (settings.paves ? parameters_ : variables_); ++k)
      ranges_.push_back(width_ru(question.problem.outer[k]));
  }

  void start(TreeBox root) { open_.push_back(std::move(root)); }
  [[nodiscard]] bool has_ended() const {
    return open_.empty() || result_.is_refuted || (is_blocked_ && !settings_.paves);
  }

  void fill(std::vector<std::vector<Interval>>& boxes, std::uint64_t left) {
    round_.clear();
    result_.largest_open = std::max<std::uint64_t>(result_.largest_open, open_.size());
    course_.take_round(open_, kBoxesOfRound, left, round_, boxes,
                       [this](SavedTree& tree) { describe(tree); });
  }

  [[nodiscard]] double horizon() const { return 0; }
  [[nodiscard]] std::size_t open() const { return open_.size(); }

  void conclude(std::span<TubeFinding> findings) {
    for (std::size_t i = round_.size(); i-- > 0;) conclude(round_[i], findings[i]);
  }

  [[nodiscard]] std::size_t splittable() const { return ranges_.size(); }
  void describe(SavedTree& tree) const {
    for (const TreeBox& box : open_) tree.add_open(box.id, kInfinity);
    tree.own = {asked_, result_.largest_open};
  }
  void recall(const TreeBox&, TubeFinding&) {}
  /// A box that was undecided, and would be split now, is open again.
  void resume(TreeBox box, TubeFinding& finding, bool) {
    if (finding.is_outside || finding.tube || !variable_to_split(box, finding))
      conclude(box, finding);
    else
      open_.push_back(std::move(box));
  }
  void reopen(TreeBox box) { open_.push_back(std::move(box)); }
  void resume_own(std::span<const std::uint64_t> own) {
    if (own.size() != 2) throw SavedTreeError("the numbers of the search are missing");
    asked_ = own[0];
    result_.largest_open = own[1];
  }

  BranchResult finish() {
    for (TreeBox& box : open_) {
      course_.leave_open(box, Rule::kBlocked);
      tree_.leave({std::move(box)});
    }
    result_.boxes = course_.boxes();
    result_.seconds = course_.seconds();
    result_.stopped_by = course_.stopped_by();
    result_.is_complete =
        open_.empty() && !is_blocked_ && !result_.is_refuted && !course_.lacks_memory();
    result_.is_empty = result_.is_complete && all_outside_;
    if (!result_.is_complete && !is_blocked_ && !result_.is_refuted)
      result_.reason = result_.stopped_by.value_or(Reason::kMemory);
    course_.tell_end();
    return std::move(result_);
  }

 private:
  void conclude(TreeBox& box, TubeFinding& finding) {
    if (finding.is_outside) return leave(box, Rule::kOutside, {});
    if (finding.tube) return leave(box, Rule::kSecondOrder, std::move(finding.tube));
    const auto variable = variable_to_split(box, finding);
    if (!variable) return block(box, finding);
    if (!is_answered(box, finding.is_lost)) return open_.push_back(std::move(box));
    auto [lower, upper] = course_.split(std::move(box), *variable);
    open_.push_back(std::move(upper));
    open_.push_back(std::move(lower));
  }

  [[nodiscard]] std::optional<std::size_t> variable_to_split(const TreeBox& box,
                                                             const TubeFinding& finding) const {
    const bool begins_with_uncertain = finding.is_too_uncertain;
    auto chosen = variable_among(box, finding, begins_with_uncertain);
    return chosen ? chosen : variable_among(box, finding, !begins_with_uncertain);
  }

  /// Chooses one of the uncertain quantities, or else of the motion parameters.
  [[nodiscard]] std::optional<std::size_t> variable_among(const TreeBox& box,
                                                          const TubeFinding& finding,
                                                          bool is_uncertain) const {
    const std::size_t from = is_uncertain ? parameters_ : 0;
    const std::size_t count = (is_uncertain ? ranges_.size() : parameters_) - from;
    std::span<const double> impact = finding.impact;
    if (!impact.empty()) impact = impact.subspan(from, count);
    const auto chosen =
        choose_variable(std::span(box.box).subspan(from), std::span(ranges_).subspan(from, count),
                        impact, settings_.min_relative_width * kSlackOfWidth);
    return chosen ? std::optional(from + *chosen) : std::nullopt;
  }

  /// The occasions of asking where the branch ends, as bits; a checkpoint has those that were used.
  enum Occasion : std::uint64_t {
    kNothing = 0,
    kLost = 1,
    kSmallLost = 2,
    kSmall = 4,
    kAnywhere = 8
  };

  /// It asks once for each occasion. An answer that ends the search, or that a limit cuts, is
  /// none: the box stays open, so that a search which continues asks again.
  [[nodiscard]] bool is_answered(const TreeBox& box, bool is_lost) {
    const bool is_small = box.depth >= kSplitsBeforeAsking * std::max<std::size_t>(parameters_, 1);
    std::uint64_t ask = kNothing;
    if (is_lost && box.depth >= kSplitsBeforeDoubt) ask = kLost;
    if (is_small) ask = is_lost ? kSmallLost : kSmall;
    if (course_.boxes() >= kBoxesBeforeAsking && (asked_ & kAnywhere) == 0) ask = kAnywhere;
    if (ask == kNothing || (asked_ & ask) != 0 || !settings_.ask || result_.is_refuted) return true;
    std::vector<double> place;
    for (std::size_t k = 0; ask != kAnywhere && k < variables_; ++k)
      place.push_back(mid(box.box[k]));
    result_.is_refuted = settings_.ask(place, is_lost);
    if (result_.is_refuted || course_.must_pause()) return false;
    asked_ |= ask;
    return true;
  }

  void leave(TreeBox& box, Rule rule, std::optional<BranchTube> tube) {
    if (rule != Rule::kOutside) all_outside_ = false;
    course_.leaf(box, rule);
    tree_.leave({std::move(box), std::move(tube), rule == Rule::kOutside});
  }

  void block(TreeBox& box, const TubeFinding& finding) {
    if (!is_blocked_) {
      result_.blocking_box = box.box;
      result_.reason = finding.is_undefined ? Reason::kUndefined : Reason::kWidth;
    }
    is_blocked_ = true;
    leave(box, Rule::kBlocked, {});
  }

  BoxCourse& course_;
  const BranchSettings& settings_;
  BranchTree& tree_;
  const std::size_t parameters_, variables_;
  std::vector<double> ranges_;  ///< of the variables that may be halved
  std::vector<TreeBox> open_, round_;
  bool is_blocked_ = false, all_outside_ = true;
  std::uint64_t asked_ = 0;
  BranchResult result_;
};

/// Pairs of leaves on both sides of a cut.
class Neighbours {
 public:
  using Visit = std::function<void(std::size_t, std::size_t, const std::vector<Interval>&)>;
  /// Those below a face are of one tree, those above it of another one or of the same.
  Neighbours(const BranchTree& lower, const BranchTree& upper, const Visit& visit)
      : lower_(lower), upper_(upper), visit_(visit) {}

  void within(BoxId box, const std::vector<Interval>& room) {
    const BranchTree::Node& node = lower_.node(box);
    if (node.variable == BranchTree::kNone) return;
    const auto [lower, upper] = halves(room, node);
    within(node.lower, lower);
    within(node.lower + 1, upper);
    std::vector<Interval> face = room;
    face[node.variable] = Interval(node.at);
    across(node.lower, node.lower + 1, node.variable, face);
  }

  /// `a` is below the face, `b` above it; both reach all of the face.
  void across(BoxId a, BoxId b, std::size_t normal, const std::vector<Interval>& face) {
    const BranchTree::Node &below = lower_.node(a), &above = upper_.node(b);
    if (below.variable == normal) return across(below.lower + 1, b, normal, face);
    if (above.variable == normal) return across(a, above.lower, normal, face);
    if (below.variable != BranchTree::kNone) {
      cut(below, face, [&](std::size_t part, const Box& piece) {
        across(below.lower + part, b, normal, piece);
      });
    } else if (above.variable != BranchTree::kNone) {
      cut(above, face, [&](std::size_t part, const Box& piece) {
        across(a, above.lower + part, normal, piece);
      });
    } else if (below.leaf != BranchTree::kNone && above.leaf != BranchTree::kNone) {
      visit_(below.leaf, above.leaf, face);
    }
  }

 private:
  using Box = std::vector<Interval>;

  static std::pair<Box, Box> halves(const Box& room, const BranchTree::Node& node) {
    std::pair<Box, Box> parts{room, room};
    parts.first[node.variable] = Interval(room[node.variable].lo, node.at);
    parts.second[node.variable] = Interval(node.at, room[node.variable].hi);
    return parts;
  }

  /// The parts of the face in both halves; of one that lies in a half alone, that.
  template <class Part>
  static void cut(const BranchTree::Node& node, const Box& face, const Part& part) {
    const Interval& across = face[node.variable];
    const auto piece = [&](double lo, double hi) {
      Box result = face;
      result[node.variable] = Interval(lo, hi);
      return result;
    };
    if (across.lo < node.at) part(0, piece(across.lo, std::min(across.hi, node.at)));
    if (across.hi > node.at) part(1, piece(std::max(across.lo, node.at), across.hi));
  }

  const BranchTree &lower_, &upper_;
  const Visit& visit_;
};

}  // namespace

void BranchTree::split(BoxId box, std::size_t variable, double at, BoxId lower) {
  nodes_.resize(std::max<std::size_t>(nodes_.size(), lower + 2));
  nodes_[box].variable = variable, nodes_[box].at = at, nodes_[box].lower = lower;
}

std::vector<Split> BranchTree::splits() const {
  std::vector<Split> splits;
  for (BoxId box = 0; box < nodes_.size(); ++box)
    if (const Node& node = nodes_[box]; node.variable != kNone)
      splits.push_back({box, std::uint32_t(node.variable), node.at, node.lower});
  std::ranges::sort(splits, {}, &Split::lower);
  return splits;
}

void BranchTree::leave(BranchLeaf leaf) {
  nodes_.at(leaf.at.id).leaf = leaves_.size();
  leaves_.push_back(std::move(leaf));
}

void BranchTree::for_neighbours(
    const std::vector<Interval>& root,
    const std::function<void(std::size_t, std::size_t, const std::vector<Interval>&)>& visit)
    const {
  const Neighbours::Visit with_tubes = [&](std::size_t a, std::size_t b,
                                           const std::vector<Interval>& face) {
    if (leaves_[a].tube && leaves_[b].tube) visit(a, b, face);
  };
  Neighbours(*this, *this, with_tubes).within(0, root);
}

void BranchTree::for_neighbours_after(
    const BranchTree& next, const std::vector<Interval>& root,
    const std::function<void(std::size_t, std::size_t, const std::vector<Interval>&)>& visit)
    const {
  const Neighbours::Visit with_tubes = [&](std::size_t a, std::size_t b,
                                           const std::vector<Interval>& face) {
    if (leaves_[a].tube && next.leaves_[b].tube) visit(a, b, face);
  };
  Neighbours(*this, next, with_tubes).across(0, 0, 0, root);
}

std::vector<std::size_t> BranchTree::leaves_at(std::span<const Interval> place) const {
  std::vector<std::size_t> found;
  std::vector<BoxId> boxes{0};
  while (!boxes.empty()) {
    const Node& box = node(boxes.back());
    boxes.pop_back();
    if (box.variable == kNone) {
      if (box.leaf != kNone) found.push_back(box.leaf);
      continue;
    }
    if (place[box.variable].hi >= box.at) boxes.push_back(box.lower + 1);
    if (place[box.variable].lo <= box.at) boxes.push_back(box.lower);
  }
  return found;
}

std::optional<std::size_t> BranchTree::leaf_with(std::span<const Interval> box) const {
  BoxId at = 0;
  while (node(at).variable != kNone) {
    const Node& cut = node(at);
    const bool is_above = box[cut.variable].lo >= cut.at;
    if (!is_above && box[cut.variable].hi > cut.at) return std::nullopt;
    at = is_above ? cut.lower + 1 : cut.lower;
  }
  return node(at).leaf == kNone ? std::nullopt : std::optional(node(at).leaf);
}

BranchResult search_branch(const ClosureQuestion& question, const BranchSettings& settings,
                           Observer* progress) {
  BranchTree tree;
  SplitRecorder recorder(tree);
  Observers observers(present({&recorder, progress}));
  BoxCourse course(question.problem, settings, &observers);
  BranchGoal goal(course, question, settings, tree);
  BoxSearch<TubeJudge, BranchGoal>(question, kBoxesOfRound, course, goal).run();
  BranchResult result = goal.finish();
  result.tree = std::move(tree);
  return result;
}

}  // namespace regulus::detail
