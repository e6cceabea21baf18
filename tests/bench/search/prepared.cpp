// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/search/prepared.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "regulus/codegen/driver/settings.hpp"
#include "regulus/search/solver.hpp"

namespace regulus::bench {
namespace {

codegen::ModelOptions model_of(const SearchCase& which) {
  codegen::ModelOptions options;
  options.path = std::string_view(which.model).ends_with(".toml")
                     ? which.model
                     : fmt::format("{}/models/{}.toml", REGULUS_SOURCE_DIR, which.model);
  options.motion = which.motion;
  if (*which.tolerance != '\0')
    options.tolerances = {fmt::format("base,platform={}", which.tolerance)};
  return options;
}

}  // namespace

PreparedSearch::PreparedSearch(const SearchCase& which, const codegen::SearchOptions& options)
    : preparation_(codegen::prepare(model_of(which), options)),
      settings_(codegen::settings_from(options)) {}

void PreparedSearch::run() { result_ = solve(preparation_.problem(), settings_); }

const Statistics& PreparedSearch::statistics() const {
  if (result_.verdict != Verdict::kNoSingularity)
    throw std::logic_error(fmt::format("no proof: {}", describe(result_.reason)));
  return result_.statistics;
}

}  // namespace regulus::bench
