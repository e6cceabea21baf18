// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/finite_error.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "codegen/question/closure/closure_report.hpp"
#include "codegen/question/closure/error_request.hpp"
#include "codegen/support/errors.hpp"

namespace regulus {
namespace {

constexpr std::size_t kMostParents = 32;
constexpr double kLeastWidth = 0x1p-30;  ///< of a range: boxes are not split further

/// Finds the tube over a box, and that over the same parameters without errors.
struct ErrorFinding {
  TubeFinding actual, nominal;
};

struct ErrorQuestion {
  const Problem& problem;
  ClosureQuestion closure;
  std::size_t parameters;                ///< of the motion
  const std::vector<Interval>& nominal;  ///< by variable: encloses its value without errors
};

/// A judge of boxes (runtime/search/box_judges.hpp).
class ErrorJudge {
 public:
  using Box = SystemBoxes::Box;
  using Question = ErrorQuestion;
  using Finding = ErrorFinding;

  explicit ErrorJudge(const ErrorQuestion& question)
      : question_(question), judge_(question.closure) {}

  void judge(std::span<const Box> boxes, std::span<ErrorFinding> findings, double horizon) {
    std::vector<TubeFinding> found(boxes.size());
    judge_.judge(boxes, found, horizon);
    for (std::size_t i = 0; i < boxes.size(); ++i) findings[i].actual = std::move(found[i]);
    std::vector<Box> nominal(boxes.begin(), boxes.end());
    for (Box& box : nominal)
      for (std::size_t k = question_.parameters; k < question_.closure.shape.parameters; ++k)
        box[k] = question_.nominal[k];
    found.assign(boxes.size(), {});
    judge_.judge(nominal, found, horizon);
    for (std::size_t i = 0; i < boxes.size(); ++i) findings[i].nominal = std::move(found[i]);
  }

  static void put(cluster::ByteWriter& to, const ErrorFinding& finding) {
    TubeJudge::put(to, finding.actual);
    TubeJudge::put(to, finding.nominal);
  }
  [[nodiscard]] static ErrorFinding take(cluster::ByteReader& from, const ErrorQuestion& question) {
    ErrorFinding finding;
    finding.actual = TubeJudge::take(from, question.closure);
    finding.nominal = TubeJudge::take(from, question.closure);
    return finding;
  }

 private:
  const ErrorQuestion question_;
  TubeJudge judge_;
};

/// A box that is not split yet, with the leaf of the branch that it is a part of.
struct ErrorBox {
  TreeBox at;
  std::size_t leaf = 0;
  double upper = kInfinity;
  std::vector<double> impact{};
  bool is_judged = false;

  friend bool operator<(const ErrorBox& a, const ErrorBox& b) noexcept {
    return a.upper < b.upper || (a.upper == b.upper && a.at.id > b.at.id);
  }
};

/// The goal of the search: box_search.hpp. The box with the largest bound is split first.
class ErrorGoal {
 public:
  static constexpr bool kJudgesWhenMade = false;

  ErrorGoal(BoxCourse& course, const ErrorQuestion& question, const BranchTree& branch,
            std::size_t unknown, double gap, FiniteError& result)
      : course_(course),
        question_(question),
        branch_(branch),
        unknown_(unknown),
        gap_(gap),
        result_(result) {
    for (std::size_t k = 0; k < question.closure.shape.parameters; ++k)
      ranges_.push_back(width_ru(question.problem.outer[k]));
  }

  /// The parts of the branch come in the place of the root.
  void start(const TreeBox&) {
    for (std::size_t leaf = 0; leaf < branch_.leaves().size(); ++leaf)
      if (branch_.leaves()[leaf].tube) open_.push({branch_.leaves()[leaf].at, leaf});
  }

  [[nodiscard]] bool has_ended() const { return open_.empty() || is_closed(); }
  void fill(std::vector<std::vector<Interval>>& boxes, std::uint64_t left) {
    round_.clear();
    const std::size_t most = std::min<std::uint64_t>(2 * kMostParents, left);
    while (round_.size() + 1 < most && !open_.empty() && !is_low(open_.top().upper)) {
      ErrorBox box = open_.top();
      open_.pop();
      if (!box.is_judged) {
        add(std::move(box), boxes);
        continue;
      }
      const auto variable = choose_variable(box.at.box, ranges_, box.impact, kLeastWidth);
      if (!variable) {
        settled_ = std::fmax(settled_, box.upper);
        continue;
      }
      auto [lower, upper] = course_.split(std::move(box.at), *variable);
      add({std::move(lower), box.leaf, box.upper, {}, true}, boxes);
      add({std::move(upper), box.leaf, box.upper, {}, true}, boxes);
    }
  }

