// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/api/prepared_question.hpp"

#include <algorithm>
#include <list>
#include <nlohmann/json.hpp>

#include "codegen/api/algebra_lock.hpp"
#include "codegen/engine/search_run.hpp"
#include "codegen/engine/settings.hpp"
#include "codegen/model/changes.hpp"
#include "codegen/report/question_report.hpp"
#include "codegen/report/report.hpp"
#include "codegen/support/stopwatch.hpp"

namespace regulus::inline api {
namespace {

/// The searches that are kept at the same time.
constexpr std::size_t kMostShapes = 8;

/// Everything but the ranges on which the functions of a search depend.
struct Shape {
  std::vector<std::string> variables;
  bool has_threshold = false;
  std::size_t conditions = 0;  ///< for parts of expressions, those of changed ranges included

  friend bool operator==(const Shape&, const Shape&) = default;
};

Shape shape_of(const Request& request, std::span<const Variable> variables) {
  Shape shape;
  for (const Variable& v : variables)
    shape.variables.push_back(v.name + ' ' + std::to_string(static_cast<int>(v.kind)) + ' ' +
                              std::to_string(v.ball));
  shape.has_threshold = !request.motion.alpha.is_zero();
  shape.conditions = request.model.must_be_defined.size() + request.motion.must_be_defined.size();
  return shape;
}

struct PreparedShape {
  Shape shape;
  PreparedSearch search;
};

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

}  // namespace

struct PreparedQuestion::Parts {
  ModelOptions model;
  SearchOptions search;
  Request nominal;
  std::list<PreparedShape> prepared;  ///< the last one used is the first

  Parts(const ModelOptions& asked, const SearchOptions& options)
      : model(unchanged(asked)), search(options), nominal(read_request(model)) {
    if (nominal.motion.trajectory)
      throw UsageError("prepare: a motion along way-points has no ranges to change; use check");
    // The file may change later.
    if (!model.text) model.text = model_text(model);
    search.boxes_before_compiling = 0;
  }

  /// Returns the search with the ranges and the threshold of the question.
  PreparedSearch& search_for(const Question& question, const std::atomic<bool>* interrupt);
  /// Throws    UsageError if the question is about another model or motion.
  [[nodiscard]] Request request_of(const Question& question) const;

 private:
  [[nodiscard]] ModelOptions options_of(const Question& question) const;
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
  apply_changes(request, options_of(question));
  return request;
}

PreparedSearch& PreparedQuestion::Parts::search_for(const Question& question,
                                                    const std::atomic<bool>* interrupt) {
  const Request request = request_of(question);
  const std::vector<Variable> variables = formulate_shape(request.model, request.motion).variables;
  const Shape shape = shape_of(request, variables);
  prepared.remove_if([](const PreparedShape& p) { return p.search.stopped.has_value(); });
  const auto at = std::ranges::find(prepared, shape, &PreparedShape::shape);
  if (at != prepared.end()) {
    prepared.splice(prepared.begin(), prepared, at);
    PreparedSearch& search_there = prepared.front().search;
    search_there.variety = enclose_variety(request.model, request.motion, variables);
    search_there.is_replanned = true;
    return search_there;
  }
  if (prepared.size() == kMostShapes) prepared.pop_back();
  prepared.push_front(
      {shape, prepare(options_of(question), search, FormingWatch{.interrupt = interrupt})});
  return prepared.front().search;
}

PreparedQuestion::PreparedQuestion(const Question& question, const SearchOptions& options,
                                   const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  parts_ = std::make_unique<Parts>(question.options(), options);
  static_cast<void>(parts_->search_for(question, interrupt));
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
  SearchOptions search = parts_->search;
  search.max_boxes = limits.max_boxes;
  search.time_limit = limits.time_limit;
  search.threads = limits.threads;
  Settings settings = settings_of(prepared, search, interrupt);
  settings.time_limit = settings_from(search).time_limit;  // the preparation is not counted again
  Finding finding;
  finding.result = run_search(prepared, search, settings);
  finding.verdict = finding.result.verdict;
  finding.claim = claim(prepared, finding.result);
  for (const VariableLabel& variable : prepared.labels.variables)
    finding.variables.push_back(variable.name);
  finding.seconds = watch.lap();
  return finding;
}

void PreparedQuestion::describe(const Question& question, Finding& finding) {
  const AlgebraLock lock;
  PreparedSearch& prepared = parts_->search_for(question, nullptr);
  const auto nearest = nearest_singular(prepared, finding.result);
  finding.report = text_report(prepared, parts_->search, finding.result, nearest);
  nlohmann::ordered_json report = json_report(prepared, parts_->search, finding.result, nearest);
  report["question"] = json_question(parts_->request_of(question), parts_->search);
  finding.json = report.dump(2);
}

}  // namespace regulus::api
