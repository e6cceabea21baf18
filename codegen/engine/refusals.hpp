// SPDX-License-Identifier: GPL-3.0-or-later
// The table of what a question does not take: the command, C++ and Python read it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "codegen/engine/options.hpp"
#include "codegen/model/request.hpp"

namespace regulus::inline engine {

/// What is asked, as far as it takes fewer options than others.
enum class Asked {
  kLoad,       ///< do forces within the limits hold a load?
  kPathCheck,  ///< a motion along way-points: has it a singular pose?
  kPathPaving  ///< where has it one?
};

/// An option that has no meaning for a question.
struct Refusal {
  Asked asked;
  std::string_view option;  ///< of the command, without its dashes
  std::string_view why;     ///< and what to do instead, in words of all interfaces
};

[[nodiscard]] std::span<const Refusal> refusals();

/// Returns "OPTION: WHY"; nullopt if the question takes the option.
[[nodiscard]] std::optional<std::string> refusal(Asked asked, std::string_view option);

/// Throws    UsageError if the argument of a program is given and the question does not take it.
void refuse(Asked asked, std::string_view option, bool is_given);
/// The same for an option of the command.
void refuse_option(Asked asked, std::string_view option, bool is_given);

/// Refuses all options that a program has changed and the question does not take. A certificate or a
/// checkpoint is not among these options.
///
/// Throws    UsageError.
void refuse_changed(Asked asked, const ModelOptions& model, const SearchOptions& search);

}  // namespace regulus::engine
