// SPDX-License-Identifier: Apache-2.0
// Follows a root of a family of polynomial systems from one member to another, in doubles. It
// proposes where roots are, and proves nothing.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "runtime/solutions/complex.hpp"

namespace regulus::detail {

/// A family F(z; s) of systems. The unknowns are in groups, and F is homogeneous in each of them: a
/// root is a point of a product of projective spaces. There are as many equations as unknowns, less
/// the number of groups.
class Homotopy {
 public:
  virtual ~Homotopy() = default;
  [[nodiscard]] virtual std::size_t unknowns() const noexcept = 0;
  /// How many unknowns each group has; they are neighbours.
  [[nodiscard]] virtual std::span<const std::size_t> groups() const noexcept = 0;
  /// Sets values F (by equation), derivatives F_z (row-major: by equation), and rates F_s.
  virtual void evaluate(std::span<const Complex> z, Complex s, std::span<Complex> values,
                        std::span<Complex> derivatives, std::span<Complex> rates) const = 0;
};

struct TrackerOptions {
  Complex gamma{0.6, 0.8};   ///< s = γt/(1 − t + γt), 0 ≤ t ≤ 1: an arc from 0 to 1
  double tolerance = 1e-5;   ///< of a prediction, relative
  double least_step = 1e-8;  ///< of t
  int most_steps = 2000;
};

/// Follows a root from s = 0 to s = 1.
///
/// Returns   the root, of norm 1 in each group; nullopt where the path could not be followed.
[[nodiscard]] std::optional<std::vector<Complex>> track(const Homotopy& homotopy,
                                                        std::span<const Complex> start,
                                                        const TrackerOptions& options);

}  // namespace regulus::detail
