// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/settings.hpp"

#include <sched.h>

#include <algorithm>
#include <thread>

#include "regulus/codegen/driver/ingredients.hpp"

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
  settings.method = parse_method(options.method).value();
  settings.determinant = options.determinant == "gauss"       ? Determinant::kElimination
                         : options.determinant == "expansion" ? Determinant::kExpansion
                                                              : Determinant::kBoth;
  settings.bisection = options.bisect == "widest"     ? Bisection::kWidest
                       : options.bisect == "weighted" ? Bisection::kWeighted
                                                      : Bisection::kImpact;
  settings.uncertainty =
      options.uncertainty == "variables" ? Uncertainty::kVariables : Uncertainty::kElements;
  settings.entries = options.entries == "natural" ? Entries::kNatural
                     : options.entries == "derivatives"
                         ? Entries::kDerivatives
                         : fitting_entries(settings.method, settings.uncertainty);
  settings.threads = options.threads != 0 ? options.threads : processors();
  if (options.max_boxes != 0) settings.max_boxes = options.max_boxes;
  if (options.time_limit != 0) settings.time_limit = options.time_limit;
  leave_out(options.without, settings);
  return settings;
}

}  // namespace regulus::codegen
