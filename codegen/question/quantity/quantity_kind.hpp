// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace regulus {

enum class QuantityKind : std::uint8_t {
  kForce,           ///< of a row, under a load
  kError,           ///< of the pose, by errors of the motors
  kSpeed,           ///< of a motor, for a twist
  kSigmaMin,        ///< the least singular value of J⁻¹
  kSigmaMax,        ///< the largest
  kCondition,       ///< ‖J⁻¹‖·‖J‖ in the maximum norm
  kCondition2,      ///< σ_max/σ_min of J⁻¹, the condition number in the 2-norm
  kDeflection,      ///< of the pose under a load, by the stiffness of the motors
  kDeterminant,     ///< the least |det J⁻¹|
  kDeterminantMax,  ///< the largest, or det J⁻¹ with its sign
  kExpression,
  kFiniteError,  ///< of an unknown, by all errors of the motion and the geometry, to any order
};

}  // namespace regulus
