// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/check.hpp"

#include <mutex>
#include <nlohmann/json.hpp>

#include "regulus/codegen/driver/report.hpp"
#include "regulus/codegen/driver/search_run.hpp"
#include "regulus/codegen/driver/search_words.hpp"
#include "regulus/codegen/driver/settings.hpp"

namespace regulus::codegen {
namespace {

ModelOptions question(const Robot& robot, const std::string& motion, const CheckOptions& options) {
  ModelOptions model;
  model.path = robot.name();
  model.text = robot.model_file();
  model.motion = motion;
  model.ranges = options.ranges;
  model.tolerances = options.tolerances;
  model.alpha = options.alpha;
  return model;
}

SearchOptions search_options(const CheckOptions& options) {
  SearchOptions search;
  search.method = name(options.method);
  search.determinant = word_of(options.determinant);
  search.entries = word_of(options.entries);
  search.bisect = word_of(options.bisection);
  search.uncertainty = word_of(options.uncertainty);
  search.engine = options.engine;
  search.isa = word_of(options.isa);
  search.use_cache = options.use_cache;
  search.filters = options.filters;
  search.without = options.without;
  search.max_boxes = options.max_boxes;
  search.threads = options.threads;
  search.time_limit = options.time_limit;
  search.symbolic_budget = options.symbolic_budget;
  search.precision = options.precision;
  search.boxes_before_compiling = 0;
  return search;
}

/// Held by whoever works with GiNaC's objects here: their state is that of the process.
std::mutex& algebra_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

Finding check(const Robot& robot, const std::string& motion, const CheckOptions& options) {
  const std::lock_guard lock(algebra_mutex());
  const SearchOptions search = search_options(options);
  // Complains in terms of the C++, and not of the file that it amounts to.
  static_cast<void>(robot.model());
  Preparation preparation = prepare(question(robot, motion, options), search);
  Settings settings = settings_from(search);
  settings.time_limit = seconds_left(preparation, settings.time_limit);
  for (const FilterFile& filter : preparation.filters)
    settings.filters.push_back(&filter.interface());
  Finding finding;
  finding.result = run_search(preparation, search, {.json = false, .quiet = true}, settings);
  const auto nearest = nearest_singular(preparation, finding.result);
  finding.verdict = finding.result.verdict;
  finding.claim = claim(preparation, finding.result);
  finding.report = text_report(preparation, search, finding.result, nearest);
  finding.json = json_report(preparation, search, finding.result, nearest).dump(2);
  for (const VariableLabel& variable : preparation.subject.variables)
    finding.variables.push_back(variable.name);
  return finding;
}

}  // namespace regulus::codegen
