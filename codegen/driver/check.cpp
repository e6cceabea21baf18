// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/check.hpp"

#include <nlohmann/json.hpp>

#include "regulus/codegen/driver/always_singular.hpp"
#include "regulus/codegen/driver/report.hpp"
#include "regulus/codegen/driver/search_run.hpp"
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

}  // namespace

Finding check(const Robot& robot, const std::string& motion, const CheckOptions& options) {
  // Complains in terms of the C++, and not of the file that it amounts to.
  static_cast<void>(robot.model());
  Preparation preparation = prepare(question(robot, motion, options), options.search);
  Settings settings = settings_from(options.search);
  for (const FilterFile& filter : preparation.filters)
    settings.filters.push_back(&filter.interface());
  Finding finding;
  finding.result =
      run_search(preparation, options.search, {.json = false, .quiet = true}, settings);
  recognise_always_singular(preparation, finding.result);
  const auto nearest = nearest_singular(preparation, finding.result);
  finding.verdict = finding.result.verdict;
  finding.claim = claim(preparation, finding.result);
  finding.report = text_report(preparation, options.search, finding.result, nearest);
  finding.json = json_report(preparation, options.search, finding.result, nearest).dump(2);
  for (const VariableLabel& variable : preparation.subject.variables)
    finding.variables.push_back(variable.name);
  return finding;
}

}  // namespace regulus::codegen
