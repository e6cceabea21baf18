// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/api/prepared_question.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <list>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/answer/report/report_text.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/kernel/formulation/variable_ranges.hpp"
#include "codegen/model/changes.hpp"
#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/names.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/support/stopwatch.hpp"
#include "codegen/use/api/algebra_lock.hpp"

namespace regulus {

using namespace detail;

/// Everything but the ranges on which the functions of a search depend. Variables are the parameters
/// of the motion and what is uncertain.
struct QuestionShape {
  std::vector<std::string> parameters;
  std::vector<bool> uncertain;  ///< by constant of the model
  bool has_threshold = false;
  std::vector<GiNaC::ex> conditions;  ///< for parts of the expressions of changed ranges
};

namespace {

/// The searches that are kept at the same time.
constexpr std::size_t kMostShapes = 8;

/// Of a search in doubles alone, before exact algebra and more digits are asked.
constexpr std::uint64_t kBoxesInDoubles = 4096;

bool operator==(const QuestionShape& a, const QuestionShape& b) {
  const auto same = [](const GiNaC::ex& x, const GiNaC::ex& y) { return x.is_equal(y); };
  return a.parameters == b.parameters && a.uncertain == b.uncertain &&
         a.has_threshold == b.has_threshold && std::ranges::equal(a.conditions, b.conditions, same);
}

/// Appends what a change added to a list.
void append_added(std::vector<GiNaC::ex>& conditions, const std::vector<GiNaC::ex>& changed,
                  const std::vector<GiNaC::ex>& nominal) {
  conditions.insert(conditions.end(), changed.begin() + std::ptrdiff_t(nominal.size()),
                    changed.end());
}

QuestionShape shape_of(const Request& request, const Request& nominal) {
  const Model& model = request.model;
  QuestionShape shape;
  for (const MotionParameter& p : request.motion.parameters) shape.parameters.push_back(p.name);
  for (const GeometryParameter& g : model.geometry)
    shape.uncertain.push_back(g.ball >= 0 ? !model.balls.at(std::size_t(g.ball)).radius.is_zero()
                                          : !g.tolerance.is_zero());
  shape.has_threshold = !request.motion.alpha.is_zero();
  append_added(shape.conditions, model.must_be_defined, nominal.model.must_be_defined);
  append_added(shape.conditions, request.motion.must_be_defined, nominal.motion.must_be_defined);
  return shape;
}

bool same_range(const Range& a, const Range& b) {
  return a.lo.is_equal(b.lo) && a.hi.is_equal(b.hi);
}

/// Returns the question without the changes that a prepared one allows.
ModelOptions unchanged(ModelOptions options) {
  options.ranges.clear();
  options.tolerances.clear();
  options.alpha.clear();
  return options;
}

bool same_but_for_changes(const ModelOptions& a, const ModelOptions& b) {
  return a.path == b.path && a.text == b.text && a.motion == b.motion && a.tubes == b.tubes &&
         a.waypoints == b.waypoints;
}

SearchOptions limited(SearchOptions search, const SearchLimits& limits) {
  search.max_boxes = limits.max_boxes;
  search.time_limit = limits.time_limit;
  search.threads = limits.threads;
  return search;
}

}  // namespace

struct PreparedShape {
  QuestionShape shape;
  PreparedSearch search;
  std::vector<Variable> variables;     ///< with the ranges that `search` has
  bool has_ranges_of_doubles = false;  ///< of which `variables` knows nothing

  /// Gives the search the ranges and the threshold of a request of this shape. Most requests change
  /// few of them, and only those are enclosed.
  void replan(const Request& request) {
    std::vector<Variable> changed;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const Range range = range_at(request.model, request.motion, variables[i]);
      if (!has_ranges_of_doubles && same_range(range, variables[i].range)) continue;
      changed.push_back(variables[i]);
      changed.back().range = range;
      places.push_back(i);
    }
    const Variety variety = enclose_variety(request.model, request.motion, changed);
    for (std::size_t k = 0; k < places.size(); ++k) {
      variables[places[k]].range = changed[k].range;
      search.variety.outer[places[k]] = variety.outer[k];
      search.variety.inner[places[k]] = variety.inner[k];
    }
    search.variety.alpha = variety.alpha;
    search.is_replanned = true;
    has_ranges_of_doubles = false;
  }

