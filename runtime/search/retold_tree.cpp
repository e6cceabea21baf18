// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/retold_tree.hpp"

#include <cmath>
#include <limits>

#include "runtime/problem/row_structure.hpp"
#include "runtime/search/round.hpp"

namespace regulus::detail {
namespace {

constexpr double kReasonUnit = 64;
static_assert(kRules < 64);

/// So many leaves that all threads are busy.
constexpr std::size_t kLeavesAtOnce = 64 * kLanes;
/// A test that was of use for a leaf is tried, whatever the search had learned when it came to it.
const AdaptiveThreshold kEveryTest(std::numeric_limits<double>::max());

struct Leaf {
  Rule rule;
  Reason reason;
};

/// Only a box that blocks is told with the reason of the text.
bool may_have_reason(const Leaf& leaf) noexcept {
  return leaf.rule != Rule::kBlocked || leaf.reason == Reason::kWidth ||
         leaf.reason == Reason::kUncertainty || leaf.reason == Reason::kUndefined;
}

Leaf leaf_of(double bound) {
  const double reason = std::floor(bound / kReasonUnit), rule = bound - reason * kReasonUnit;
  const bool is_leaf = reason <= static_cast<double>(Reason::kNullVector) && rule < kRules &&
                       rule == std::floor(rule);
  if (!is_leaf) throw SavedTreeError("a leaf has no rule");
  const Leaf leaf{static_cast<Rule>(unsigned(rule)), static_cast<Reason>(unsigned(reason))};
  if (!may_have_reason(leaf)) throw SavedTreeError("a leaf has another reason");
  return leaf;
}

/// The claims of two rules of one kind differ in the test alone. What rests on a filter is another
/// kind, because users are told of it.
bool is_same_kind(Rule a, Rule b) noexcept {
  const auto has_own_kind = [](Rule rule) {
    return rule == Rule::kOutside || rule == Rule::kWitness || rule == Rule::kBlocked ||
           rule == Rule::kFilter;
  };
  return a == b || (!has_own_kind(a) && !has_own_kind(b));
}

class Retelling {
 public:
  Retelling(const RestoredTree& tree, const Problem& problem, const Settings& settings,
            Observer& observer)
      : tree_(tree),
        settings_(settings),
        observer_(observer),
        structure_(find_row_structure(problem, settings)),
        round_(problem, settings, structure_),
        deadline_(deadline_of(settings)) {
    round_.begin(deadline_);
    told_.filter_boxes.resize(settings.filters.size());
  }

  RetoldTree run() {
    make_closed_form();
    std::size_t leaf = 0, leaves = 0;
    for (const RestoredTree::Step& step : tree_.steps()) {
      Event event{{step.box, tree_.depth(step.box), {}}, tree_.box(step.box), step.variable, {}};
      event.box.box = event.sides;
      if (!step.variable) {
        event.leaf = leaf_of(tree_.leaves()[leaf++].bound);
        ++leaves;
      }
      events_.push_back(std::move(event));
      if (leaves == kLeavesAtOnce) tell(), leaves = 0;
    }
    tell();
    return std::move(told_);
  }

 private:
  using Clock = Round::Clock;

  struct Event {
    OpenBox box;
    std::vector<Interval> sides;
    std::optional<std::uint32_t> variable;  ///< nullopt: it is a leaf
    Leaf leaf;
  };

  static Clock::time_point deadline_of(const Settings& settings) {
    const std::chrono::duration<double> limit(settings.time_limit);
    if (!(limit < std::chrono::hours(24 * 365 * 100))) return Clock::time_point::max();
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
  }

  [[nodiscard]] bool must_stop() const {
    return (settings_.interrupt != nullptr && *settings_.interrupt) || Clock::now() >= deadline_;
  }

