// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/quantity/quantity_traits.hpp"

#include <array>

#include "runtime/proof/format.hpp"

namespace regulus::detail {
namespace {

using enum QuantityKind;
using enum ComponentsOf;
using enum NeededData;

constexpr std::array kTraits{
    QuantityTraits{.kind = kForce,
                   .word = "force",
                   .norm = "",
                   .description = "force",
                   .certified = format::kForce,
                   .components = kRows,
                   .data = kLoad,
                   .has_signs = true,
                   .is_lost_where_singular = true},
    QuantityTraits{.kind = kError,
                   .word = "error",
                   .norm = "",
                   .description = "error of the pose",
                   .certified = format::kError,
                   .components = kNorms,
                   .data = kMotorErrors,
                   .is_lost_where_singular = true},
    QuantityTraits{.kind = kSpeed,
                   .word = "speed",
                   .norm = "",
                   .description = "speed of the motors",
                   .certified = format::kSpeed,
                   .components = kRows,
                   .data = kTwist,
                   .has_signs = true,
                   .needs_inverse = false,
                   .needs_square = false},
    QuantityTraits{.kind = kSigmaMin,
                   .word = "sigma-min",
                   .norm = "",
                   .description = "least singular value of J⁻¹",
                   .certified = format::kSigmaMin,
                   .components = kWhole,
                   .data = kNone,
                   .may_be_least = true,
                   .is_always_least = true,
                   .is_never_negative = true,
                   .compares_units = true,
                   .needs_square = false},
    QuantityTraits{.kind = kSigmaMax,
                   .word = "sigma-max",
                   .norm = "",
                   .description = "largest singular value of J⁻¹",
                   .certified = format::kSigmaMax,
                   .components = kWhole,
                   .data = kNone,
                   .is_never_negative = true,
                   .compares_units = true,
                   .needs_square = false},
    QuantityTraits{.kind = kCondition,
                   .word = "condition",
                   .norm = "max",
                   .description = "condition number of J⁻¹ in the maximum norm",
                   .certified = format::kCondition,
                   .components = kPairs,
                   .data = kNone,
                   .is_never_negative = true,
                   .compares_units = true,
                   .is_lost_where_singular = true},
    QuantityTraits{.kind = kCondition2,
                   .word = "condition",
                   .norm = "2",
                   .description = "condition number of J⁻¹ in the 2-norm",
                   .certified = format::kCondition2,
                   .components = kWhole,
                   .data = kNone,
                   .is_never_negative = true,
                   .compares_units = true,
                   .needs_square = false,
                   .is_lost_where_singular = true},
    QuantityTraits{.kind = kDeflection,
                   .word = "deflection",
                   .norm = "",
                   .description = "deflection",
                   .certified = format::kDeflection,
                   .components = kFreedoms,
                   .data = kLoadAndStiffness,
                   .has_signs = true,
                   .is_lost_where_singular = true},
    QuantityTraits{.kind = kDeterminant,
                   .word = "determinant",
                   .norm = "",
                   .description = "least |det J⁻¹|",
                   .certified = format::kDeterminant,
                   .components = kWhole,
                   .data = kNone,
                   .is_always_least = true,
                   .is_never_negative = true},
    QuantityTraits{.kind = kDeterminantMax,
                   .word = "determinant-max",
                   .norm = "",
                   .description = "det J⁻¹",
                   .certified = format::kDeterminantMax,
                   .components = kWhole,
                   .data = kNone,
                   .has_signs = true},
    QuantityTraits{.kind = kExpression,
                   .word = "",
                   .norm = "",
                   .description = "",
                   .certified = format::kExpression,
                   .components = kWhole,
                   .data = kNone,
                   .has_signs = true,
                   .needs_inverse = false,
                   .needs_square = false},
    QuantityTraits{.kind = kFiniteError,
                   .word = "finite-error",
                   .norm = "",
                   .description = "finite error",
                   .certified = format::kFiniteError,
                   .components = kFreedoms,
                   .data = kNone},
};

constexpr bool are_in_order() {
  for (std::size_t k = 0; k < kTraits.size(); ++k)
    if (std::size_t(kTraits[k].kind) != k) return false;
  return kTraits.size() == std::size_t(kFiniteError) + 1;
}
static_assert(are_in_order());

/// In the order of QuantityKind.
constexpr std::array<ClosureTraits, kTraits.size()> kOfClosures{{
    {"force of the motors", "", kRows, kLoad, true},
    {"first-order error", "", kFreedoms, kMotorErrors},
    {"speed of the unknowns for the speeds of the motors", "", kFreedoms, kMotorSpeeds},
    {"least singular value of the equations' derivatives", ""},
    {"largest singular value of the equations' derivatives", ""},
    {"condition number of the equations' derivatives in the maximum norm", ""},
    {"condition number of the equations' derivatives in the 2-norm", ""},
    {"deflection of the unknowns", "", kFreedoms, kLoadAndStiffness, true},
    {"least |det| of the equations' derivatives", ""},
    {"det of the equations' derivatives", "", kWhole, kNone, true},
    {"",
     "an expression has the pose parameters alone, and not the unknowns, so that the branch "
     "changes nothing; ask for one of the quantities of a [closure]"},
    {"finite error", "", kFreedoms},
}};

}  // namespace

const ClosureTraits& closure_traits_of(QuantityKind kind) noexcept {
  return kOfClosures[std::size_t(kind)];
}

std::span<const QuantityTraits> quantity_traits() noexcept { return kTraits; }

const QuantityTraits& traits_of(QuantityKind kind) noexcept { return kTraits[std::size_t(kind)]; }

}  // namespace regulus::detail
