// SPDX-License-Identifier: GPL-3.0-or-later
// Every bound that a model has data for, in one table.
#pragma once

#include <string>
#include <vector>

#include "codegen/answer/facts.hpp"
#include "codegen/question/bound/bound_run.hpp"

namespace regulus::detail {

/// Tells whether a limit of the motors is kept.
enum class LimitState { kNone, kKept, kExceeded, kUnknown };

struct Datasheet {
  std::vector<Bound> bounds;
  std::vector<std::string> left_out;  ///< quantities with the reason why they have no rows
  bool is_interrupted = false;
};

/// Bounds the forces under each load, the speeds for each twist, errors, deflections, the lengths of
/// legs, singular values and the condition number, as far as the model has the data. The proofs of a
/// quantity are FILE.force_payload.leg_3.safe and FILE.force_payload.leg_3.singular.
///
/// Throws    as bound_quantity().
[[nodiscard]] Datasheet make_datasheet(const Request& request, const BoundSettings& settings,
                                       const BoundListener& listener);

/// Returns the quantity with which BoundSettings::part is `part`. Throws cluster::MalformedMessage if
/// there is none.
[[nodiscard]] Quantity quantity_of_part(const Request& request, const std::string& part);

/// Returns the files of proofs that make_datasheet() writes.
[[nodiscard]] std::vector<OutputFile> datasheet_files(const Request& request,
                                                      const std::string& certificate);
/// Returns everything that the ends of all brackets depend on.
[[nodiscard]] nlohmann::ordered_json checkpointed_datasheet(const Request& request,
                                                            const SearchOptions& search);

/// Returns the state of the model's limit for a component of `quantity`.
[[nodiscard]] LimitState limit_state(const Model& model, const ComponentBound& component);
/// Returns that limit with six digits; empty if there is none.
[[nodiscard]] std::string limit_text(const Model& model, const ComponentBound& component);

[[nodiscard]] std::string text_datasheet(const Request& request, const Datasheet& sheet);
/// `set`: the lines of a report about the motion and the uncertain quantities.
[[nodiscard]] std::string markdown_datasheet(const Request& request, const Datasheet& sheet,
                                             const std::string& set);
/// Tells the sheet to programs.
void tell_datasheet(const Request& request, const Datasheet& sheet, const BoundSettings& settings,
                    Facts& facts);

}  // namespace regulus::detail
