// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/settings.hpp"

#include <sched.h>

#include <algorithm>
#include <thread>

#include "regulus/codegen/driver/ingredients.hpp"
#include "regulus/codegen/driver/search_words.hpp"

namespace regulus::codegen {
namespace {

/// Those this process may run on, where the system tells.
unsigned processors() noexcept {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0)
    return std::clamp(static_cast<unsigned>(CPU_COUNT(&allowed)), 1U, kMaxThreads);
  return std::clamp(std::thread::hardware_concurrency(), 1U, kMaxThreads);
}

}  // namespace

Settings settings_from(const SearchOptions& options) {
  Settings settings;
  settings.method = method_of(options.method);
  settings.determinant = determinant_of(options.determinant);
  settings.bisection = bisection_of(options.bisect);
  settings.uncertainty = uncertainty_of(options.uncertainty);
  settings.entries =
      entries_of(options.entries).value_or(fitting_entries(settings.method, settings.uncertainty));
  require_ingredients(options.without);
  settings.threads = options.threads != 0 ? options.threads : processors();
  if (options.max_boxes != 0) settings.max_boxes = options.max_boxes;
  if (options.time_limit != 0) settings.time_limit = options.time_limit;
  leave_out(options.without, settings);
  return settings;
}

}  // namespace regulus::codegen
