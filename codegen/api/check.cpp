// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/api/check.hpp"

#include <nlohmann/json.hpp>

#include "codegen/api/algebra_lock.hpp"
#include "codegen/engine/search_run.hpp"
#include "codegen/engine/settings.hpp"
#include "codegen/report/report.hpp"

namespace regulus::inline api {

Finding check(const Question& question, const SearchOptions& options,
              const std::atomic<bool>* interrupt) {
  const AlgebraLock lock;
  SearchOptions search = options;
  search.boxes_before_compiling = 0;
  PreparedSearch prepared =
      prepare(question.options(), search, FormingWatch{.interrupt = interrupt});
  Finding finding;
  finding.result = run_search(prepared, search, settings_of(prepared, search, interrupt));
  const auto nearest = nearest_singular(prepared, finding.result);
  finding.verdict = finding.result.verdict;
  finding.claim = claim(prepared, finding.result);
  finding.report = text_report(prepared, search, finding.result, nearest);
  finding.json = json_report(prepared, search, finding.result, nearest).dump(2);
  for (const VariableLabel& variable : prepared.labels.variables)
    finding.variables.push_back(variable.name);
  return finding;
}

}  // namespace regulus::api
