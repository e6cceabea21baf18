// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/search/prepared.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "codegen/question/engine/settings.hpp"

namespace regulus::detail::bench {
namespace {

ModelOptions model_of(const SearchCase& which) {
  ModelOptions options;
  options.path = std::string_view(which.model).ends_with(".toml")
                     ? which.model
                     : fmt::format("{}/models/{}.toml", REGULUS_SOURCE_DIR, which.model);
  options.motion = which.motion;
  if (*which.tolerance != '\0')
    options.tolerances = {fmt::format("base,platform={}", which.tolerance)};
  return options;
}

}  // namespace

TimedSearch::TimedSearch(const SearchCase& which, const SearchOptions& options)
    : preparation_(prepare(model_of(which), options)), settings_(settings_from(options)) {}

void TimedSearch::run() { result_ = solver_.solve(preparation_.problem(), settings_); }

void TimedSearch::run_anew() { result_ = solve(preparation_.problem(), settings_); }

const Statistics& TimedSearch::statistics() const {
  if (result_.verdict == Verdict::kPossibleProblem)
    throw std::logic_error(fmt::format("no proof: {}", describe(result_.reason)));
  return result_.statistics;
}

}  // namespace regulus::detail::bench