  /// The search forms it when it is worth its time, and leaves may rest on it.
  void make_closed_form() const {
    if (settings_.closed_form == nullptr) return;
    for (const RestoredTree::Leaf& leaf : tree_.leaves())
      if (leaf.bound == bound_of_leaf(Rule::kClosedForm, Reason::kAllBoxesCertified))
        return settings_.closed_form->make();
  }

  [[nodiscard]] bool is_judged(const Event& event) const {
    return !event.variable && (event.leaf.rule != Rule::kBlocked || settings_.enclose_determinants);
  }

  /// Puts leaves into the round, as long as there is memory.
  void load() {
    round_.clear();
    std::size_t count = 0;
    for (const Event& event : events_) {
      if (!is_judged(event)) continue;
      if (count++ % kLanes == 0 && round_.append() == nullptr) return;
      round_.batch(round_.size() - 1).add(event.box);
    }
  }

  void judge() {
    load();
    told_.is_complete = told_.is_complete && !must_stop() && round_.decide(kEveryTest);
  }

  void tell() {
    judge();
    std::size_t judged = 0;
    for (const Event& event : events_) {
      if (event.variable) {
        tell_split(event);
        continue;
      }
      const std::size_t at = judged;
      judged += is_judged(event) ? 1 : 0;
      tell_leaf(event, at);
    }
    events_.clear();
    Statistics statistics;
    statistics.leaves = told_.leaves;
    statistics.boxes = boxes_;
    observer_.on_progress(statistics, tree_.open() + told_.reopened.size());
  }

  void tell_split(const Event& event) {
    ++boxes_;
    const double at = tree_.box(next_)[*event.variable].hi;
    observer_.on_split(event.box, {event.box.id, *event.variable, at, next_});
    next_ += 2;
  }

  /// `at`: the number of the leaf among those that are judged.
  void tell_leaf(const Event& event, std::size_t at) {
    ++boxes_;
    if (!is_judged(event)) return tell(event, event.leaf.rule, {});
    Decisions* const batch = at / kLanes < round_.size() ? &round_.batch(at / kLanes) : nullptr;
    const std::size_t lane = at % kLanes;
    if (batch == nullptr || !batch->decided || lane >= batch->count()) {
      told_.is_complete = false;
      return told_.reopened.push_back(event.box.id);
    }
    const Decision& decision = batch->decision[lane];
    const Rule rule = event.leaf.rule;
    const bool is_certified =
        decision.kind == Decision::Kind::kLeaf && is_same_kind(decision.rule, rule);
    if (!is_certified) return told_.reopened.push_back(event.box.id);
    if (rule == Rule::kFilter) ++told_.filter_boxes[decision.filter];
    if (rule == Rule::kWitness && !told_.witness) {
      told_.witness = decision.witness;
      told_.witness_reason = decision.reason;
    }
    tell(event, rule, batch->proof(lane));
  }

  void tell(const Event& event, Rule rule, Proof proof) {
    if (rule == Rule::kBlocked) {
      proof.reason = event.leaf.reason;
      const bool shows_more =
          proof.reason == Reason::kUndefined && told_.blocked_reason == Reason::kWidth;
      if (!told_.blocked || shows_more)
        told_.blocked = event.box.id, told_.blocked_reason = proof.reason;
    }
    ++told_.leaves[static_cast<std::size_t>(rule)];
    observer_.on_leaf(event.box, rule, proof);
  }

  const RestoredTree& tree_;
  const Settings& settings_;
  Observer& observer_;
  const RowStructure structure_;
  Round round_;
  const Clock::time_point deadline_;
  std::vector<Event> events_;
  BoxId next_ = 1;
  std::uint64_t boxes_ = 0;
  RetoldTree told_;
};

}  // namespace

double bound_of_leaf(Rule rule, Reason reason) noexcept {
  return static_cast<double>(rule) + kReasonUnit * static_cast<double>(reason);
}

RetoldTree tell_again(const RestoredTree& tree, const Problem& problem, const Settings& settings,
                      Observer& observer) {
  return Retelling(tree, problem, settings, observer).run();
}

}  // namespace regulus::detail
