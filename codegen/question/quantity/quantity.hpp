// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities that can be bounded: forces, errors, speeds, singular values, or an expression.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "codegen/model/model.hpp"
#include "codegen/question/quantity/quantity_kind.hpp"
#include "codegen/question/quantity/quantity_options.hpp"

namespace regulus {

/// The part of the pose that a component is about, if it is not a single column.
enum class PosePart { kColumn, kLinear, kAngular };

/// One scalar quantity q of the pose, the uncertain values and the load: the force in leg 3, for
/// example. Its bound is that of sign·q.
struct Component {
  QuantityKind kind = QuantityKind::kForce;
  std::string label;  ///< "leg 3"; empty if the quantity has one component only
  std::string unit;
  std::size_t row = 0;
  std::size_t column = 0;
  PosePart part = PosePart::kColumn;
  int sign = 1;
  bool is_absolute = false;        ///< the bound is that of |q|, and sign is 1
  const VectorSet* set = nullptr;  ///< the load or the twist; of the model
  std::optional<GiNaC::ex> expression{};
  std::vector<GiNaC::ex> must_be_defined{};  ///< of the expression
};

/// A quantity with its components. The bound of the quantity is the largest of theirs (of the least
/// value: the smallest).
struct Quantity {
  QuantityKind kind = QuantityKind::kForce;
  std::string name;  ///< "force under payload"
  std::string unit;
  bool is_least = false;  ///< the least value is asked
  std::vector<Component> components;
};

/// A determinant of derivatives by degrees is smaller than one by radians. Throws UsageError, which names
/// `what`, if an unknown of the closure is in degrees.
void require_determinant_of_radians(const Model& model, const std::string& what);

/// Returns the words for quantities, without expressions.
[[nodiscard]] std::vector<std::string> quantity_words();

/// Returns false for a text that is none of them: it is an expression.
[[nodiscard]] bool is_quantity(const std::string& word);

/// Returns the components that the options ask for. `model` must outlive the result.
///
/// Throws    UsageError if the model has no such load, twist, row or column, if there is no such norm,
///           if a stiffness or an error is missing, or if its matrix is not square where an inverse
///           is needed.
///
/// Requires  for an expression: Model::asked is set.
[[nodiscard]] Quantity quantity_of(const Model& model, const QuantityOptions& options);

/// True for the words of a finite error.
[[nodiscard]] bool is_finite_error(const QuantityOptions& options);

/// Returns the load of that name, or the only one if `wanted` is empty. Throws UsageError.
[[nodiscard]] const VectorSet& choose_load(const Model& model, const std::string& wanted);

}  // namespace regulus
