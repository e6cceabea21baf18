// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/model/model.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// The exact ranges of variables as doubles: outward for proofs, inward for witnesses (see
/// Problem).
struct Variety {
  std::vector<Interval> outer;
  std::vector<std::optional<Interval>> inner;
  Interval alpha{0.0};
};

/// Throws InputError if a range or the threshold has no certain value.
[[nodiscard]] Variety enclose_variety(const Model& model, const Motion& motion,
                                      std::span<const Variable> variables);

/// Encloses a constant expression, outward. Throws InputError that names `what` if it has no
/// certain value.
[[nodiscard]] Interval enclose_constant(const GiNaC::ex& value, const std::string& what);

}  // namespace regulus::detail
