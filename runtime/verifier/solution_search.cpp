// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/solution_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/verifier/arm_equations.hpp"
#include "runtime/verifier/branch_test.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/variety.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBits = 128;
constexpr int kMostHalvings = 30;  ///< of the range, for the reach of a solution
constexpr int kMostContractions = 8;
constexpr double kWorthwhile = 0.75;  ///< a box that stays larger is split
/// Parts of the range: a box that is narrower may be shown to hold another solution; the narrowest.
constexpr double kNarrow = 0x1p-16, kNarrowest = 0x1p-40;
constexpr double kMuchNarrower = 0x1p-20;  ///< than the widest unknown: it is not halved
constexpr std::size_t kStarts = 8;         ///< for each unknown that is not searched

bool is_in(std::span<const Interval> box, std::span<const Interval> other) {
  for (std::size_t i = 0; i < box.size(); ++i)
    if (!(other[i].lo <= box[i].lo && box[i].hi <= other[i].hi)) return false;
  return true;
}

bool are_disjoint(std::span<const Interval> a, std::span<const Interval> b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].hi < b[i].lo || a[i].lo > b[i].hi) return true;
  return false;
}

class SolutionSearch {
 public:
  SolutionSearch(Lines& lines, Question& q, const Options& options, Verification& result)
      : lines_(lines),
        q_(q),
        claim_(*q.solutions),
        options_(options),
        result_(result),
        clock_(options, result),
        places_(enclose_variety(q).outer),
        test_(q),
        equations_(q, q.closure->equations),
        searched_(q.closure->names.size()) {
    std::iota(searched_.begin(), searched_.end(), std::size_t{0});
  }

  /// Searches some unknowns alone, by equations of their own.
  void reduce_to(PostureSearch& postures) {
    searched_ = postures.searched;
    conditions_ = postures.question.closure->equations;
    conditions_.push_back(postures.also);
    in_search_.emplace(postures.question);
    conditions_in_search_.emplace(postures.question, conditions_);
    trace_.emplace(q_, std::vector<NodeId>{postures.trace});
    trace_node_ = postures.trace;
  }

  void check() {
    if (!Evaluation(q_, q_.motion_defined).run(places_))
      throw Unfinished("an expression of the motion has no certain value");
    enclose_ranges();
    for (const SolutionLine& line : claim_.solutions) {
      lines_.name_line(line.line);
      prove(line);
    }
    lines_.name_line(0);
    if (claim_.verdict != format::kIncomplete) search();
    result_.real_roots = result_.roots = reach_.size();
  }

 private:
  void enclose_ranges() {
    for (std::size_t i = 0; i < q_.closure->names.size(); ++i) {
      const auto values =
          evaluate(q_.graph, {q_.closure->middle[i], q_.closure->radius[i]}, {}, kBits);
      if (!values) throw Unfinished("a range has no certain value");
      if (arb_is_positive((*values)[1].get()) == 0)
        throw Rejection("a radius of the unknowns is not positive");
      Ball lo, hi;
      arb_sub(lo.get(), (*values)[0].get(), (*values)[1].get(), kBits);
      arb_add(hi.get(), (*values)[0].get(), (*values)[1].get(), kBits);
      const Interval lower = lo.enclosure(), upper = hi.enclosure();
      if (!is_bounded(lower) || !is_bounded(upper)) throw Unfinished("a range is too large");
      outer_.push_back({lower.lo, upper.hi});
      inner_.push_back({lower.hi, upper.lo});
    }
  }

  /// The range of a searched unknown.
  [[nodiscard]] double width(std::size_t i) const {
    return outer_[searched_[i]].hi - outer_[searched_[i]].lo;
  }

  /// Shows that exactly one solution is within a line, within the ranges, and finds its reach.
  void prove(const SolutionLine& line) {
    clock_.tick();
    if (are_disjoint(line.values, outer_)) throw Rejection("the line is not within the ranges");
    if (!is_in(line.values, inner_)) throw Unfinished("the line may not be within the ranges");
    std::vector<double> middle, radius;
    for (const Interval x : line.values) {
      middle.push_back(mid(x));
      radius.push_back(
          std::max(0.0, std::min(down(x.hi - middle.back()), down(middle.back() - x.lo))));
    }
    if (!test_.has_one_solution(places_, middle, radius, radius)) {
      if (has_none(equations_, q_.closure->equations, line.values))
        throw Rejection("no solution is within this line");
      throw Unfinished("it was not shown that exactly one solution is within this line");
    }
    if (trace_ && !is_posture(line.values))
      throw Rejection("the end is turned by half a turn within this line");
    for (std::size_t k = 0; k < reach_.size(); ++k) {
      if (is_in(searched(line.values), reach_[k]))
        throw Rejection("the solution is that of line " + std::to_string(claim_.solutions[k].line));
      if (!are_disjoint(line.values, claim_.solutions[k].values))
        throw Unfinished("the solution may be that of line " +
                         std::to_string(claim_.solutions[k].line));
    }
    reach_.push_back(reach_of(searched(middle), searched(radius)));
  }

