// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/refusals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "codegen/answer/outputs.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/closure/closure_run.hpp"
#include "codegen/question/way/read_trajectory.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

constexpr std::string_view kNoBoxes = "a picture is of the boxes of a paving; ask where, by locate";
constexpr std::string_view kOneMethod = "for a load there is one method; leave the option out";
constexpr std::string_view kOneMethodOfClosures =
    "for a [closure] there is one method; leave the option out";
constexpr std::string_view kOneKernel =
    "only check, over ranges and without a load, takes the text of a kernel; leave the option out";
constexpr std::string_view kNoProofOfTexts =
    "a proof file is about the model, and not about the text of a kernel; leave one of the two out";
constexpr std::string_view kNoPageOfTexts =
    "a page proves again what the model says, and not the text of a kernel; leave one of the two "
    "out";
constexpr std::string_view kNoTheoremOfSolutions =
    "Coq proves lists of poses: in the plane that they are all; in space that they are all if the "
    "complex ones are counted, given the theorem about their number, and of INCOMPLETE ones that "
    "there are at least these; it has no theorem about lists in space that were searched and about "
    "postures; what has a proof in a file, regulus-verify proves";
constexpr std::string_view kNoTheoremAlongWay =
    "along way-points Coq proves lists of poses in the plane, and none in space or of postures; "
    "what has a proof in a file, regulus-verify proves";
constexpr std::string_view kNoBoxesOfSolutions =
    "a picture is of the boxes of a paving, not of solutions";
constexpr std::string_view kOneMethodOfSolutions =
    "all solutions are found by one method; leave the option out";

using enum Kind;
using enum Service;

constexpr Refusal kRefusals[] = {
    {kWaySolve, kTheorem, kNoTheoremAlongWay},
    {kWaySolve, kPicture, kNoBoxesOfSolutions, false},
    {kClosureWaySolve, kPicture, kNoBoxesOfSolutions, false},
    {kSolve, kTheorem, kNoTheoremOfSolutions},
    {kSolve, kPicture, kNoBoxesOfSolutions, false},
    {kClosureSolve, kPicture, kNoBoxesOfSolutions, false},
};

constexpr OptionRefusal kOptionsOfLoads[] = {
    {"alpha", "forces have no threshold; change the limits in [actuators]"},
    {"kernel", kOneKernel},
    {"filter", "a filter tests a matrix, not forces"},
    {"method", kOneMethod},
    {"determinant", kOneMethod},
    {"entries", kOneMethod},
    {"bisect", kOneMethod},
    {"weight", kOneMethod},
    {"uncertainty", kOneMethod},
    {"precision", kOneMethod},
    {"symbolic-budget", kOneMethod},
    {"without", kOneMethod},
};

constexpr OptionRefusal kOptionsOfClosures[] = {
    {"kernel", kOneKernel},
    {"filter", "a filter tests a matrix, not equations"},
    {"method", kOneMethodOfClosures},
    {"determinant", kOneMethodOfClosures},
    {"entries", kOneMethodOfClosures},
    {"bisect", kOneMethodOfClosures},
    {"weight", kOneMethodOfClosures},
    {"uncertainty", kOneMethodOfClosures},
    {"precision", kOneMethodOfClosures},
    {"symbolic-budget", kOneMethodOfClosures},
    {"without", kOneMethodOfClosures},
};

constexpr OptionRefusal kOptionsOfSolutions[] = {
    {"alpha", "solutions have no threshold; leave it out"},
    {"filter", "a filter tests a matrix, not equations"},
    {"method", kOneMethodOfSolutions},
    {"determinant", kOneMethodOfSolutions},
    {"entries", kOneMethodOfSolutions},
    {"bisect", kOneMethodOfSolutions},
    {"weight", kOneMethodOfSolutions},
    {"uncertainty", kOneMethodOfSolutions},
    {"precision", kOneMethodOfSolutions},
    {"symbolic-budget", kOneMethodOfSolutions},
    {"without", kOneMethodOfSolutions},
};

