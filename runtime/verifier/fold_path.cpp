// SPDX-License-Identifier: Apache-2.0
// PROOF.md, "SINGULARITY of a closure", derives it.
#include "runtime/verifier/fold_path.hpp"

#include <algorithm>
#include <memory>

#include "runtime/verifier/branch_start.hpp"
#include "runtime/verifier/line_system.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/rounding.hpp"
#include "runtime/verifier/single_values.hpp"

namespace regulus::verifier {
namespace {

constexpr double kThinner = 0x1p-20;  ///< a part of the radius of a tube
/// The parts into which an arc is cut are no smaller than this one of it.
constexpr int kMostHalvingsOfFold = 40;

/// Numbers of the curve: its coordinates are the part of the line, and the unknowns.
using CurvePoint = std::vector<Interval>;

class FoldPath {
 public:
  FoldPath(Lines& lines, Question& q, const Variety& variety, const Options& options,
           const BranchBoxes* before, Verification& result)
      : lines_(lines),
        q_(q),
        variety_(variety),
        options_(options),
        before_(before),
        result_(result),
        clock_(options, result),
        n_(q.closure->equations.size()) {}

  void check() {
    if (lines_.text() != std::string("reason ") + format::kFold)
      throw Rejection(std::string("expected 'reason ") + format::kFold + "'");
    if (!q_.constraints.empty())
      throw Unfinished("a singular configuration of a motion with constraints is not checked");
    read_line();
    for (auto words = words_of(next_line()); words[0] == format::kArc;
         words = words_of(next_line()))
      add_arc(words);
    if (!last_) throw Rejection("expected 'arc K X : X' and its tube");
    check_fold();
    if (next_line() != "end") throw Rejection("expected 'end'");
    if (lines_.next()) throw Rejection("there is text after the line 'end'");
  }

 private:
  /// A piece of the curve over a range of one of its coordinates.
  struct Arc {
    LineSystem& system;
    Interval range;
    TubeNumbers tube;
  };

  const std::string& next_line() {
    if (!lines_.next()) throw Rejection("the file ends before the line 'end' of the proof");
    if (lines_.text().empty()) throw Rejection("the line is empty");
    return lines_.text();
  }

  /// Reads `towards`: the end of the line, which begins at the start. Both are in the set, and so is all
  /// of the line, because ranges and balls are convex.
  void read_line() {
    const auto words = words_of(next_line());
    if (words[0] != format::kTowards || words.size() != q_.variables.size() + 1)
      throw Rejection(std::string("expected '") + format::kTowards + "' and " +
                      std::to_string(q_.variables.size()) + " numbers or words '" + format::kStays +
                      "'");
    require_start_in_ranges();
    line_.from = start_values(q_);
    Box end;
    for (std::size_t k = 0; k < q_.variables.size(); ++k) {
      const bool stays = words[k + 1] == format::kStays;
      end.push_back(stays ? value_at_start(k) : point(read_double(words[k + 1])));
      line_.to.push_back(stays ? kNoNode : q_.graph.number(rational_of(end.back().lo)));
    }
    if (certain_outside(q_, variety_, end))
      throw Rejection("the end of the line is outside the ranges or the balls");
    if (!certain_inside(q_, variety_, end))
      throw Unfinished("the end of the line is not certainly within the ranges");
  }

  /// The middle of a range is in it. A parameter may start at an end that no double is.
  void require_start_in_ranges() {
    const Box place = start_place(q_, variety_);
    for (std::size_t k = 0; k < q_.closure->start.size(); ++k) {
      const Variable& v = q_.variables[k];
      const auto& inner = variety_.inner[k];
      const bool is_inside = inner && inner->lo <= place[k].lo && place[k].hi <= inner->hi;
      if (!is_inside && !are_equal(q_.graph, q_.closure->start[k], v.lo) &&
          !are_equal(q_.graph, q_.closure->start[k], v.hi))
        throw Unfinished("the start may not be within the range of " + v.name);
    }
  }

  /// Returns values that stand for that of the start, which is in the set.
  [[nodiscard]] Interval value_at_start(std::size_t k) const {
    const Interval outer = variety_.outer[k];
    const auto& inner = variety_.inner[k];
    return inner ? point(std::clamp(mid(outer), inner->lo, inner->hi)) : outer;
  }