  template <class T>
  [[nodiscard]] std::vector<T> searched(const std::vector<T>& all) const {
    std::vector<T> result;
    for (const std::size_t i : searched_) result.push_back(all[i]);
    return result;
  }
  [[nodiscard]] BranchTest& test_of_search() { return in_search_ ? *in_search_ : test_; }

  /// Returns true only if E, which is the unit matrix or a half turn, is the unit matrix.
  [[nodiscard]] bool is_posture(const Box& solution) {
    return trace_->run(solution) && trace_->value(trace_node_).lo > 0.0;
  }

  /// Returns a box with no other solution than the one near its middle, of the unknowns that are
  /// searched.
  [[nodiscard]] Box reach_of(const std::vector<double>& middle, const std::vector<double>& least) {
    std::vector<double> radius(least);
    bool is_proved = !in_search_;  // of the least radius
    for (int halving = 1; halving <= kMostHalvings; ++halving) {
      std::vector<double> tried;
      for (std::size_t i = 0; i < least.size(); ++i)
        tried.push_back(std::max(least[i], std::ldexp(width(i), -halving)));
      if (!test_of_search().has_one_solution(places_, middle, tried, tried)) continue;
      radius = tried;
      is_proved = true;
      break;
    }
    if (!is_proved && claim_.verdict != format::kIncomplete)
      throw Unfinished("other solutions may be near this line");
    if (!is_proved) return Box(least.size(), {kInfinity, -kInfinity});
    Box box;
    for (std::size_t i = 0; i < radius.size(); ++i)
      box.push_back({up(middle[i] - radius[i]), down(middle[i] + radius[i])});
    return box;
  }

  /// Shows that a box holds no solution at any place.
  [[nodiscard]] bool has_none(Evaluation& evaluation, const std::vector<NodeId>& conditions,
                              const Box& box) const {
    Box all = places_;
    all.insert(all.end(), box.begin(), box.end());
    if (!evaluation.run(all)) return false;
    return std::ranges::any_of(
        conditions, [&](NodeId condition) { return !contains(evaluation.value(condition), 0.0); });
  }
  [[nodiscard]] bool is_empty(const Box& box) {
    return in_search_ ? has_none(*conditions_in_search_, conditions_, box)
                      : has_none(equations_, q_.closure->equations, box);
  }

  [[nodiscard]] bool is_covered(const Box& box) const {
    return std::ranges::any_of(reach_, [&](const Box& reach) { return is_in(box, reach); });
  }

  void search() {
    std::vector<Box> waiting{searched(outer_)};
    while (!waiting.empty()) {
      Box box = std::move(waiting.back());
      waiting.pop_back();
      if (!is_left(box)) continue;
      const std::size_t widest = widest_of(box), i = to_halve(box, widest);
      const double at = mid(box[i]);
      if (part(box, widest) < kNarrow) look_for_other(box);
      if (!(part(box, widest) > kNarrowest) || !(box[i].lo < at && at < box[i].hi)) give_up(box);
      waiting.push_back(box);
      waiting.back()[i].lo = at;
      box[i].hi = at;
      waiting.push_back(std::move(box));
      if (waiting.size() > format::kMostOpen) throw Unfinished("too many boxes are open");
    }
  }

  /// Returns false if the box has no other solution than those of the lines. Narrows it to a part with
  /// all others.
  [[nodiscard]] bool is_left(Box& box) {
    for (int step = 0; step < kMostContractions; ++step) {
      clock_.tick();
      if (++result_.boxes > options_.max_boxes)
        throw Unfinished("the search needs more boxes than may be evaluated");
      if (is_empty(box)) return false;
      const Box before = box;
      if (!test_of_search().narrow_to_solutions(places_, box) || is_covered(box)) return false;
      bool is_narrower = false;
      for (std::size_t i = 0; i < box.size(); ++i)
        is_narrower =
            is_narrower || box[i].hi - box[i].lo < kWorthwhile * (before[i].hi - before[i].lo);
      if (!is_narrower) return true;
    }
    return true;
  }

  [[nodiscard]] double part(const Box& box, std::size_t i) const {
    return (box[i].hi - box[i].lo) / width(i);
  }

  [[nodiscard]] std::size_t widest_of(const Box& box) const {
    std::size_t result = 0;
    for (std::size_t i = 1; i < box.size(); ++i)
      if (part(box, i) > part(box, result)) result = i;
    return result;
  }

