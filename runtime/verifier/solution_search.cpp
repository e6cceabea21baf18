// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/solution_search.hpp"

#include <algorithm>
#include <numeric>

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/arm_equations.hpp"
#include "runtime/verifier/box_search.hpp"
#include "runtime/verifier/moving_arm.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/solution_lines.hpp"
#include "runtime/verifier/variety.hpp"

namespace regulus::verifier {
namespace {

constexpr long kBitsOfSearch = 128;
/// The searches at the ends of intervals show that this is so.
constexpr const char* kInWalls = "no solution leaves this line,";
constexpr std::size_t kStarts = 8;  ///< for each unknown that is not searched

class SolutionSearch {
 public:
  /// `postures`: of an arm, of which some unknowns are searched alone; otherwise null.
  SolutionSearch(Lines& lines, Question& q, PostureSearch* postures, const Options& options,
                 Verification& result)
      : lines_(lines),
        q_(q),
        claim_(*q.solutions),
        options_(options),
        clock_(options, result),
        result_(result),
        places_(enclose_variety(q).outer),
        all_(q, {}, places_, clock_, options, result),
        searched_(q.closure->names.size()) {
    std::iota(searched_.begin(), searched_.end(), std::size_t{0});
    if (postures == nullptr) return;
    postures_ = postures;
    searched_ = postures->searched;
    some_.emplace(postures->question, postures->also, places_, clock_, options, result);
    trace_.emplace(q_, std::vector<NodeId>{postures->trace});
  }

  void check() {
    if (!Evaluation(q_, q_.motion_defined).run(places_))
      throw Unfinished("an expression of the motion has no certain value");
    if (postures_ != nullptr && postures_->has_none) return require_none();
    enclose_ranges();
    if (!claim_.from.empty()) return follow();
    for (const SolutionLine& line : claim_.solutions) {
      lines_.name_line(line.line);
      prove(line);
    }
    lines_.name_line(0);
    if (claim_.verdict != format::kIncomplete)
      in_search().search([this](const Box& box) { return !is_in_one(box, reach_); },
                         [this](const Box& box) { look_for_other(box); });
    result_.real_roots = result_.roots = reach_.size();
  }

 private:
  /// The place has an orientation that the arm has nowhere.
  void require_none() {
    if (claim_.solutions.empty()) return;
    lines_.name_line(claim_.solutions.front().line);
    throw Rejection("the arm has no posture with this orientation");
  }