  void add_arc(const std::vector<std::string_view>& words) {
    const std::size_t count = 3 * n_ + 1;
    if (words.size() != count + 5 || words[3] != ":")
      throw Rejection("expected 'arc K X : X' and " + std::to_string(count) + " numbers");
    Arc arc{system(read_count(words[1], n_)), {read_double(words[2]), read_double(words[4])}, {}};
    if (!(arc.range.lo <= arc.range.hi)) throw Rejection("the range of the arc is empty");
    for (const std::string_view word : std::span(words).subspan(5))
      arc.tube.push_back(read_double(word));
    if (!std::all_of(arc.tube.end() - std::ptrdiff_t(n_), arc.tube.end(),
                     [](double r) { return r > 0.0; }))
      throw Rejection("a radius of a tube is not positive");
    require_on_line(part_of(arc));
    prove(arc, arc.range, kMostHalvingsOfFold);
    last_ ? link(arc) : begin(arc);
    last_.emplace(std::move(arc));
  }

  LineSystem& system(std::size_t coordinate) {
    auto& found = systems_[coordinate];
    if (!found) found = std::make_unique<LineSystem>(q_, line_, coordinate);
    return *found;
  }

  /// Encloses the part of the line over which an arc is: its range, or its first unknown.
  static Interval part_of(const Arc& arc) {
    if (arc.system.is_along_line()) return arc.range;
    BranchTest& test = arc.system.test();
    const double radius = test.radius_of(arc.tube)[0];
    return test.middle_of(arc.tube, {arc.range})[0] + Interval{-radius, radius};
  }

  static void require_on_line(Interval part) {
    if (part.hi < 0.0 || part.lo > 1.0) throw Rejection("the arc is not on the line");
    if (part.lo < 0.0 || part.hi > 1.0) throw Unfinished("the arc may leave the line");
  }

  /// The tube is the same set over both halves, so that their configurations agree at the cut.
  void prove(const Arc& arc, Interval range, int halvings) {
    clock_.tick();
    if (++result_.boxes > options_.max_boxes) throw Unfinished("the limit of boxes was reached");
    BranchTest& test = arc.system.test();
    if (test.has_one_solution({range}, arc.tube)) return;
    const double middle = mid(range);
    if (test.has_no_solution({point(middle)}, arc.tube))
      throw Rejection("the tube of the arc has no configuration");
    if (halvings == 0 || !test.has_one_solution({point(middle)}, arc.tube))
      throw Unfinished("it was not shown that the tube of the arc has one configuration");
    prove(arc, {range.lo, middle}, halvings - 1);
    prove(arc, {middle, range.hi}, halvings - 1);
  }

  /// The one configuration near the start is in the first arc.
  void begin(const Arc& arc) {
    LineSystem& line = system(0);
    const StartBox start(q_);
    std::vector<double> scale = start.radius();
    const auto radius = arc.system.test().radius_of(arc.tube);
    for (std::size_t i = 0; i < n_ && arc.system.is_along_line(); ++i)
      scale[i] = std::min(scale[i], radius[i]);
    const SolutionBox found = before_ != nullptr
                                  ? solution_after(line, std::move(scale))
                                  : start.only_solution(line.test(), {point(0.0)}, scale);
    if (!holds(arc, line.point_of(point(0.0), found)))
      throw Unfinished("the arc may not hold the configuration at the start");
  }

  /// Encloses the configuration of the piece before at its end, where this one begins.
  SolutionBox solution_after(LineSystem& line, std::vector<double> scale) {
    Box end = start_place(q_, variety_);
    if (!are_equal(q_.graph, q_.closure->start[0], q_.graph.number("0")))
      throw Unfinished("the line does not begin where the piece does");
    end[0] = point(1.0);
    BranchTest test(q_);
    const std::vector<std::size_t> tubes = tubes_at(*before_, end);
    std::vector<double> near;
    for (const Interval x : test.middle_of(before_->tubes[tubes.front()], end))
      near.push_back(mid(x));
    for (const std::size_t tube : tubes)
      for (std::size_t i = 0; i < n_; ++i)
        scale[i] = std::min(scale[i], test.radius_of(before_->tubes[tube])[i]);
    auto found = line.test().solution_near({point(0.0)}, near, scale);
    for (const std::size_t tube : tubes)
      if (!found || test.place_of(*found, before_->tubes[tube], end) != Place::kInside)
        throw Unfinished("the configuration at the end of the piece before was not found");
    return *std::move(found);
  }

