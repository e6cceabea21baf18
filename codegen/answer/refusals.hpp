// SPDX-License-Identifier: GPL-3.0-or-later
// The table of what a question does not take: the command, C++, Python, the ranks and the manual's
// page "What works with what" read it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "codegen/answer/asked.hpp"
#include "codegen/answer/services.hpp"

namespace regulus {

/// The kinds of questions, as far as they differ in what they take.
enum class Kind {
  kCheck,
  kPaving,
  kMargin,
  kLimitMargin,  ///< of a quantity that must keep a limit
  kBound,
  kCondition2,  ///< the condition number in the 2-norm
  kLoad,
  kLoadPaving,
  kDatasheet,
  // The same about a motion along way-points.
  kWayCheck,
  kWayPaving,
  kWayMargin,
  kWayLimitMargin,
  kWayBound,
  kWayCondition2,
  kWayLoad,
  kWayLoadPaving,
  kWayDatasheet
};
inline constexpr std::size_t kKinds = std::size_t(Kind::kWayDatasheet) + 1;
/// Returns "check --load, along way-points", for example.
[[nodiscard]] std::string name(Kind kind);

/// What a question may ask for beside its answer.
enum class Service { kAnswer, kProof, kShards, kTheorem, kCheckpoint, kRanks, kPicture, kPage };
inline constexpr std::size_t kServices = std::size_t(Service::kPage) + 1;
[[nodiscard]] std::string_view name(Service service);

/// A service that a question does not have.
struct Refusal {
  Kind kind;
  Service service;
  std::string_view why;     ///< and what to do instead, in words of all interfaces
  bool has_meaning = true;  ///< false: the service would have nothing to do
};
[[nodiscard]] std::span<const Refusal> refusals();
/// Returns the reason; nullopt if the question has the service.
[[nodiscard]] std::optional<std::string_view> refusal(Kind kind, Service service);

/// An option of a search that has no meaning for loads.
struct OptionRefusal {
  std::string_view option;  ///< of the command, without its dashes
  std::string_view why;
};
[[nodiscard]] std::span<const OptionRefusal> option_refusals_of_loads();

/// Throws    UsageError for the first service that is asked for and that the question does not have.
void refuse_services(Kind kind, const SearchOptions& search, const Services& services);
/// The same before an earlier file is touched: reads the model only if a service is refused along
/// way-points. `along`: the kind if the motion is along way-points.
void refuse_services_along_way(Kind along, const ModelOptions& model, const SearchOptions& search,
                               const Services& services);
/// Throws    UsageError for an option that a program has changed and that has no meaning for loads.
void refuse_changed_options(const ModelOptions& model, const SearchOptions& search);

/// Returns the page "What works with what" of the manual, in Markdown.
[[nodiscard]] std::string what_works();

}  // namespace regulus
