// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/refusals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "codegen/answer/outputs.hpp"
#include "codegen/question/way/read_trajectory.hpp"
#include "codegen/support/errors.hpp"

namespace regulus {
namespace {

constexpr std::string_view kNoBoxes = "a picture is of the boxes of a paving; ask where, by locate";
constexpr std::string_view kOneMethod = "for a load there is one method; leave the option out";
constexpr std::string_view kNoTheorem =
    "Coq proves what the regularity of a matrix says; regulus-verify proves this";
constexpr std::string_view kNoWayTheorem = "Coq has the theorem about a force over ranges alone";

using enum Kind;
using enum Service;

constexpr Refusal kRefusals[] = {
    {kCondition2, kTheorem, kNoTheorem},
    {kLoad, kTheorem, kNoTheorem},
    {kLoadPaving, kTheorem, kNoTheorem},
    {kWayLimitMargin, kTheorem, kNoWayTheorem},
    {kWayBound, kTheorem, kNoWayTheorem},
    {kWayCondition2, kTheorem, kNoTheorem},
    {kWayLoad, kTheorem, kNoTheorem},
    {kWayLoadPaving, kTheorem, kNoTheorem},
    {kWayDatasheet, kTheorem, kNoWayTheorem},
    // What has no boxes has no picture.
    {kCheck, kPicture, kNoBoxes, false},
    {kMargin, kPicture, kNoBoxes, false},
    {kLimitMargin, kPicture, kNoBoxes, false},
    {kBound, kPicture, kNoBoxes, false},
    {kCondition2, kPicture, kNoBoxes, false},
    {kLoad, kPicture, kNoBoxes, false},
    {kDatasheet, kPicture, kNoBoxes, false},
    {kWayCheck, kPicture, kNoBoxes, false},
    {kWayMargin, kPicture, kNoBoxes, false},
    {kWayLimitMargin, kPicture, kNoBoxes, false},
    {kWayBound, kPicture, kNoBoxes, false},
    {kWayCondition2, kPicture, kNoBoxes, false},
    {kWayLoad, kPicture, kNoBoxes, false},
    {kWayDatasheet, kPicture, kNoBoxes, false},
};

constexpr OptionRefusal kOptionsOfLoads[] = {
    {"alpha", "forces have no threshold; change the limits in [actuators]"},
    {"filter", "a filter tests a matrix, not forces"},
    {"method", kOneMethod},
    {"determinant", kOneMethod},
    {"entries", kOneMethod},
    {"bisect", kOneMethod},
    {"uncertainty", kOneMethod},
    {"precision", kOneMethod},
    {"symbolic-budget", kOneMethod},
    {"without", kOneMethod},
};

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

/// A service that is asked for, and the option that asks for it.
struct RequestedService {
  Service service;
  const char* option;  ///< empty: none, the program is another one
};

std::vector<RequestedService> requested(const SearchOptions& search, const Services& services) {
  std::vector<RequestedService> result;
  if (!services.certificate.empty()) result.push_back({kProof, "certificate"});
  if (services.shard_size > 0) result.push_back({kShards, "shard-size"});
  if (!services.checkpoint.path.empty()) result.push_back({kCheckpoint, "checkpoint"});
  if (!services.pictures.files.empty() || !services.pictures.axes.empty())
    result.push_back({kPicture, "picture"});
  if (search.workers != nullptr) result.push_back({kRanks, ""});
  return result;
}

bool has_refused_service(Kind kind, const SearchOptions& search, const Services& services) {
  return std::ranges::any_of(requested(search, services), [kind](const RequestedService& request) {
    return refusal(kind, request.service).has_value();
  });
}

constexpr std::string_view kIntroduction =
    "# What works with what\n\n"
    "Each row is a kind of question, each column what it may ask for beside its answer. A number "
    "is "
    "the reason why\na question does not have it, below the table; – has no meaning. C++ and "
    "Python "
    "ask the same questions as the\ncommand. Every search takes limits, threads and an interrupt, "
    "and "
    "shows its progress on a terminal. Of bounds over\nranges Coq proves those of forces.\n\n";

/// Returns the number of a reason, from 1.
std::size_t number_of(std::string_view reason, std::vector<std::string_view>& reasons) {
  const auto known = std::ranges::find(reasons, reason);
  const auto number = std::size_t(known - reasons.begin()) + 1;
  if (known == reasons.end()) reasons.push_back(reason);
  return number;
}

std::string row_of(Kind kind, std::vector<std::string_view>& reasons) {
  std::string row = fmt::format("| {} |", name(kind));
  for (std::size_t s = 1; s < kServices; ++s) {
    const auto service = Service(s);
    const auto why = refusal(kind, service);
    const bool has_meaning = std::ranges::none_of(kRefusals, [&](const Refusal& r) {
      return r.kind == kind && r.service == service && !r.has_meaning;
    });
    row += !why           ? std::string(" yes |")
           : !has_meaning ? std::string(" – |")
                          : fmt::format(" {} |", number_of(*why, reasons));
  }
  return row + '\n';
}

}  // namespace

std::string name(Kind kind) {
  static constexpr std::array<std::string_view, kKinds / 2> kNames = {
      "check",        "locate",
      "margin",       "margin --quantity",
      "bound",        "bound condition --norm 2",
      "check --load", "locate --load",
      "datasheet"};
  const auto number = std::size_t(kind);
  const bool is_along_way = number >= kNames.size();
  return std::string(kNames[number % kNames.size()]) + (is_along_way ? ", along way-points" : "");
}

std::string_view name(Service service) {
  static constexpr std::array<std::string_view, kServices> kNames = {
      "answer", "proof", "shards", "theorem", "checkpoint", "ranks", "picture", "page"};
  return kNames[std::size_t(service)];
}

std::span<const Refusal> refusals() { return kRefusals; }
std::span<const OptionRefusal> option_refusals_of_loads() { return kOptionsOfLoads; }

std::optional<std::string_view> refusal(Kind kind, Service service) {
  for (const Refusal& row : kRefusals)
    if (row.kind == kind && (row.service == service || row.service == kAnswer)) return row.why;
  return std::nullopt;
}

void refuse_services(Kind kind, const SearchOptions& search, const Services& services) {
  if (const auto why = refusal(kind, kAnswer)) throw UsageError(std::string(*why));
  for (const RequestedService& request : requested(search, services))
    if (const auto why = refusal(kind, request.service))
      throw UsageError(*request.option == '\0'
                           ? std::string(*why)
                           : fmt::format("{}{}: {}", services.dashes, request.option, *why));
}

void refuse_services_along_way(Kind along, const ModelOptions& model, const SearchOptions& search,
                               const Services& services) {
  if (!refusal(along, kAnswer) && !has_refused_service(along, search, services)) return;
  if (read_trajectory(model, watch_of(services, search))) refuse_services(along, search, services);
}

void refuse_changed_options(const ModelOptions& model, const SearchOptions& search) {
  for (const std::string_view option : changed_options(model, search))
    for (const OptionRefusal& row : kOptionsOfLoads)
      if (row.option == option) throw UsageError(fmt::format("{}: {}", row.option, row.why));
}

std::string what_works() {
  std::string page = fmt::format("{}| question |", kIntroduction);
  for (std::size_t s = 1; s < kServices; ++s) page += fmt::format(" {} |", name(Service(s)));
  page += "\n|---|" + [] {
    std::string line;
    for (std::size_t s = 1; s < kServices; ++s) line += "---|";
    return line;
  }() + '\n';
  std::vector<std::string_view> reasons;
  for (std::size_t k = 0; k < kKinds; ++k) page += row_of(Kind(k), reasons);
  page += '\n';
  for (std::size_t i = 0; i < reasons.size(); ++i)
    page += fmt::format("{}. {}.\n", i + 1, reasons[i]);
  return page;
}

}  // namespace regulus
