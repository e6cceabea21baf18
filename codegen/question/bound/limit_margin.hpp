// SPDX-License-Identifier: GPL-3.0-or-later
// The largest size of a motion, or tolerance, at which a quantity keeps a limit.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/answer/facts.hpp"
#include "codegen/answer/report/output_options.hpp"
#include "codegen/question/bound/attained_place.hpp"
#include "codegen/question/bound/bound_checkpoint.hpp"
#include "codegen/question/margin/margin_run.hpp"
#include "codegen/question/quantity/bordered.hpp"
#include "codegen/support/held_files.hpp"
#include "codegen/support/time_budget.hpp"

namespace regulus::detail {

struct ComponentMargin;
struct LimitMarginSettings;
/// Brackets the value at which a component exceeds the limit. Its question has no `about`.
using ComponentMarginOf = std::function<ComponentMargin(
    const Request&, const Component&, const MarginQuestion&, const LimitMarginSettings&,
    const BracketSettings&, const TimeBudget&)>;

struct LimitMarginSettings {
  double gap = 0.01;
  GiNaC::ex limit;
  SearchOptions search;  ///< its time limit is that of all components
  OutputOptions output;
  std::string certificate;  ///< files, without their endings; empty: none
  ProofPlacing placing{};
  BracketCheckpoint* checkpoint = nullptr;
  ComponentMarginOf over_branch{};  ///< of a model with a closure
  const std::atomic<bool>* interrupt = nullptr;
};

/// The bracket of one component.
struct ComponentMargin {
  Component component;
  Margin margin;
  std::optional<AttainedPlace> exceeded;  ///< where the limit is exceeded at the refuted value
  StageSeconds seconds;
  EndProofs proofs;
};

/// The brackets of the components of a quantity.
struct LimitMargin {
  Quantity quantity;
  std::vector<ComponentMargin> components;  ///< those that were asked; the others cannot be worse
  Margin whole;  ///< certified at the least value, refuted at the least value
};

/// Brackets the largest value of `question` at which every component of `quantity` keeps the limit.
///
/// Requires  `quantity` is of request.model; settings.limit > 0 if a component is absolute.
/// Throws    UsageError if something grows that a limit does not allow; the exceptions of
///           PreparedMargin.
[[nodiscard]] LimitMargin limit_margin(const Request& request, const MarginQuestion& question,
                                       Quantity quantity, const LimitMarginSettings& settings,
                                       const StepListener& listener);

/// Returns "WITHIN UP TO 0.643 rad, EXCEEDED AT 0.645 rad", for example.
[[nodiscard]] std::string describe_limit_bracket(const MarginQuestion& question,
                                                 const LimitMargin& margin);

/// Tells the bracket, the place where the limit is exceeded, and the components.
void tell_limit_margin(const Request& request, const MarginQuestion& question,
                       const LimitMargin& margin, const LimitMarginSettings& settings,
                       Facts& facts);

}  // namespace regulus::detail
