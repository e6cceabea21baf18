// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/settings.hpp"

#include <sched.h>

#include <algorithm>
#include <thread>

#include "codegen/question/engine/choices.hpp"
#include "codegen/question/engine/ingredients.hpp"
#include "codegen/question/engine/search_run.hpp"

namespace regulus {
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

Settings settings_of(const PreparedSearch& prepared, const SearchOptions& options,
                     const std::atomic<bool>* interrupt) {
  Settings settings = settings_from(options);
  settings.interrupt = interrupt;
  settings.time_limit = seconds_left(prepared, settings.time_limit);
  for (const FilterFile& filter : prepared.filters) settings.filters.push_back(&filter.interface());
  return settings;
}

}  // namespace regulus