/// The same question along way-points, and of a model with a closure.
constexpr std::size_t kAbouts = 4, kVarieties = kKinds / kAbouts;
Kind along_way(Kind kind) { return Kind(std::size_t(kind) + kVarieties); }
Kind of_closure(Kind kind) { return Kind(std::size_t(kind) + 2 * kVarieties); }
Kind of_closure_along_way(Kind kind) { return Kind(std::size_t(kind) + 3 * kVarieties); }

/// Returns the options that differ from their defaults, as the command calls them.
std::vector<std::string_view> changed_options(const ModelOptions& model,
                                              const SearchOptions& search) {
  const SearchOptions usual;
  std::vector<std::string_view> changed;
  const auto add = [&changed](std::string_view option, bool differs) {
    if (differs) changed.push_back(option);
  };
  add("alpha", !model.alpha.empty());
  add("kernel", search.kernel != usual.kernel);
  add("filter", search.filters != usual.filters);
  add("method", search.method != usual.method);
  add("determinant", search.determinant != usual.determinant);
  add("entries", search.entries != usual.entries);
  add("bisect", search.bisection != usual.bisection);
  add("weight", search.weights != usual.weights);
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
  if (!services.page.empty()) result.push_back({kPage, "page"});
  if (search.workers != nullptr) result.push_back({kRanks, ""});
  return result;
}

bool has_refused_service(Kind kind, const SearchOptions& search, const Services& services) {
  return std::ranges::any_of(requested(search, services), [kind](const RequestedService& request) {
    return refusal(kind, request.service).has_value();
  });
}

/// Only a search of one motion's own kernel, in one process, can take another text for it.
void refuse_text(Kind kind, const SearchOptions& search, const Services& services) {
  if (search.kernel.empty()) return;
  if (kind != kCheck || search.workers != nullptr)
    throw UsageError(fmt::format("{}kernel: {}", services.dashes, kOneKernel));
  if (!services.certificate.empty())
    throw UsageError(fmt::format("{}certificate: {}", services.dashes, kNoProofOfTexts));
  if (!services.page.empty())
    throw UsageError(fmt::format("{}page: {}", services.dashes, kNoPageOfTexts));
}

void refuse_services_of(Kind kind, const SearchOptions& search, const Services& services) {
  refuse_text(kind, search, services);
  for (const RequestedService& request : requested(search, services))
    if (const auto why = refusal(kind, request.service))
      throw UsageError(*request.option == '\0'
                           ? std::string(*why)
                           : fmt::format("{}{}: {}", services.dashes, request.option, *why));
}

constexpr std::string_view kIntroduction =
    "# What works with what\n\n"
    "Each row is a kind of question, each column what it may ask for beside its answer. A question "
    "that\nlacks it has a number, whose reason is below the table; – has no meaning. C++ and "
    "Python "
    "ask the same\nquestions as the command. Every search takes limits, threads and an interrupt, "
    "and "
    "shows its progress on\na terminal. Of bounds, Coq proves those of forces, singular values and "
    "condition numbers in\nthe 2-norm; over the branch of a [closure] also those of errors, finite "
    "ones too, speeds,\ndeflections, determinants and condition numbers in the maximum norm; of "
    "loads, that forces within\nlimits hold them, or that at some pose none do; of pavings of "
    "loads "
    "and of branches, where\nthey hold it and where the branch is certain.\n"
    "Along way-points `solve` answers at each of them, and says nothing of the way between "
    "them.\n\n";

/// Returns the number of a reason, from 1.
std::size_t number_of(std::string_view reason, std::vector<std::string_view>& reasons) {
  const auto known = std::ranges::find(reasons, reason);
  const auto number = std::size_t(known - reasons.begin()) + 1;
  if (known == reasons.end()) reasons.push_back(reason);
  return number;
}