  /// The configuration at an end of the arc is in the last one. A tube of that one may be much thinner.
  void link(const Arc& arc) {
    BranchTest& test = arc.system.test();
    for (const double part : {1.0, kThinner})
      for (const double end : {arc.range.lo, arc.range.hi}) {
        std::vector<double> near, scale;
        for (const Interval x : test.middle_of(arc.tube, {point(end)})) near.push_back(mid(x));
        for (const double r : test.radius_of(arc.tube)) scale.push_back(part * r);
        const auto found = test.solution_near({point(end)}, near, scale);
        if (!found) continue;
        const CurvePoint configuration = arc.system.point_of(point(end), *found);
        if (!holds(arc, configuration) || !holds(*last_, configuration)) continue;
        ++result_.links;
        return;
      }
    throw Unfinished("it was not shown that the arc begins at a configuration of the last one");
  }

  /// True only if the configuration is that of the arc at the same place.
  static bool holds(const Arc& arc, const CurvePoint& configuration) {
    const Interval at = arc.system.variable_of(configuration);
    return arc.range.lo <= at.lo && at.hi <= arc.range.hi &&
           arc.system.test().place_of(arc.system.unknowns_of(configuration), arc.tube, {at}) ==
               Place::kInside;
  }

  /// Reads `fold`: values of the part of the line, of the unknowns, and of the direction v, which has
  /// length 1 along a normal; their radii; and the normal.
  void check_fold() {
    const std::size_t unknowns = 2 * n_ + 1, count = 2 * unknowns + n_;
    const auto words = words_of(lines_.text());
    if (words[0] != format::kFold || words.size() != count + 1)
      throw Rejection("expected 'fold' and " + std::to_string(count) + " numbers");
    std::vector<double> numbers;
    for (const std::string_view word : std::span(words).subspan(1))
      numbers.push_back(read_double(word));
    const auto middle = std::span(numbers).first(unknowns);
    const auto radius = std::span(numbers).subspan(unknowns, unknowns);
    if (!std::ranges::all_of(radius, [](double r) { return r > 0.0; }))
      throw Rejection("a radius of the singular configuration is not positive");
    clock_.tick();
    Question bordered = bordered_along(q_, line_, std::span(numbers).last(n_));
    BranchTest test(bordered);
    const auto found = test.solution_near({}, {middle.begin(), middle.end()}, radius);
    if (!found) throw Unfinished("it was not shown that there is a singular configuration");
    CurvePoint configuration;
    for (std::size_t i = 0; i < unknowns; ++i) {
      const Interval value =
          point(found->middle[i]) + Interval{-found->radius[i], found->radius[i]};
      if (!(mag(value - point(middle[i])) <= radius[i]))
        throw Unfinished("the singular configuration may be beyond the numbers of the line");
      if (i <= n_) configuration.push_back(value);
    }
    require_on_line(configuration[0]);
    if (!holds(*last_, configuration))
      throw Unfinished("the last arc may not hold the singular configuration");
  }

  Lines& lines_;
  Question& q_;
  const Variety& variety_;
  const Options& options_;
  const BranchBoxes* const before_;
  Verification& result_;
  WorkClock clock_;
  const std::size_t n_;
  PlaceLine line_;
  std::map<std::size_t, std::unique_ptr<LineSystem>> systems_;  ///< by coordinate
  std::optional<Arc> last_;
};

}  // namespace

void check_fold(Lines& lines, Question& question, const Variety& variety, const Options& options,
                Verification& result) {
  if (!lines.next()) throw Rejection("the file ends before the line 'end' of the proof");
  FoldPath(lines, question, variety, options, nullptr, result).check();
}

void check_fold_of_piece(Lines& lines, Question& question, const Variety& variety,
                         const Options& options, const BranchBoxes* before, Verification& result) {
  FoldPath(lines, question, variety, options, before, result).check();
}

}  // namespace regulus::verifier
