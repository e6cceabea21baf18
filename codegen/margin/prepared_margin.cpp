// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/margin/prepared_margin.hpp"

#include "codegen/engine/settings.hpp"
#include "codegen/model/expression_parser.hpp"
#include "codegen/model/sign.hpp"
#include "codegen/support/stopwatch.hpp"

namespace regulus::inline bracketing {
namespace {

/// Returns the value at which the kernel is formed. The kernel is the same at all values except 0,
/// where quantities would not be uncertain, so the value is not 0.
MarginValue forming_value(const MarginQuestion& question) {
  return question.high ? *question.high : decimal_value(1);
}

void require_searchable(const PreparedSearch& preparation, const Settings& settings) {
  if (const auto fault = find_fault(preparation.problem(), settings))
    throw UsageError("margin: " + *fault);
}

/// Returns the options for a kernel that serves every value.
SearchOptions for_every_value(SearchOptions options, const MarginQuestion& question) {
  options.threshold = question.quantity != MarginQuantity::kParameter;
  return options;
}

/// Returns the options of a search that is worth a compiler before it begins.
SearchOptions compiled_first(SearchOptions options) {
  options.boxes_before_compiling = 0;
  return options;
}

}  // namespace

double read_gap(const std::string& text) {
  double gap = 0;
  from_option("--gap", [&] {
    gap = approx_value(parse_constant(text, {.file = "", .key = "--gap"}).value).value_or(0);
  });
  if (!(gap > 0 && gap < 1))
    throw UsageError("--gap: found " + text + ", expected a number between 0 and 1");
  return gap;
}

PreparedMargin::PreparedMargin(const MarginQuestion& question, const ModelOptions& model,
                               const SearchOptions& options, FormingWatch watch)
    : PreparedMargin(question, read_request(model), 0, compiled_first(options), std::move(watch)) {}

PreparedMargin::PreparedMargin(const MarginQuestion& question, Request nominal,
                               double model_seconds, const SearchOptions& options,
                               FormingWatch watch)
    : request(std::move(nominal), question), search(for_every_value(options, question)) {
  prepared = prepare(request.at(forming_value(question)), model_seconds, search, std::move(watch));
  settings = settings_of(prepared, search, nullptr);
  if (prepared.stopped) settings.method = Method::kAuto;  // as in run_search
  require_searchable(prepared, settings);
}

}  // namespace regulus::bracketing
