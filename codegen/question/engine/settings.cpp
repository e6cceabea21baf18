// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/settings.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <thread>

#include "codegen/question/engine/choices.hpp"
#include "codegen/question/engine/ingredients.hpp"
#include "codegen/question/engine/search_run.hpp"

namespace regulus::detail {
namespace {

/// Returns the number of processors for this process, if the system reports it.
unsigned processors() noexcept {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0)
    return std::clamp(static_cast<unsigned>(CPU_COUNT(&allowed)), 1U, kMaxThreads);
  return std::clamp(std::thread::hardware_concurrency(), 1U, kMaxThreads);
}

}  // namespace

Settings settings_from(const SearchOptions& options) {
  require_valid(options);
  Settings settings;
  settings.method = options.method;
  settings.determinant = options.determinant;
  settings.bisection = options.bisection;
  settings.uncertainty = options.uncertainty;
  settings.entries =
      options.entries.value_or(fitting_entries(settings.method, settings.uncertainty));
  settings.threads = options.threads != 0 ? options.threads : processors();
  settings.workers = options.workers;
  if (options.max_boxes != 0) settings.max_boxes = options.max_boxes;
  if (options.time_limit != 0) settings.time_limit = options.time_limit;
  leave_out(options.without, settings);
  return settings;
}

std::vector<double> weights_of(const ReportLabels& labels, const SearchOptions& options) {
  if (options.weights.empty()) return {};
  if (options.bisection != Bisection::kWeighted)
    throw UsageError("--weight goes with --bisect weighted");
  std::vector<double> weights(labels.variables.size(), 1.0);
  for (const std::string& text : options.weights) {
    const std::size_t at = text.find('=');
    const auto of = std::ranges::find(labels.variables, text.substr(0, at), &VariableLabel::name);
    if (at == std::string::npos || of == labels.variables.end())
      throw UsageError(fmt::format("--weight: '{}' is no NAME=W with the name of a range", text));
    const char* const end = text.data() + text.size();
    double& weight = weights[std::size_t(of - labels.variables.begin())];
    const auto [read, error] = std::from_chars(text.data() + at + 1, end, weight);
    if (error != std::errc() || read != end || !(weight > 0) || !std::isfinite(weight))
      throw UsageError(fmt::format("--weight: '{}' has no number above 0", text));
  }
  return weights;
}

Settings settings_of(const PreparedSearch& prepared, const SearchOptions& options,
                     const std::atomic<bool>* interrupt) {
  Settings settings = settings_from(options);
  settings.interrupt = interrupt;
  settings.weights = weights_of(prepared.labels, options);
  settings.time_limit = seconds_left(prepared, settings.time_limit);
  for (const FilterFile& filter : prepared.filters) settings.filters.push_back(&filter.interface());
  return settings;
}

}  // namespace regulus::detail
