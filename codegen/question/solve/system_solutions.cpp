// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/system_solutions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/degrees.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/question/condition/singular_vectors.hpp"
#include "codegen/question/solve/followed_solutions.hpp"
#include "codegen/question/solve/search_range.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// Where quantities are uncertain, solutions that one search does not tell apart are followed.
constexpr std::uint64_t kBoxesBeforeFollowing = 500;
constexpr double kWidthBeforeFollowing = 0x1p-16;  ///< a part of the range
constexpr std::size_t kNumberOfFollowed = 1;       ///< RootQuestion::number

/// Joins boxes that touch, so that few remain to be read.
std::vector<std::vector<Interval>> joined(const std::vector<std::vector<Interval>>& boxes) {
  std::vector<std::vector<Interval>> groups;
  const auto touch = [](const std::vector<Interval>& a, const std::vector<Interval>& b) {
    return std::ranges::equal(
        a, b, [](const Interval& x, const Interval& y) { return !certain_disjoint(x, y); });
  };
  for (std::vector<Interval> box : boxes) {
    for (std::size_t g = 0; g < groups.size();) {
      if (!touch(groups[g], box)) {
        ++g;
        continue;
      }
      for (std::size_t i = 0; i < box.size(); ++i) box[i] = hull(box[i], groups[g][i]);
      groups.erase(groups.begin() + std::ptrdiff_t(g));
      g = 0;
    }
    groups.push_back(std::move(box));
  }
  return groups;
}

std::string place_text(const std::vector<SolvedUnknown>& unknowns,
                       const std::vector<Interval>& box) {
  std::string text;
  for (std::size_t i = 0; i < box.size(); ++i)
    text += fmt::format("{}{} = {:.6g}{}", text.empty() ? "" : ", ", unknowns[i].name, mid(box[i]),
                        unit_suffix(unknowns[i].unit));
  return text;
}

/// `varies`: something is uncertain.
std::string obstacle_of(const RootList& list, const Solutions& solutions, bool varies) {
  if (list.is_complete) return "";
  if (list.stopped_by) return describe(*list.stopped_by);
  const std::string place = place_text(solutions.unknowns, solutions.open.front());
  if (list.is_undefined)
    return "an expression of the equations is not certainly defined near " + place;
  if (list.is_doubtful) return "two solutions are not told apart near " + place;
  if (varies)
    return "the uncertain quantities and errors are too large to tell solutions apart near " +
           place;
  return "several solutions meet, or there are infinitely many, near " + place;
}

/// The system of a kernel.
class KernelSystem final : public RootSystem {
 public:
  KernelSystem(const Problem& problem, const PreparedSystem& prepared)
      : boxes_(problem, prepared.scaling, prepared.shape) {}

  void evaluate(std::span<const Box> boxes, bool has_rates) override {
    boxes_.evaluate(boxes, has_rates);
  }
  [[nodiscard]] std::optional<Values> at(std::size_t lane) const override {
    auto system = boxes_.at(lane);
    if (!system) return std::nullopt;
    return Values{std::move(*system)};
  }

 private:
  SystemBoxes boxes_;
};