  /// Takes these ranges of the first variables, and a variety for the others.
  void replan(std::span<const Interval> ranges, const Variety& others) {
    search.variety = others;
    std::ranges::copy(ranges, search.variety.outer.begin());
    std::ranges::copy(ranges, search.variety.inner.begin());
    search.is_replanned = true;
    has_ranges_of_doubles = true;
  }
};

struct PreparedQuestion::Parts {
  ModelOptions model;
  SearchOptions search;
  const Settings unlimited;  ///< of `search`
  Request nominal;
  std::list<PreparedShape> prepared;  ///< the last one used is the first

  /// Of the question that was prepared, with its changes.
  struct First {
    ModelOptions model;
    Request request;
    QuestionShape shape;
    std::vector<std::string> parameters;
    Variety variety;
  };
  First first;

  Parts(const ModelOptions& asked, const SearchOptions& options)
      : model(unchanged(asked)),
        search(options),
        unlimited(settings_from(limited(options, {}))),
        nominal(read_request(model)) {
    if (nominal.motion.trajectory)
      throw UsageError("prepare: a motion along way-points has no ranges to change; use check");
    // The file may change later.
    if (!model.text) model.text = model_text(model);
    search.boxes_before_compiling = 0;
  }
  /// Prepares the first question.
  void begin(const Question& question, const std::atomic<bool>* interrupt);

  /// Returns the search with the ranges and the threshold of the question.
  PreparedSearch& search_for(const Question& question, const std::atomic<bool>* interrupt);
  /// Returns that of the first question with these ranges of its parameters.
  PreparedSearch& search_for(std::span<const Interval> ranges, const std::atomic<bool>* interrupt);
  /// The preparation is not counted in the time limit.
  [[nodiscard]] Settings settings_for(const PreparedSearch& found, const SearchLimits& limits,
                                      const std::atomic<bool>* interrupt) const;
  /// Throws    UsageError if the question is about another model or motion.
  [[nodiscard]] Request request_of(const Question& question) const;

 private:
  [[nodiscard]] ModelOptions options_of(const Question& question) const;
  [[nodiscard]] PreparedShape& shape_for(const QuestionShape& wanted, const Request& request,
                                         const ModelOptions& asked,
                                         const std::atomic<bool>* interrupt);
  void require_ranges(std::span<const Interval> ranges) const;
};

ModelOptions PreparedQuestion::Parts::options_of(const Question& question) const {
  ModelOptions asked = question.options();
  if (!asked.text && asked.path == model.path) asked.text = model.text;
  if (!same_but_for_changes(asked, model))
    throw UsageError("a prepared question was asked about another model or motion");
  return asked;
}

Request PreparedQuestion::Parts::request_of(const Question& question) const {
  Request request = nominal;
  const ModelOptions asked = options_of(question);
  apply_changes(request, asked);
  stay_within_limits(request, asked);
  return request;
}

/// Returns the kept search of a shape, or prepares one for the request.
PreparedShape& PreparedQuestion::Parts::shape_for(const QuestionShape& wanted,
                                                  const Request& request, const ModelOptions& asked,
                                                  const std::atomic<bool>* interrupt) {
  prepared.remove_if([](const PreparedShape& p) { return p.search.stopped.has_value(); });
  const auto at =
      std::ranges::find_if(prepared, [&](const PreparedShape& p) { return p.shape == wanted; });
  if (at != prepared.end()) {
    prepared.splice(prepared.begin(), prepared, at);
    return prepared.front();
  }
  if (prepared.size() == kMostShapes) prepared.pop_back();
  prepared.push_front({wanted, prepare(asked, search, FormingWatch{.interrupt = interrupt}),
                       formulate_shape(request.model, request.motion).variables});
  return prepared.front();
}

PreparedSearch& PreparedQuestion::Parts::search_for(const Question& question,
                                                    const std::atomic<bool>* interrupt) {
  const Request request = request_of(question);
  PreparedShape& found =
      shape_for(shape_of(request, nominal), request, options_of(question), interrupt);
  found.replan(request);
  return found.search;
}

Settings PreparedQuestion::Parts::settings_for(const PreparedSearch& found,
                                               const SearchLimits& limits,
                                               const std::atomic<bool>* interrupt) const {
  Settings settings = unlimited;
  if (limits.threads != 0) settings.threads = limits.threads;
  if (limits.max_boxes != 0) settings.max_boxes = limits.max_boxes;
  if (limits.time_limit != 0) settings.time_limit = limits.time_limit;
  settings.interrupt = interrupt;
  settings.weights = weights_of(found.labels, search);
  for (const FilterFile& filter : found.filters) settings.filters.push_back(&filter.interface());
  return settings;
}

