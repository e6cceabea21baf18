// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closure_run.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/closure_start.hpp"
#include "codegen/question/closure/start_test.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/quantity/quantity.hpp"

namespace regulus::detail {
namespace {

/// A usual radius is divided by this, so often at most.
constexpr int kPartOfRadius = 10, kSmallerRadii = 4;

/// The kernel needs the entries of the matrix and their derivatives, and no product.
SearchOptions options_of_kernel(SearchOptions search) {
  search.method = Method::kReg;
  search.entries = Entries::kDerivatives;
  search.uncertainty = Uncertainty::kElements;
  for (const char* ingredient : {"columns", "rows"})
    if (std::ranges::find(search.without, ingredient) == search.without.end())
      search.without.emplace_back(ingredient);
  return search;
}

/// A kernel whose unknowns are no motion parameters: what measures boxes must not see them.
class KernelOfClosure final : public LoadedKernel {
 public:
  KernelOfClosure(std::unique_ptr<LoadedKernel> kernel, std::size_t parameters)
      : kernel_(std::move(kernel)), functions_(kernel_->functions()) {
    functions_.motion_variables = unsigned(parameters);
  }
  [[nodiscard]] const regulus_kernel& functions() const noexcept override { return functions_; }

 private:
  std::unique_ptr<LoadedKernel> kernel_;
  regulus_kernel functions_;
};

/// The report is about the question as it was asked, and not about the kernel.
void relabel(PreparedSearch& p, const Request& request, const ClosedSystem& system) {
  p.labels.variables = system.labels;
  p.labels.pose.clear();
  for (const PoseParameter& pose : request.model.pose)
    p.labels.pose.push_back({pose.name, pose.unit});
  p.labels.rows = p.labels.columns = int(system.shape.unknowns);
  p.labels.matrix_kind = request.model.matrix_kind;
  p.labels.is_branch = true;
  p.labels.matrix_notes = request.model.matrix_notes;
  p.labels.notes = request.notes;
  p.labels.where = name(request.motion.where);
  p.labels.reach = 0;
  p.labels.constraints = request.motion.constraints.size();
  p.is_replanned = true;  // the kernel's request is another one
  p.variety.outer.resize(system.shape.variables);
  p.variety.inner.resize(system.shape.variables);
}

/// Returns the part of a range that is certain. If there is none it is a point, in which no tube is: an
/// Interval with its ends in the wrong order would be the whole line.
Interval certain_part(const Interval& lo, const Interval& hi) {
  return lo.hi <= hi.lo ? Interval(lo.hi, hi.lo) : Interval(lo.lo);
}

void fill_start(PreparedClosure& prepared) {
  const Closure& closure = *prepared.request.model.closure;
  BranchStart& start = prepared.start;
  for (const GiNaC::ex& x : start_of(prepared.request.model, prepared.request.motion))
    start.place.push_back(enclose_constant(x, "start"));
  for (std::size_t i = 0; i < closure.unknowns.size(); ++i) {
    const std::string& name = closure.unknowns[i].name;
    start.values.push_back(enclose_constant(closure.start[i], "start." + name));
    start.radius.push_back(enclose_constant(closure.start_radius[i], "radius." + name));
    prepared.near_start.unknowns.push_back(mid(start.values.back()));
  }
  for (std::size_t i = 0; i < closure.unknowns.size(); ++i) {
    const std::string name = "range." + closure.unknowns[i].name;
    prepared.ranges.push_back(certain_part(enclose_constant(closure.ranges[i].lo, name),
                                           enclose_constant(closure.ranges[i].hi, name)));
  }
  // The start has no errors, so copies of the unknowns have the same values there.
  for (std::size_t i = 0; i + closure.unknowns.size() < prepared.shape.unknowns; ++i) {
    start.values.push_back(Interval(start.values[i]));
    start.radius.push_back(Interval(start.radius[i]));
    prepared.near_start.unknowns.push_back(double(prepared.near_start.unknowns[i]));
    prepared.ranges.push_back(Interval(prepared.ranges[i]));
  }
  const std::set<std::string> uncertain = uncertain_names(prepared.request);
  for (const GeometryParameter& g : prepared.request.model.geometry)
    if (uncertain.contains(g.name)) start.place.push_back(enclose_constant(g.value, g.name));
  start.place.resize(prepared.shape.variables, Interval(0.0));  // the errors
  for (const Interval& x : start.place) prepared.near_start.variables.push_back(mid(x));
}

}  // namespace

std::optional<Request> read_closure(const ModelOptions& options, const FormingWatch& watch) {
  const std::string text = model_text(options);
  if (text.find("closure") == std::string::npos) return std::nullopt;
  Request request = read_request(text, options, &watch);
  if (!request.model.closure) return std::nullopt;
  const Motion& motion = request.motion;
  if (!motion.waypoints && !motion.trajectory)
    (void)start_within_constraints(request.model, motion);
  return request;
}

std::vector<Interval> enclose_ranges(const Closure& closure) {
  std::vector<Interval> ranges;
  for (std::size_t i = 0; i < closure.unknowns.size(); ++i) {
    const std::string name = "range." + closure.unknowns[i].name;
    ranges.push_back(hull(enclose_constant(closure.ranges[i].lo, name),
                          enclose_constant(closure.ranges[i].hi, name)));
  }
  return ranges;
}

PreparedSystem prepare_system(Request request, double model_seconds, const SearchOptions& search,
                              const FormingWatch& watch, DerivativesBy by,
                              const std::vector<PoseParameter>& constants) {
  if (!request.motion.alpha.is_zero()) require_determinant_of_radians(request.model, "alpha");
  PreparedSystem prepared;
  ClosedSystem system = close(request, by, constants);
  prepared.shape = system.shape;
  prepared.preparation = prepare(system.request, model_seconds, options_of_kernel(search), watch);
  prepared.preparation.kernel = std::make_unique<KernelOfClosure>(
      std::move(prepared.preparation.kernel), system.shape.parameters);
  prepared.problem = prepared.preparation.problem();
  prepared.problem.idle.clear();
  prepared.scaling = prepared.preparation.stages->formulation().scaling;
  prepared.preparation.variety.alpha = enclose_constant(request.motion.alpha, "alpha");
  prepared.request = std::move(request);
  relabel(prepared.preparation, prepared.request, system);
  return prepared;
}

PreparedClosure prepare_closure(Request request, double model_seconds, const SearchOptions& search,
                                const FormingWatch& watch, DerivativesBy by,
                                const std::vector<PoseParameter>& constants) {
  PreparedClosure prepared{
      prepare_system(std::move(request), model_seconds, search, watch, by, constants), {}, {}, {}};
  fill_start(prepared);
  if (constants.empty()) fit_start(prepared, prepared.problem);
  return prepared;
}

void fit_start(PreparedClosure& prepared, const Problem& problem) {
  if (prepared.preparation.stopped) return;
  Closure& closure = *prepared.request.model.closure;
  const BranchStart given = prepared.start;
  SystemBoxes system(problem, prepared.scaling, prepared.shape);
  prepared.obstacle_of_start = obstacle_of_start(system, prepared.shape, given);
  if (std::ranges::find(closure.is_radius_usual, 1) == closure.is_radius_usual.end()) return;
  GiNaC::numeric part = 1;
  for (int k = 0; k < kSmallerRadii && !prepared.obstacle_of_start.empty(); ++k) {
    part /= kPartOfRadius;
    std::vector<GiNaC::ex> radius = closure.start_radius;
    for (std::size_t i = 0; i < closure.is_radius_usual.size(); ++i)
      if (closure.is_radius_usual[i] != 0) radius[i] *= part;
    BranchStart smaller = given;
    for (std::size_t i = 0; i < smaller.radius.size(); ++i)
      smaller.radius[i] = enclose_constant(radius[i % radius.size()], "radius");
    if (!obstacle_of_start(system, prepared.shape, smaller).empty()) continue;
    prepared.obstacle_of_start.clear();
    prepared.start = std::move(smaller);
    closure.start_radius = std::move(radius);
  }
}

ClosureResult without_start(const PreparedClosure& prepared, const ClosureQuestion& question,
                            const BranchSettings& settings, Observer* progress) {
  BranchSettings nothing = settings;
  nothing.max_boxes = 0;
  ClosureResult result;
  result.branch = search_branch(question, nothing, progress);
  result.branch.stopped_by.reset();
  result.branch.reason = Reason::kWidth;
  result.links.on_branch.assign(result.branch.tree.leaves().size(), 0);
  result.links.obstacle = prepared.obstacle_of_start;
  result.has_start = false;
  return result;
}

BranchSettings settings_of(const PreparedSystem& prepared, const SearchOptions& search,
                           const std::atomic<bool>* interrupt) {
  BranchSettings settings;
  set_limits(settings, prepared.preparation, search, interrupt);
  return settings;
}

BoxSearchSettings rest_of(const BranchSettings& settings, const Deadline& deadline,
                          std::uint64_t spent_boxes) {
  BoxSearchSettings rest = settings;
  rest.time_limit = std::fmax(deadline.left(), 0.0);
  rest.max_boxes -= std::min(rest.max_boxes, spent_boxes);
  return rest;
}

ClosureResult run_closure(PreparedClosure& prepared, const BranchSettings& settings,
                          Observer* progress, const KeptPieces& kept) {
  const ClosureQuestion question = prepared.question();
  if (!prepared.obstacle_of_start.empty())
    return without_start(prepared, question, settings, progress);
  const Deadline deadline(settings);
  BranchSettings first = settings;
  first.time_limit *= kPartOfSearch;
  ClosureResult result;
  result.branch = kept.run(first, [&](const BranchSettings& chosen) {
    return search_branch(question, chosen, progress);
  });
  Stopwatch watch;
  if (settings.paves || (result.branch.is_complete && !result.branch.is_empty))
    result.links = link_branch(question, result.branch.tree, prepared.start,
                               [&] { return deadline.reason(); });
  prepared.preparation.seconds.search = result.branch.seconds + watch.lap();
  return result;
}

nlohmann::ordered_json checkpointed_question(const PreparedClosure& prepared,
                                             const SearchOptions& search, double resolution) {
  nlohmann::ordered_json question = json_question(prepared.request, search);
  question.erase("options");  // they change how long it takes
  question["closure"] = prepared.shape.unknowns;
  question["paves"] = resolution > 0;
  question["least_width"] = resolution > 0 ? resolution : BranchSettings{}.min_relative_width;
  return question;
}

}  // namespace regulus::detail
