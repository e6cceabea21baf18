// SPDX-License-Identifier: GPL-3.0-or-later
// The question of `regulus bound`: a quantity of a model over a motion, and perhaps a limit.
#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string>

#include "codegen/model/request.hpp"
#include "codegen/question/quantity/quantity.hpp"

namespace regulus::detail {

struct BoundQuestion {
  Request request;
  Quantity quantity;  ///< of request.model; it may be moved with this object
  std::optional<GiNaC::ex> limit;
};

/// Reads the model; a quantity that is no word is an expression of it. Throws UsageError.
[[nodiscard]] Request read_asked(ModelOptions model, const QuantityOptions& quantity,
                                 const FormingWatch& watch = {});

/// Returns true if the motion or the geometry has errors that finite errors are about.
[[nodiscard]] bool has_finite_errors(const Request& request);
/// Throws    UsageError if the quantity is a finite error, and some tolerance is a ball.
void require_errors_in_ranges(const Request& request, const Quantity& quantity);
/// The same; and if there are no errors.
void require_finite_errors(const Request& request, const Quantity& quantity);

/// Throws    UsageError for a text that is not a constant, or is not positive where it must be.
[[nodiscard]] GiNaC::ex read_limit(const std::string& text, const Quantity& quantity);

/// Reads the model, the quantity and the limit. `limit`: empty if there is none.
///
/// Throws    InputError and FileError for the model, UsageError for the options, and for a
///           threshold, which would be ignored.
[[nodiscard]] BoundQuestion read_bound_question(const ModelOptions& model,
                                                const QuantityOptions& words,
                                                const std::string& limit,
                                                const FormingWatch& watch = {});

}  // namespace regulus::detail