class SystemSolver {
 public:
  explicit SystemSolver(const PreparedSystem& prepared)
      : prepared_(prepared), problem_(prepared.problem) {
    const Closure& closure = *prepared.request.model.closure;
    const std::vector<Interval> ranges = enclose_ranges(closure);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      ranges_.push_back(search_range(closure, i, ranges[i]));
      periods_.push_back(ranges_.back().period);
      problem_.outer[prepared.shape.variables + i] = ranges_.back().searched;
      problem_.inner[prepared.shape.variables + i] = ranges_.back().searched;
      const PoseParameter& unknown = closure.unknowns[i];
      solutions_.unknowns.push_back({unknown.name, unknown.unit, mid(ranges_.back().period)});
    }
  }

  Solutions solve(RootSettings settings, Observer* progress) {
    const bool varies = uncertain_count(prepared_.preparation) > 0;
    RootSettings first = settings;
    if (varies) {
      first.boxes_after_problem = kBoxesBeforeFollowing;
      first.min_relative_width = kWidthBeforeFollowing;
    }
    const RootList list = search(problem_, first, progress);
    for (const Root& root : list.roots) add(root, nullptr, solutions_.found);
    solutions_.open = joined(list.open);
    if (list.is_complete) solutions_.completeness = Completeness::kComplete;
    solutions_.how = describe_search(list.boxes);
    solutions_.obstacle = obstacle_of(list, solutions_, varies);
    if (varies && !list.is_complete && !list.stopped_by) {
      leave_rest(settings, list);
      follow(std::move(settings), progress);
    }
    sort_by_values(solutions_.found);
    return std::move(solutions_);
  }

 private:
  RootList search(const Problem& problem, const RootSettings& settings, Observer* progress) {
    RootList list =
        search_roots(question_of_system(problem, prepared_), periods_, settings, progress);
    count(list);
    return list;
  }

  /// `found`: by a search.
  template <class Found>
  void count(const Found& found) {
    solutions_.boxes += found.boxes;
    solutions_.seconds += found.seconds;
    solutions_.stopped_by = found.stopped_by;
  }

  /// Finds the solutions at the middles of what is uncertain, and follows them to its other values.
  void follow(RootSettings settings, Observer* progress) {
    const RootList list = search(at_middles(problem_, prepared_.shape), settings, progress);
    if (list.stopped_by) solutions_.obstacle = describe(*list.stopped_by);
    if (!list.is_complete) return;
    leave_rest(settings, list);
    std::vector<std::vector<Interval>> middles;
    for (const Root& root : list.roots) middles.push_back(root.values);
    const SolutionTubes tubes =
        follow_solutions(problem_, prepared_, periods_, middles, settings, progress);
    count(tubes);
    leave_rest(settings, tubes);
    std::vector<CertainSolution> found;
    for (std::size_t i = 0; i < list.roots.size(); ++i)
      if (tubes.tubes[i]) add(list.roots[i], &*tubes.tubes[i], found);
    if (tubes.are_all) {
      solutions_.completeness = Completeness::kComplete;
      solutions_.how = fmt::format(
          "{} with all that is uncertain in the middle of its range, and by one of {} boxes all "
          "over these ranges, none of which has a singular solution",
          describe_search(list.boxes), in_thousands(tubes.boxes));
    } else {
      solutions_.obstacle = why_left(tubes, list.roots.size());
      if (!tubes.stopped_by) look_for_change(list, tubes, std::move(settings), progress);
      // The first search may have told more of them apart.
      if (found.size() < solutions_.found.size()) return;
    }
    solutions_.found = std::move(found);
    solutions_.open = joined(tubes.open);
  }

  /// Looks for values of what is uncertain at which there are more or fewer solutions than at the middles.
  void look_for_change(const RootList& list, const SolutionTubes& tubes, RootSettings settings,
                       Observer* progress) {
    constexpr int kMostTrials = 4;
    const auto nominal = number_of(list);
    int trials = 0;
    for (std::size_t i = 0; i < list.roots.size() && nominal && trials < kMostTrials; ++i) {
      if (tubes.tubes[i]) continue;
      ++trials;
      const Problem elsewhere = towards_singular(problem_, prepared_, list.roots[i].values);
      const RootList other =
          search_roots(question_of_system(elsewhere, prepared_), periods_, settings, progress);
      leave_rest(settings, other);
      solutions_.boxes += other.boxes;
      solutions_.seconds += other.seconds;
      const auto number = number_of(other);
      if (!number || number == nominal) continue;
      solutions_.changes = true;
      solutions_.obstacle = fmt::format(
          "there are {} with all that is uncertain in the middle of its range, and {} with {}",
          *nominal, *number, values_text(elsewhere));
      return;
    }
  }

  /// Returns how many are within the ranges, if that is certain.
  [[nodiscard]] std::optional<std::size_t> number_of(const RootList& list) const {
    std::size_t number = 0;
    for (const Root& root : list.roots) {
      const auto place = place_in(root.values, ranges_);
      if (place == WithinLimits::kUnknown) return std::nullopt;
      number += place.has_value();
    }
    return list.is_complete ? std::optional(number) : std::nullopt;
  }

  /// "a2_1 = 10.05, l1 = 7.3 cm", of what is uncertain.
  [[nodiscard]] std::string values_text(const Problem& values) const {
    std::string text;
    const std::vector<VariableLabel>& labels = prepared_.preparation.labels.variables;
    for (std::size_t k = prepared_.shape.parameters; k < prepared_.shape.variables; ++k)
      if (problem_.outer[k].lo < problem_.outer[k].hi)
        text += fmt::format("{}{} = {}{}", text.empty() ? "" : ", ", labels[k].name,
                            shortest_text(values.outer[k].lo), unit_suffix(labels[k].unit));
    return text;
  }

  [[nodiscard]] std::string why_left(const SolutionTubes& tubes, std::size_t count) const {
    if (tubes.are_all) return "";
    if (tubes.stopped_by) return describe(*tubes.stopped_by);
    return fmt::format(
        "with all that is uncertain in the middle of its range {} all; elsewhere two may meet, or "
        "one may leave its range, near {}",
        count == 1 ? "1 solution is" : fmt::format("{} solutions are", count),
        place_text(solutions_.unknowns, tubes.open.front()));
  }

  static std::string describe_search(std::uint64_t boxes) {
    return fmt::format("by a search of {} box{}", in_thousands(boxes), boxes == 1 ? "" : "es");
  }

  /// Adds a solution, unless it is certainly not within the ranges. `tube`: where it is at other values
  /// of what is uncertain, if `root` has it at the middles; otherwise null.
  void add(const Root& root, const std::vector<Interval>* tube,
           std::vector<CertainSolution>& found) {
    CertainSolution result{tube != nullptr ? *tube : root.values, 0, root.sign};
    turn_back(result.values, ranges_);
    const auto place = place_in(result.values, ranges_);
    if (!place) return;
    result.limits = *place;
    result.condition = condition_at(root.values);
    if (tube != nullptr)
      for (const Interval& value : root.values) result.middle.push_back(mid(value));
    found.push_back(std::move(result));
  }

  [[nodiscard]] double condition_at(const std::vector<Interval>& values) const {
    const std::size_t n = prepared_.shape.unknowns, m = prepared_.shape.variables;
    SystemBoxes system(prepared_.problem, prepared_.scaling, prepared_.shape);
    std::vector<SystemBoxes::Box> point(1);
    point[0].assign(problem_.outer.begin(), problem_.outer.begin() + std::ptrdiff_t(m));
    for (const Interval& value : values) point[0].emplace_back(mid(value));
    system.evaluate(point);
    const auto at = system.at(0);
    if (!at) return 0;
    std::vector<double> matrix;
    for (const Interval& entry : at->by_unknown) matrix.push_back(mid(entry));
    return approx_condition(matrix, n);
  }

  const PreparedSystem& prepared_;
  Problem problem_;
  std::vector<SearchRange> ranges_;
  std::vector<Interval> periods_;
  Solutions solutions_;
};

}  // namespace

