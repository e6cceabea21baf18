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

namespace regulus::detail {

struct Request;

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
  kFiniteErrors,  ///< bounds of errors that are not to first order
  kSolve,         ///< all solutions
  // The same about a motion along way-points.
  kWayCheck,
  kWayPaving,
  kWayMargin,
  kWayLimitMargin,
  kWayBound,
  kWayCondition2,
  kWayLoad,
  kWayLoadPaving,
  kWayDatasheet,
  kWayFiniteErrors,
  kWaySolve,
  // The same about a model that gives equations in [closure].
  kClosureCheck,
  kClosurePaving,
  kClosureMargin,
  kClosureLimitMargin,
  kClosureBound,
  kClosureCondition2,
  kClosureLoad,
  kClosureLoadPaving,
  kClosureDatasheet,
  kClosureFiniteErrors,
  kClosureSolve,
  // The same about such a model and a motion along way-points.
  kClosureWayCheck,
  kClosureWayPaving,
  kClosureWayMargin,
  kClosureWayLimitMargin,
  kClosureWayBound,
  kClosureWayCondition2,
  kClosureWayLoad,
  kClosureWayLoadPaving,
  kClosureWayDatasheet,
  kClosureWayFiniteErrors,
  kClosureWaySolve
};
inline constexpr std::size_t kKinds = std::size_t(Kind::kClosureWaySolve) + 1;
/// Returns "check --load, along way-points", for example.
[[nodiscard]] std::string name(Kind kind);

/// What a question may ask for beside its answer.
enum class Service { kProof, kShards, kTheorem, kCheckpoint, kRanks, kPicture, kPage };
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

/// An option of a search that has no meaning for a kind of question.
struct OptionRefusal {
  std::string_view option;  ///< of the command, without its dashes
  std::string_view why;
};
[[nodiscard]] std::span<const OptionRefusal> option_refusals_of_loads();
[[nodiscard]] std::span<const OptionRefusal> option_refusals_of_solutions();
[[nodiscard]] std::span<const OptionRefusal> option_refusals_of_closures();

/// Throws    UsageError for the first service that is asked for and that the question does not have,
///           also if the motion is along way-points or the model has a closure. It comes before an
///           earlier file is touched, and reads the model only if it may be one of those.
/// `kind`: about a variety, without a closure.
void refuse_services(Kind kind, const ModelOptions& model, const SearchOptions& search,
                     const Services& services);
/// Throws    UsageError for an option of `refused` that is changed; its name begins with `dashes`.
void refuse_changed_options(std::span<const OptionRefusal> refused, const ModelOptions& model,
                            const SearchOptions& search, const std::string& dashes);

/// Returns the page "What works with what" of the manual, in Markdown.
[[nodiscard]] std::string what_works();

}  // namespace regulus::detail