  [[nodiscard]] double horizon() const { return 0; }
  [[nodiscard]] std::size_t open() const { return open_.size(); }

  void conclude(std::span<ErrorFinding> findings) {
    for (std::size_t i = 0; i < round_.size(); ++i) {
      ErrorBox& box = round_[i];
      if (const auto bounds = bounds_of(box, findings[i])) {
        box.upper = std::fmin(box.upper, bounds->upper);
        box.impact = bounds->impact;
        if (bounds->attained > result_.attained) {
          result_.attained = bounds->attained;
          result_.place = bounds->place;
        }
      }
      box.is_judged = true;
      if (is_low(box.upper))
        settled_ = std::fmax(settled_, box.upper);
      else
        open_.push(std::move(box));
    }
  }

  void finish() {
    result_.proved = course_.lacks_memory()
                         ? kInfinity
                         : std::fmax(settled_, open_.empty() ? 0 : open_.top().upper);
    result_.is_closed = is_low(result_.proved);
    if (!result_.is_closed) result_.stopped_by = course_.stopped_by();
    result_.boxes = course_.boxes();
  }

 private:
  struct Bounds {
    double upper = kInfinity, attained = 0;
    std::vector<Interval> place;
    std::vector<double> impact;
  };

  [[nodiscard]] bool is_low(double upper) const {
    return std::isfinite(upper) && upper - result_.attained <= gap_ * upper;
  }
  [[nodiscard]] bool is_closed() const { return !open_.empty() && is_low(open_.top().upper); }

  void add(ErrorBox box, std::vector<std::vector<Interval>>& boxes) {
    boxes.push_back(box.at.box);
    round_.push_back(std::move(box));
  }

  /// The tube's solution over its own centre is that of the branch, so it is over all of its box.
  [[nodiscard]] bool is_on_branch(const BranchTube& tube, std::size_t leaf) const {
    std::vector<Interval> place;
    for (const double x : tube.at) place.emplace_back(x);
    return certain_holds(*branch_.leaves()[leaf].tube, place, enclose(tube, place));
  }

  /// The nominal one is that of every part of the branch that its centre may lie in.
  [[nodiscard]] bool is_nominal(const BranchTube& tube) const {
    std::vector<Interval> place;
    for (std::size_t k = 0; k < ranges_.size(); ++k) place.emplace_back(tube.at[k]);
    const std::vector<std::size_t> leaves = branch_.leaves_at(place);
    return !leaves.empty() && std::ranges::all_of(leaves, [&](std::size_t leaf) {
      return branch_.leaves()[leaf].tube && is_on_branch(tube, leaf);
    });
  }

  /// p_i(x, e) − p_i(x, 0) for places of the box, as a linear function and a remainder.
  std::optional<Bounds> bounds_of(const ErrorBox& box, const ErrorFinding& finding) const {
    const auto &actual = finding.actual.tube, &nominal = finding.nominal.tube;
    if (!actual || !nominal || !is_on_branch(*actual, box.leaf) || !is_nominal(*nominal))
      return std::nullopt;
    const std::size_t m = question_.closure.shape.variables, i = unknown_;
    Bounds bounds;
    const Interval remainder(-add_ru(actual->radius[i], nominal->radius[i]),
                             add_ru(actual->radius[i], nominal->radius[i]));
    Interval sum = Interval(actual->center[i]) - Interval(nominal->center[i]);
    Interval at_vertex[2] = {sum, sum};
    std::vector<Interval> vertex[2];
    for (std::size_t k = 0; k < m; ++k) {
      Interval slope(actual->slopes[i * m + k]);
      const bool is_shared = k < question_.parameters && actual->at[k] == nominal->at[k];
      const Interval reach = box.at.box[k] - Interval(actual->at[k]);
      if (k < question_.parameters && !is_shared) return std::nullopt;
      const Interval of_nominal(nominal->slopes[i * m + k]);
      if (is_shared) slope -= of_nominal;
      // The nominal value need not be the centre of its tube.
      const Interval off = is_shared
                               ? Interval(0.0)
                               : of_nominal * (question_.nominal[k] - Interval(nominal->at[k]));
      sum += slope * reach - off;
      for (const int side : {0, 1}) {
        const bool is_upper = (mid(slope) >= 0) == (side == 1);
        const Interval end = inner_end(box.at.box[k], k, is_upper);
        vertex[side].push_back(end);
        at_vertex[side] += slope * (end - Interval(actual->at[k])) - off;
      }
    }
    // The linear part is attained at a vertex; what a split makes smaller is the remainder.
    for (std::size_t k = 0; k < ranges_.size(); ++k)
      bounds.impact.push_back(impact(finding.actual, k) * actual->radius[i] +
                              impact(finding.nominal, k) * nominal->radius[i]);
    bounds.upper = mag(sum + remainder);
    for (const int side : {0, 1}) {
      const double attained = mig(at_vertex[side] + remainder);
      if (attained <= bounds.attained) continue;
      bounds.attained = attained;
      bounds.place = vertex[side];
    }
    return bounds;
  }