void require_values(const Request& request) {
  for (const MotionParameter& p : request.motion.parameters)
    if (!(p.range.hi - p.range.lo).is_zero())
      throw UsageError(fmt::format(
          "the motion {} gives {} a range; solutions are those at one value: give {}=VALUE by the "
          "option at",
          request.motion.name, p.name, p.name));
}

RootQuestion question_of_system(const Problem& problem, const PreparedSystem& prepared) {
  return {problem, prepared.shape,
          [&problem, &prepared] { return std::make_unique<KernelSystem>(problem, prepared); }};
}

RootQuestion question_of_followed(const Problem& problem, const PreparedSystem& prepared) {
  RootQuestion question = question_of_system(problem, prepared);
  question.regular = question.system;
  question.number = kNumberOfFollowed;
  return question;
}

RootQuestion question_of_system(const Problem& problem, const PreparedSystem& prepared,
                                std::size_t number) {
  return number == kNumberOfFollowed ? question_of_followed(problem, prepared)
                                     : question_of_system(problem, prepared);
}

Solutions solve_system(const PreparedSystem& prepared, const RootSettings& settings,
                       Observer* progress) {
  return SystemSolver(prepared).solve(settings, progress);
}

void sort_by_values(std::vector<CertainSolution>& solutions) {
  std::ranges::sort(solutions, [](const CertainSolution& a, const CertainSolution& b) {
    return std::ranges::lexicographical_compare(
        a.values, b.values, [](const Interval& x, const Interval& y) { return mid(x) < mid(y); });
  });
}

double approx_condition(std::span<const double> matrix, std::size_t n) {
  const auto vectors = approx_singular_vectors(matrix, n, n);
  if (!vectors) return kInfinity;
  return vectors->values.front() / vectors->values.back();
}

std::vector<double> usual_sizes(const Solutions& solutions) {
  constexpr double kPartOfLargest = 0x1p-8;
  const std::size_t n = solutions.unknowns.size();
  std::vector<double> own(n, 0.0), size;
  for (const CertainSolution& s : solutions.found)
    for (std::size_t i = 0; i < n; ++i) own[i] = std::max(own[i], mag(s.values[i]));
  for (std::size_t i = 0; i < n; ++i) {
    double largest = own[i];
    for (std::size_t j = 0; j < n; ++j)
      if (solutions.unknowns[j].unit == solutions.unknowns[i].unit)
        largest = std::max(largest, own[j]);
    size.push_back(std::max(own[i], kPartOfLargest * largest));
    if (solutions.unknowns[i].period > 0 || size[i] == 0) size[i] = std::max(size[i], 1.0);
  }
  return size;
}

}  // namespace regulus::detail
