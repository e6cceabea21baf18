// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/engine/refusals.hpp"

#include <algorithm>
#include <vector>

#include "codegen/support/errors.hpp"

namespace regulus::inline engine {
namespace {

constexpr std::string_view kOneMethod = "for a load there is one method; leave the option out";
constexpr std::string_view kNoPicture = "a load has no picture; draw the boxes of the paving";
constexpr std::string_view kNoCheckpoint =
    "a search about a load cannot be continued; divide the ranges instead";

constexpr Refusal kRefusals[] = {
    {Asked::kLoad, "alpha", "forces have no threshold; change the limits in [actuators]"},
    {Asked::kLoad, "shard-size", "a proof about a load stays in one file"},
    {Asked::kLoad, "checkpoint", kNoCheckpoint},
    {Asked::kLoad, "checkpoint-every", kNoCheckpoint},
    {Asked::kLoad, "picture", kNoPicture},
    {Asked::kLoad, "axes", kNoPicture},
    {Asked::kLoad, "slices", kNoPicture},
    {Asked::kLoad, "shade", kNoPicture},
    {Asked::kLoad, "filter", "a filter tests a matrix, not forces"},
    {Asked::kLoad, "method", kOneMethod},
    {Asked::kLoad, "determinant", kOneMethod},
    {Asked::kLoad, "entries", kOneMethod},
    {Asked::kLoad, "bisect", kOneMethod},
    {Asked::kLoad, "uncertainty", kOneMethod},
    {Asked::kLoad, "precision", kOneMethod},
    {Asked::kLoad, "symbolic-budget", kOneMethod},
    {Asked::kLoad, "without", kOneMethod},
    {Asked::kPathCheck, "checkpoint", "a motion along way-points cannot be continued"},
    {Asked::kPathCheck, "shard-size", "the proof of a motion along way-points is one file"},
    {Asked::kPathPaving, "certificate",
     "there is no proof of the stretches of a motion along way-points; check proves the whole "
     "motion"},
    {Asked::kPathPaving, "picture",
     "a motion along way-points is not drawn; the paving has its stretches"}};

/// Returns the options that differ from their defaults, as the command calls them.
std::vector<std::string_view> changed_options(const ModelOptions& model,
                                              const SearchOptions& search) {
  const SearchOptions usual;
  std::vector<std::string_view> changed;
  const auto add = [&changed](std::string_view option, bool differs) {
    if (differs) changed.push_back(option);
  };
  add("alpha", !model.alpha.empty());
  add("filter", search.filters != usual.filters);
  add("method", search.method != usual.method);
  add("determinant", search.determinant != usual.determinant);
  add("entries", search.entries != usual.entries);
  add("bisect", search.bisection != usual.bisection);
  add("uncertainty", search.uncertainty != usual.uncertainty);
  add("precision", search.precision != usual.precision);
  add("symbolic-budget", search.symbolic_budget != usual.symbolic_budget);
  add("without", search.without != usual.without);
  return changed;
}

}  // namespace

std::span<const Refusal> refusals() { return kRefusals; }

std::optional<std::string> refusal(Asked asked, std::string_view option) {
  const auto row = std::ranges::find_if(
      kRefusals, [&](const Refusal& r) { return r.asked == asked && r.option == option; });
  if (row == std::end(kRefusals)) return std::nullopt;
  return std::string(row->option) + ": " + std::string(row->why);
}

void refuse(Asked asked, std::string_view option, bool is_given) {
  if (!is_given) return;
  if (const std::optional<std::string> why = refusal(asked, option)) throw UsageError(*why);
}

void refuse_option(Asked asked, std::string_view option, bool is_given) {
  if (!is_given) return;
  if (const std::optional<std::string> why = refusal(asked, option)) throw UsageError("--" + *why);
}

void refuse_changed(Asked asked, const ModelOptions& model, const SearchOptions& search) {
  for (const std::string_view option : changed_options(model, search)) refuse(asked, option, true);
}

}  // namespace regulus::engine