std::string row_of(Kind kind, std::vector<std::string_view>& reasons) {
  std::string row = fmt::format("| {} |", name(kind));
  for (std::size_t s = 0; s < kServices; ++s) {
    const auto service = Service(s);
    const auto why = refusal(kind, service);
    const bool has_meaning = std::ranges::none_of(refusals(), [&](const Refusal& r) {
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
  static constexpr std::array<std::string_view, kVarieties> kNames = {
      "check",        "locate",
      "margin",       "margin --quantity",
      "bound",        "bound condition --norm 2",
      "check --load", "locate --load",
      "datasheet",    "bound error --finite",
      "solve"};
  const auto number = std::size_t(kind);
  static constexpr std::array<const char*, kAbouts> kAbout = {
      "", ", along way-points", ", of a closure", ", of a closure along way-points"};
  return std::string(kNames[number % kVarieties]) + kAbout[number / kVarieties];
}

std::string_view name(Service service) {
  static constexpr std::array<std::string_view, kServices> kNames = {
      "proof", "shards", "theorem", "checkpoint", "ranks", "picture", "page"};
  return kNames[std::size_t(service)];
}

/// The table has a row for each answer that is no paving: without boxes it has no picture.
std::span<const Refusal> refusals() {
  static const std::vector<Refusal> kAll = [] {
    std::vector<Refusal> all(std::begin(kRefusals), std::end(kRefusals));
    for (std::size_t k = 0; k < kKinds; ++k) {
      const auto variety = Kind(k % kVarieties);
      const bool has_own_row = std::ranges::any_of(
          kRefusals, [k](const Refusal& r) { return r.kind == Kind(k) && r.service == kPicture; });
      if (variety != kPaving && variety != kLoadPaving && !has_own_row)
        all.push_back({Kind(k), kPicture, kNoBoxes, false});
    }
    return all;
  }();
  return kAll;
}
std::span<const OptionRefusal> option_refusals_of_loads() { return kOptionsOfLoads; }
std::span<const OptionRefusal> option_refusals_of_closures() { return kOptionsOfClosures; }
std::span<const OptionRefusal> option_refusals_of_solutions() { return kOptionsOfSolutions; }

std::optional<std::string_view> refusal(Kind kind, Service service) {
  for (const Refusal& row : refusals())
    if (row.kind == kind && row.service == service) return row.why;
  return std::nullopt;
}

void refuse_services(Kind kind, const ModelOptions& model, const SearchOptions& search,
                     const Services& services) {
  const FormingWatch watch = watch_of(services, search);
  if (const auto closed = if_readable([&] { return read_closure(model, watch); })) {
    const bool is_along_way = closed->motion.trajectory != nullptr;
    refuse_services_of(is_along_way ? of_closure_along_way(kind) : of_closure(kind), search,
                       services);
    refuse_changed_options(kOptionsOfClosures, model, search, services.dashes);
    return;
  }
  refuse_services_of(kind, search, services);
  const Kind along = along_way(kind);
  if (!has_refused_service(along, search, services)) return;
  if (if_readable([&] { return read_trajectory(model, watch); }))
    refuse_services_of(along, search, services);
}

void refuse_changed_options(std::span<const OptionRefusal> refused, const ModelOptions& model,
                            const SearchOptions& search, const std::string& dashes) {
  for (const std::string_view option : changed_options(model, search))
    for (const OptionRefusal& row : refused)
      if (row.option == option)
        throw UsageError(fmt::format("{}{}: {}", dashes, row.option, row.why));
}

std::string what_works() {
  std::string page = fmt::format("{}| question |", kIntroduction);
  for (std::size_t s = 0; s < kServices; ++s) page += fmt::format(" {} |", name(Service(s)));
  page += "\n|---|" + [] {
    std::string line;
    for (std::size_t s = 0; s < kServices; ++s) line += "---|";
    return line;
  }() + '\n';
  std::vector<std::string_view> reasons;
  for (std::size_t k = 0; k < kKinds; ++k) page += row_of(Kind(k), reasons);
  page += '\n';
  for (std::size_t i = 0; i < reasons.size(); ++i)
    page += fmt::format("{}. {}.\n", i + 1, reasons[i]);
  return page;
}

}  // namespace regulus::detail