  /// Returns the unknown by which the equations change most, of those that are not much narrower than
  /// the widest.
  [[nodiscard]] std::size_t to_halve(const Box& box, std::size_t widest) {
    const std::vector<double>& shares = test_of_search().shares();
    std::size_t result = widest;
    for (std::size_t i = 0; i < shares.size(); ++i)
      if (shares[i] > shares[result] && part(box, i) > kMuchNarrower * part(box, widest))
        result = i;
    return result;
  }

  /// Rejects the claim if a solution is found near the box that is in the ranges, and in no line. The
  /// unknowns that are not searched may be anywhere.
  void look_for_other(const Box& box) {
    std::vector<double> start, scale;
    for (const Interval range : outer_) {
      start.push_back(range.lo);
      scale.push_back(kNarrow * (range.hi - range.lo));
    }
    for (std::size_t k = 0; k < searched_.size(); ++k) start[searched_[k]] = mid(box[k]);
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < outer_.size(); ++i)
      if (std::ranges::find(searched_, i) == searched_.end()) others.push_back(i);
    std::size_t starts = 1;
    for (std::size_t k = 0; k < others.size(); ++k) starts *= kStarts;
    for (std::size_t number = 0; number < starts; ++number) {
      std::size_t rest = number;
      for (const std::size_t i : others) {
        start[i] = outer_[i].lo +
                   (double(rest % kStarts) + 0.5) * (outer_[i].hi - outer_[i].lo) / double(kStarts);
        rest /= kStarts;
      }
      reject_other_near(start, scale);
    }
  }

  void reject_other_near(const std::vector<double>& start, const std::vector<double>& scale) {
    const auto found = test_.solution_near(places_, start, scale);
    if (!found) return;
    Box solution;
    for (std::size_t i = 0; i < start.size(); ++i)
      solution.push_back(point(found->middle[i]) + Interval{-found->radius[i], found->radius[i]});
    const bool is_other = std::ranges::all_of(claim_.solutions, [&](const SolutionLine& line) {
      return are_disjoint(solution, line.values);
    });
    if (is_other && is_in(solution, inner_) && (!trace_ || is_posture(solution)))
      throw Rejection("there is another solution, near " + place_of(solution));
  }

  [[noreturn]] void give_up(const Box& box) const {
    throw Unfinished("it was not shown that there is no other solution near " + place_of(box));
  }

  /// `box`: of all unknowns, or of those that are searched.
  [[nodiscard]] std::string place_of(const Box& box) const {
    const bool has_all = box.size() == outer_.size();
    std::string text;
    for (std::size_t i = 0; i < box.size(); ++i)
      text += (i == 0 ? "" : ", ") + q_.closure->names[has_all ? i : searched_[i]] + " = " +
              std::to_string(mid(box[i]));
    return text;
  }

  Lines& lines_;
  Question& q_;
  const SolutionLines& claim_;
  const Options& options_;
  Verification& result_;
  WorkClock clock_;
  const Box places_;  ///< of the uncertain quantities and the errors
  BranchTest test_;
  Evaluation equations_;
  std::vector<std::size_t> searched_;  ///< unknowns
  // If not all are searched: what the searched ones solve, and tells a posture from a half turn.
  std::vector<NodeId> conditions_;
  std::optional<BranchTest> in_search_;
  std::optional<Evaluation> conditions_in_search_, trace_;
  NodeId trace_node_ = kNoNode;
  Box outer_, inner_;       ///< contain the ranges of the unknowns, are within them
  std::vector<Box> reach_;  ///< by line
};

}  // namespace

void search_solutions(Lines& lines, Question& question, const Options& options,
                      Verification& result) {
  const auto expect_end = [&lines] {
    if (lines.text() != "end")
      throw Rejection("expected 'end' after 'proof': the reader searches itself");
    if (lines.next()) throw Rejection("there is text after the line 'end'");
  };
  if (!lines.next()) throw Rejection("the file ends before the proof");
  if (!question.solutions->arm) {
    expect_end();
    return SolutionSearch(lines, question, options, result).check();
  }
  const auto words = words_of(lines.text());
  if (words.size() != 2 || words[0] != "opposite")
    throw Rejection("expected 'opposite N' after 'proof'");
  const std::size_t pair = read_count(words[1], kPairsOfJoints);
  if (pair == 0) throw Rejection("joints are counted from 1");
  if (!lines.next()) throw Rejection("the file ends before the line 'end'");
  expect_end();
  PostureSearch postures = form_posture_equations(question, pair % kPairsOfJoints);
  SolutionSearch search(lines, question, options, result);
  search.reduce_to(postures);
  search.check();
}

}  // namespace regulus::verifier