  void enclose_ranges() {
    for (std::size_t i = 0; i < q_.closure->names.size(); ++i) {
      const auto values =
          evaluate(q_.graph, {q_.closure->middle[i], q_.closure->radius[i]}, {}, kBitsOfSearch);
      if (!values) throw Unfinished("a range has no certain value");
      if (arb_is_positive((*values)[1].get()) == 0)
        throw Rejection("a radius of the unknowns is not positive");
      Ball lo, hi;
      arb_sub(lo.get(), (*values)[0].get(), (*values)[1].get(), kBitsOfSearch);
      arb_add(hi.get(), (*values)[0].get(), (*values)[1].get(), kBitsOfSearch);
      const Interval lower = lo.enclosure(), upper = hi.enclosure();
      if (!is_bounded(lower) || !is_bounded(upper)) throw Unfinished("a range is too large");
      outer_.push_back({lower.lo, upper.hi});
      inner_.push_back({lower.hi, upper.lo});
      scale_.push_back(kNarrowPart * (upper.hi - lower.lo));
    }
    all_.set_range(outer_);
    in_search().set_range(searched(outer_));
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
    if (!all_.test().has_one_solution(places_, middle, radius, radius)) {
      if (all_.is_empty(line.values)) throw Rejection("no solution is within this line");
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
    const auto reach = in_search().reach_of(searched(middle), searched(radius));
    if (!reach && claim_.verdict != format::kIncomplete)
      throw Unfinished("other solutions may be near this line");
    reach_.push_back(reach.value_or(Box(searched_.size(), {kInfinity, -kInfinity})));
  }

  /// Shows that there is one solution within each line at the middles of the places, and that it stays there. If the
  /// list is whole: there is no other at the middles, and at no place a solution is outside of the lines, or singular.
  void follow() {
    Box middles;
    for (const Interval x : places_) middles.push_back(point(mid(x)));
    BoxSearch all_at_middles(q_, {}, middles, clock_, options_, result_);
    all_at_middles.set_range(outer_);
    std::optional<BoxSearch> some_at_middles;
    if (postures_ != nullptr) {
      some_at_middles.emplace(postures_->question, postures_->also, middles, clock_, options_,
                              result_);
      some_at_middles->set_range(searched(outer_));
    }
    BoxSearch& at_middles = some_at_middles ? *some_at_middles : all_at_middles;
    std::vector<Box> lines, searched_lines;
    for (std::size_t k = 0; k < claim_.solutions.size(); ++k) {
      const SolutionLine& line = claim_.solutions[k];
      lines_.name_line(line.line);
      require_room(line.values, lines);
      require_apart(searched(line.values), searched_lines);
      lines.push_back(line.values);
      searched_lines.push_back(searched(line.values));
      const auto found = all_at_middles.test().solution_near(middles, claim_.from[k], scale_);
      if (!found) throw Unfinished("no solution was found where this line is followed from");
      if (are_disjoint(box_of(*found), line.values))
        throw Rejection("the solution that this line is followed from is not within it");
      if (!is_in(box_of(*found), line.values))
        throw Unfinished("the solution that this line is followed from may not be within it");
      if (trace_ && !is_posture(middles, box_of(*found)))
        throw Rejection("the end is turned by half a turn where this line is followed from");
      const auto reach = at_middles.reach_of(searched(found->middle), searched(found->radius));
      if (!reach) throw Unfinished("other solutions may be near this line");
      reach_.push_back(*reach);
    }
    for (std::size_t k = 0; k < lines.size(); ++k) {
      lines_.name_line(claim_.solutions[k].line);
      if (claim_.verdict == format::kIncomplete) stay(at_middles, searched_lines[k], reach_[k]);
      require_walls_of_others(lines[k]);
    }
    lines_.name_line(0);
    result_.real_roots = result_.roots = reach_.size();
    if (claim_.verdict == format::kIncomplete) return;
    at_middles.search([this](const Box& box) { return !is_in_one(box, reach_); },
                      [&](const Box& box) { look_for_other(all_at_middles, middles, box); });
    in_search().search(
        [&](const Box& box) {
          return !is_in_one(box, searched_lines) || !in_search().test().is_regular(places_, box);
        },
        [](const Box&) {}, kFollowed);
  }

  /// Shows that one solution is within a line, of the searched unknowns, at all places, if one is at the middles: no
  /// other is there, none is singular, and none is near an end of an interval.
  void stay(BoxSearch& at_middles, const Box& line, const Box& reach) {
    at_middles.set_range(line);
    at_middles.search([&](const Box& box) { return !is_in(box, reach); }, [](const Box&) {});
    in_search().set_range(line);
    in_search().search([&](const Box& box) { return !in_search().test().is_regular(places_, box); },
                       [](const Box&) {}, kFollowed);
    for (std::size_t i = 0; i < line.size(); ++i) require_walls(in_search(), line, i);
  }

  /// Unknowns that are not searched do not leave their intervals.
  void require_walls_of_others(const Box& line) {
    if (postures_ == nullptr) return;
    GraphAlgebra algebra(q_.graph);
    const std::vector<NodeId> half_turns = {
        algebra.difference(postures_->trace, algebra.number(3))};
    BoxSearch all(q_, half_turns, places_, clock_, options_, result_);
    for (std::size_t i = 0; i < line.size(); ++i)
      if (std::ranges::find(searched_, i) == searched_.end()) require_walls(all, line, i);
  }

  /// Shows that no solution within a line is near an end of one interval.
  void require_walls(BoxSearch& search, const Box& line, std::size_t i) const {
    constexpr double kThickness = 0x1p-8;  // a part of the interval
    const Interval x = line[i];
    const double thickness = down(kThickness * (x.hi - x.lo));
    if (!(thickness > 0.0)) throw Unfinished("an interval of this line is too narrow");
    for (const Interval wall :
         {Interval{x.lo, up(x.lo + thickness)}, Interval{down(x.hi - thickness), x.hi}}) {
      Box box = line;
      box[i] = wall;
      search.set_range(box);
      search.search([](const Box&) { return true; }, [](const Box&) {}, kInWalls);
    }
  }

  /// A solution that moves on cannot go from this line to another one, or leave the ranges.
  void require_room(const Box& line, const std::vector<Box>& others) const {
    if (!is_in(line, inner_)) throw Unfinished("the line may not be within the ranges");
    for (std::size_t i = 0; i < line.size(); ++i)
      if (!(outer_[i].lo < line[i].lo && line[i].hi < outer_[i].hi))
        throw Unfinished("the line is at the end of a range");
    require_apart(line, others);
  }

  /// Lines are apart, also in the unknowns that are searched, which do not tell the others.
  void require_apart(const Box& line, const std::vector<Box>& others) const {
    for (std::size_t k = 0; k < others.size(); ++k)
      if (!are_disjoint(line, others[k]))
        throw Unfinished("the solution may be that of line " +
                         std::to_string(claim_.solutions[k].line));
  }

  static Box box_of(const SolutionBox& solution) {
    Box box;
    for (std::size_t i = 0; i < solution.middle.size(); ++i)
      box.push_back(point(solution.middle[i]) + Interval{-solution.radius[i], solution.radius[i]});
    return box;
  }

  template <class T>
  [[nodiscard]] std::vector<T> searched(const std::vector<T>& all) const {
    std::vector<T> result;
    for (const std::size_t i : searched_) result.push_back(all[i]);
    return result;
  }
  [[nodiscard]] BoxSearch& in_search() { return some_ ? *some_ : all_; }

  /// Returns true only if E, which is the unit matrix or a half turn, is the unit matrix.
  [[nodiscard]] bool is_posture(const Box& solution) { return is_posture(places_, solution); }
  [[nodiscard]] bool is_posture(const Box& places, const Box& solution) {
    Box all = places;
    all.insert(all.end(), solution.begin(), solution.end());
    return trace_->run(all) && trace_->value(postures_->trace).lo > 0.0;
  }

  /// Rejects the claim if a solution is found near the box that is in the ranges, and in no line. The
  /// unknowns that are not searched may be anywhere.
  void look_for_other(const Box& box) { look_for_other(all_, places_, box); }
  void look_for_other(BoxSearch& search, const Box& places, const Box& box) {
    std::vector<double> start;
    for (const Interval range : outer_) start.push_back(range.lo);
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
      reject_other_near(search, places, start);
    }
  }

