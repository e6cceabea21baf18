// SPDX-License-Identifier: GPL-3.0-or-later
// What is known of each kind of quantity: one row for each. A new kind is a row here, its name in
// quantity.hpp and runtime/proof/format.hpp, its matrix in bordered.cpp, and the verifier's own.
#pragma once

#include <cstdint>
#include <span>

#include "codegen/question/quantity/quantity_kind.hpp"

namespace regulus::detail {

/// What a quantity has a component for.
enum class ComponentsOf : std::uint8_t {
  kWhole,     ///< one
  kRows,      ///< each leg
  kFreedoms,  ///< each column, that of a freedom of the platform
  kNorms,     ///< the same, and the norms of the two parts of the pose
  kPairs,     ///< each pair of a row and a column
};

/// What the model must give beside its matrix.
enum class NeededData : std::uint8_t {
  kNone,
  kLoad,
  kTwist,
  kMotorErrors,
  kMotorSpeeds,
  kLoadAndStiffness
};

struct QuantityTraits {
  QuantityKind kind;
  const char* word;         ///< of the command line, and of reports; empty: an expression
  const char* norm;         ///< with `word` it names the quantity; empty: it has none
  const char* description;  ///< in reports; the set follows, "force under payload"
  const char* certified;    ///< in certificates
  ComponentsOf components;
  NeededData data;
  bool has_signs = false;          ///< --signed and --min have a meaning
  bool may_be_least = false;       ///< --min has one
  bool is_always_least = false;    ///< the bound is of the least value
  bool is_never_negative = false;  ///< it has the side of its end, not that of an absolute value
  bool compares_units = false;     ///< velocities and angular velocities must have one unit
  bool needs_inverse = true;       ///< the matrix must be J⁻¹
  bool needs_square = true;        ///< and have an inverse
  bool is_lost_where_singular = false;  ///< there it has no value, and nearby no bound
};

/// A quantity of a mechanism with a closure: its rows are the motors, which are the pose parameters,
/// its freedoms the unknowns, and J is their derivative by the motors.
struct ClosureTraits {
  const char* description;  ///< as QuantityTraits::description; empty: it has no bound
  const char* why;          ///< it has none; and what to do
  ComponentsOf components = ComponentsOf::kWhole;
  NeededData data = NeededData::kNone;
  bool has_signs = false;
};
[[nodiscard]] const ClosureTraits& closure_traits_of(QuantityKind kind) noexcept;

/// All kinds, in the order of QuantityKind.
[[nodiscard]] std::span<const QuantityTraits> quantity_traits() noexcept;
[[nodiscard]] const QuantityTraits& traits_of(QuantityKind kind) noexcept;

}  // namespace regulus::detail