void PreparedQuestion::Parts::begin(const Question& question, const std::atomic<bool>* interrupt) {
  first.model = options_of(question);
  first.request = request_of(question);
  first.shape = shape_of(first.request, nominal);
  first.parameters = first.shape.parameters;
  first.variety = shape_for(first.shape, first.request, first.model, interrupt).search.variety;
}

void PreparedQuestion::Parts::require_ranges(std::span<const Interval> ranges) const {
  const std::vector<std::string>& parameters = first.parameters;
  if (ranges.size() != parameters.size())
    throw UsageError(
        fmt::format("{} ranges were given for {} parameters", ranges.size(), parameters.size()));
  for (std::size_t i = 0; i < ranges.size(); ++i)
    if (!std::isfinite(ranges[i].lo) || !std::isfinite(ranges[i].hi) || ranges[i].lo > ranges[i].hi)
      throw UsageError(fmt::format("the range [{}, {}] of {} is empty or not finite", ranges[i].lo,
                                   ranges[i].hi, in_quotes(parameters[i])));
  if (first.request.model.limits.empty() || first.model.beyond_limits) return;
  Request request = first.request;
  for (std::size_t i = 0; i < ranges.size(); ++i)
    request.motion.parameters[i].range = {exact_value(ranges[i].lo), exact_value(ranges[i].hi)};
  stay_within_limits(request, first.model);
}

PreparedSearch& PreparedQuestion::Parts::search_for(std::span<const Interval> ranges,
                                                    const std::atomic<bool>* interrupt) {
  require_ranges(ranges);
  PreparedShape& found = shape_for(first.shape, first.request, first.model, interrupt);
  found.replan(ranges, first.variety);
  return found.search;
}

PreparedQuestion::PreparedQuestion(const Question& question, const SearchOptions& options,
                                   const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  parts_ = std::make_unique<Parts>(question.options(), options);
  parts_->begin(question, interrupt);
}

const std::vector<std::string>& PreparedQuestion::parameters() const noexcept {
  return parts_->first.parameters;
}

PreparedQuestion::PreparedQuestion(PreparedQuestion&&) noexcept = default;

PreparedQuestion& PreparedQuestion::operator=(PreparedQuestion&& other) noexcept {
  const AlgebraLock lock;
  parts_ = std::move(other.parts_);
  return *this;
}

PreparedQuestion::~PreparedQuestion() {
  const AlgebraLock lock;
  parts_.reset();
}

Finding PreparedQuestion::check(const Question& question, const SearchLimits& limits,
                                const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  Stopwatch watch;
  PreparedSearch& prepared = parts_->search_for(question, interrupt);
  const SearchOptions search = limited(parts_->search, limits);
  Settings settings = parts_->settings_for(prepared, limits, interrupt);
  Finding finding;
  finding.result = run_search(prepared, search, settings);
  finding.verdict = finding.result.verdict;
  finding.claim = claim(prepared, finding.result);
  for (const VariableLabel& variable : prepared.labels.variables)
    finding.variables.push_back(variable.name);
  finding.seconds = watch.lap();
  return finding;
}

Result PreparedQuestion::check(std::span<const Interval> ranges, const SearchLimits& limits,
                               const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  PreparedSearch& prepared = parts_->search_for(ranges, interrupt);
  Settings settings = parts_->settings_for(prepared, limits, interrupt);
  if (!prepared.stopped) {
    Settings in_doubles = settings;
    in_doubles.max_boxes = std::min(settings.max_boxes, kBoxesInDoubles);
    Result result = prepared.solver.solve(prepared.problem(), in_doubles);
    if (result.verdict != Verdict::kPossibleProblem) return result;
    settings.time_limit = std::max(0.0, settings.time_limit - result.statistics.seconds);
  }
  return run_search(prepared, limited(parts_->search, limits), settings);
}

void PreparedQuestion::describe(const Question& question, Finding& finding,
                                const SearchLimits& limits) {
  const AlgebraLock lock;
  PreparedSearch& prepared = parts_->search_for(question, nullptr);
  const auto nearest = nearest_singular(prepared, finding.result);
  const SearchOptions search = limited(parts_->search, limits);
  finding.report = text_report(prepared, search, finding.result, nearest);
  nlohmann::ordered_json report = json_report(prepared, search, finding.result, nearest);
  report["question"] = without_head(json_question(parts_->request_of(question), search));
  finding.json = report_text(report, 2);
}

}  // namespace regulus
