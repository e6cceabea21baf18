// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/margin/prepared_margin.hpp"

#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/model/exact/sign.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/support/stopwatch.hpp"

namespace regulus::detail {
namespace {

void require_searchable(const PreparedSearch& preparation, const Settings& settings) {
  if (const auto fault = find_fault(preparation.problem(), settings))
    throw UsageError("margin: " + *fault);
}

/// Returns the options for a kernel that serves every value.
SearchOptions for_every_value(SearchOptions options, const MarginQuestion& question) {
  options.threshold = question.quantity != MarginQuantity::kParameter;
  return options;
}

}  // namespace

SearchOptions compiled_first(SearchOptions options) {
  options.boxes_before_compiling = 0;
  return options;
}

double read_gap(const std::string& text) {
  double gap = 0;
  from_option("--gap", [&] {
    gap = approx_value(parse_constant(text, {.file = "", .key = "--gap"}).value).value_or(0);
  });
  if (!(gap > 0 && gap < 1))
    throw UsageError("--gap: found " + text + ", expected a number between 0 and 1");
  return gap;
}

PreparedMargin::PreparedMargin(const MarginQuestion& question, Request nominal,
                               double model_seconds, const SearchOptions& options,
                               FormingWatch watch)
    : request(std::move(nominal), question), search(for_every_value(options, question)) {
  prepared = prepare(request.at(forming_value(question)), model_seconds, search, std::move(watch));
  settings = settings_of(prepared, search, nullptr);
  if (prepared.stopped) settings.method = Method::kAuto;  // as in run_search
  require_searchable(prepared, settings);
}

}  // namespace regulus::detail