  static double impact(const TubeFinding& finding, std::size_t k) {
    return k < finding.impact.size() ? finding.impact[k] : 0;
  }

  /// A place of the true range, or what encloses its only value.
  [[nodiscard]] Interval inner_end(const Interval& range, std::size_t k, bool is_upper) const {
    const std::optional<Interval>& inner = question_.problem.inner[k];
    if (!inner) return range;
    return Interval(std::clamp(is_upper ? range.hi : range.lo, inner->lo, inner->hi));
  }

  BoxCourse& course_;
  const ErrorQuestion& question_;
  const BranchTree& branch_;
  const std::size_t unknown_;
  const double gap_;
  FiniteError& result_;
  std::vector<double> ranges_;
  std::priority_queue<ErrorBox> open_;
  std::vector<ErrorBox> round_;
  double settled_ = 0;
};

}  // namespace

std::vector<std::size_t> unknowns_of(const Request& request, const QuantityOptions& quantity,
                                     const std::string& limit) {
  if (!request.model.closure)
    throw UsageError(
        "--finite is for models with a [closure], whose configuration is a solution "
        "of equations");
  if (quantity.quantity != "error")
    throw UsageError("--finite is about error; " + quantity.quantity + " has no finite form");
  if (!limit.empty() || quantity.least || quantity.is_signed || !quantity.norm.empty() ||
      !quantity.load.empty() || !quantity.twist.empty() || !quantity.row.empty())
    throw UsageError(
        "--finite brackets the largest error of each unknown: leave --limit, --min, "
        "--signed, --norm, --load, --twist and --leg out");
  std::vector<std::size_t> unknowns;
  std::string names;
  for (std::size_t i = 0; i < request.model.closure->unknowns.size(); ++i) {
    const std::string& name = request.model.closure->unknowns[i].name;
    names += (names.empty() ? "" : ", ") + name;
    if (quantity.freedom.empty() || quantity.freedom == name) unknowns.push_back(i);
  }
  if (unknowns.empty())
    throw UsageError("--freedom: there is no unknown '" + quantity.freedom + "'; there are " +
                     names);
  return unknowns;
}

FiniteErrors bound_finite_errors(const Request& request, const std::vector<std::size_t>& unknowns,
                                 double gap, const SearchOptions& search, const FormingWatch& watch,
                                 Observer* progress) {
  const ErrorRequest errors = with_errors_as_parameters(request);
  PreparedClosure prepared = prepare_closure(errors.request, 0, search, watch);
  FiniteErrors found;
  for (const MotionParameter& p : errors.request.motion.parameters) {
    found.parameters.push_back(p.name);
    found.units.push_back(p.unit);
  }
  const ClosureFinding checked = check_closure(prepared, search, watch, progress);
  const ClosureResult& branch = checked.searched;
  found.boxes = branch.branch.boxes;
  found.seconds = prepared.preparation.seconds.search;
  if (!branch.is_proved()) {
    found.obstacle = checked.is_refuted()
                         ? "within the errors the branch reaches a singular configuration"
                         : reason_of(checked);
    found.folds = checked.folds;
    return found;
  }
  const ErrorQuestion question{prepared.problem, prepared.question(), errors.parameters,
                               prepared.start.place};
  const Closure& closure = *request.model.closure;
  for (const std::size_t i : unknowns) {
    FiniteError& error = found.unknowns.emplace_back();
    error.name = closure.unknowns[i].name, error.unit = closure.unknowns[i].unit;
    BoxSearchSettings limits = settings_of(prepared, search, watch.interrupt);
    if (search.time_limit != 0) limits.time_limit -= found.seconds;
    BoxCourse course(prepared.problem, limits, progress);
    ErrorGoal goal(course, question, branch.branch.tree, i, gap, error);
    BoxSearch<ErrorJudge, ErrorGoal>(question, 2 * kMostParents, course, goal).run();
    goal.finish();
    found.seconds += course.seconds();
  }
  return found;
}

}  // namespace regulus
