// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/report/paving_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/formulation/variety.hpp"
#include "codegen/model/constants.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::inline report {
namespace {

/// Returns the resolution by the number of ranges, a power of 2: at most some ten thousand boxes.
double default_resolution(std::size_t ranges) {
  constexpr int kHalvings[] = {0, 9, 7, 5, 4, 3, 2};
  return std::ldexp(1.0, -kHalvings[std::min<std::size_t>(ranges, 6)]);
}

double parse_resolution(const std::string& text) {
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

std::string name_of_variable(const PreparedSearch& p, std::size_t k) {
  return p.labels.variables[k].name;
}

std::string listed(const PreparedSearch& p, const std::vector<std::size_t>& axes) {
  std::string words;
  for (const std::size_t k : axes) words += (words.empty() ? "" : ", ") + name_of_variable(p, k);
  return words.empty() ? "a motion with ranges" : words;
}

std::size_t parse_axis(const std::string& wanted, const PreparedSearch& p,
                       const std::vector<std::size_t>& axes) {
  for (const std::size_t k : axes)
    if (name_of_variable(p, k) == wanted) return k;
  throw UsageError(fmt::format("--axes: '{}' is not a parameter with a range; choose two of: {}",
                               wanted, listed(p, axes)));
}

std::vector<std::size_t> parse_axes(const std::string& text, const PreparedSearch& p,
                                    const std::vector<std::size_t>& axes) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos)
    throw UsageError("--axes: found '" + text + "', expected two motion parameters, p,q");
  const std::size_t first = parse_axis(text.substr(0, comma), p, axes);
  const std::size_t second = parse_axis(text.substr(comma + 1), p, axes);
  if (first == second)
    throw UsageError("--axes: found '" + text + "', expected two different parameters");
  return {first, second};
}

}  // namespace

PavingOptions resolve_paving(const PavingRequest& request, const SearchOptions& search,
                             const PreparedSearch& preparation) {
  if (search.uncertainty == Uncertainty::kVariables)
    throw UsageError(
        "--uncertainty variables: locate splits motion parameters only; use --uncertainty "
        "elements");
  PavingOptions options;
  options.axes = Volumes(preparation.problem()).axes();
  options.encloses_determinants =
      options.axes.size() == 1 && preparation.labels.rows == preparation.labels.columns;
  options.resolution = request.resolution.empty() ? default_resolution(options.axes.size())
                                                  : parse_resolution(request.resolution);
  options.drawn = options.axes;
  if (options.drawn.size() > 2) options.drawn.resize(2);
  if (!request.axes.empty()) options.drawn = parse_axes(request.axes, preparation, options.axes);
  if (request.draws && options.drawn.empty())
    throw UsageError(
        "--picture: there is nothing to draw, because no motion parameter has a range");
  return options;
}

void require_paving(const PavingOptions& options, Settings& settings) {
  // Halves are rounded, so a small slack avoids a seventh halving for 1/64.
  constexpr double kSlack = 1 + 0x1p-30;
  settings.exhaustive = true;
  settings.min_relative_width = options.resolution * kSlack;
  settings.enclose_determinants = settings.split_certified = options.encloses_determinants;
}

}  // namespace regulus::report