  /// Rejects the claim if one is found near `start`, at all of `places`.
  void reject_other_near(BoxSearch& search, const Box& places, const std::vector<double>& start) {
    const auto found = search.test().solution_near(places, start, scale_);
    if (!found) return;
    const Box solution = box_of(*found);
    const bool is_other = std::ranges::all_of(claim_.solutions, [&](const SolutionLine& line) {
      return are_disjoint(solution, line.values);
    });
    if (is_other && is_in(solution, inner_) && (!trace_ || is_posture(places, solution)))
      throw Rejection("there is another solution, near " + all_.place_of(solution));
  }

  Lines& lines_;
  Question& q_;
  const SolutionLines& claim_;
  const Options& options_;
  WorkClock clock_;
  Verification& result_;
  const Box places_;  ///< of the uncertain quantities and the errors
  BoxSearch all_;
  std::vector<std::size_t> searched_;  ///< unknowns
  // If not all are searched: the search of the others, and what tells a posture from a half turn.
  PostureSearch* postures_ = nullptr;
  std::optional<BoxSearch> some_;
  std::optional<Evaluation> trace_;
  Box outer_, inner_;          ///< contain the ranges of the unknowns, are within them
  std::vector<double> scale_;  ///< a small part of each range
  std::vector<Box> reach_;     ///< by line, of the searched unknowns
};

/// Reads the line that says how postures are searched; nullopt: by all joints.
std::optional<JointPair> read_left_out(const std::string& line) {
  const auto words = words_of(line);
  const auto joint = [&](std::size_t word, std::size_t most) {
    const std::size_t number = read_count(words[word], most);
    if (number == 0) throw Rejection("joints are counted from 1");
    return number - 1;
  };
  if (words.size() == 2 && words[0] == "opposite") {
    const std::size_t first = joint(1, kPairsOfJoints);
    // With the second one the loop of the search begins; PROOF.md counts from its third joint.
    return first + 1 == kPairsOfJoints ? JointPair{first, first + kPairsOfJoints, true}
                                       : JointPair{first + kPairsOfJoints, first, true};
  }
  if (words.size() == 3 && words[0] == "left-out")
    return JointPair{joint(1, kJointsOfArm), joint(2, kJointsOfArm)};
  if (words.size() == 2 && words[0] == "left-out" && words[1] == "none") return std::nullopt;
  throw Rejection("expected 'opposite N' or 'left-out' after 'proof'");
}

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
    read_from_lines(lines, *question.solutions, question.closure->names.size());
    expect_end();
    return SolutionSearch(lines, question, nullptr, options, result).check();
  }
  const std::optional<JointPair> left_out = read_left_out(lines.text());
  if (!lines.next()) throw Rejection("the file ends before the line 'end'");
  const std::vector<SolutionLine>& listed = question.solutions->solutions;
  read_from_lines(lines, *question.solutions, listed.empty() ? 0 : listed.front().values.size());
  expect_end();
  PostureSearch postures = form_posture_equations(question, left_out);
  SolutionSearch(lines, question, &postures, options, result).check();
}

}  // namespace regulus::verifier
