// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/paving_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/model/constants.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::detail {
namespace {

/// Returns the resolution by the number of ranges, a power of 2: at most some ten thousand boxes.
double default_resolution(std::size_t ranges) {
  constexpr int kHalvings[] = {0, 9, 7, 5, 4, 3, 2};
  return std::ldexp(1.0, -kHalvings[std::min<std::size_t>(ranges, 6)]);
}

}  // namespace

double read_resolution(const std::string& text) {
  double value = 0;
  try {
    value = mid(enclose_constant(parse_constant(text, {.file = "", .key = "resolution"}).value,
                                 "the resolution"));
  } catch (const InputError& error) {
    throw UsageError(std::string("--resolution: ") + error.what());
  }
  if (!(value > 0 && value <= 1))
    throw UsageError("--resolution: found " + text +
                     ", expected a number above 0 and at most 1, such as 1/64");
  return value;
}

PavingOptions resolve_paving(const std::string& resolution, const SearchOptions& search,
                             const PreparedSearch& preparation) {
  if (search.uncertainty == Uncertainty::kVariables)
    throw UsageError(
        "--uncertainty variables: locate splits motion parameters only; use --uncertainty "
        "elements");
  PavingOptions options;
  options.axes = Volumes(preparation.problem()).axes();
  options.encloses_determinants =
      options.axes.size() == 1 && preparation.labels.rows == preparation.labels.columns;
  options.resolution =
      resolution.empty() ? default_resolution(options.axes.size()) : read_resolution(resolution);
  return options;
}

void require_paving(const PavingOptions& options, Settings& settings) {
  // Halves are rounded, so a small slack avoids a seventh halving for 1/64.
  constexpr double kSlack = 1 + 0x1p-30;
  settings.exhaustive = true;
  settings.min_relative_width = options.resolution * kSlack;
  settings.enclose_determinants = settings.split_certified = options.encloses_determinants;
}

}  // namespace regulus::detail
