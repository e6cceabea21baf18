// SPDX-License-Identifier: Apache-2.0
// A small box in which a matrix certainly loses rank somewhere. PROOF.md, "SINGULARITY", derives it.
#pragma once

#include <vector>

#include "runtime/verifier/evaluation.hpp"

namespace regulus::verifier {

/// A null vector, in intervals, and the variables that are solved for with it.
struct NullVector {
  std::vector<std::size_t> chosen;  ///< rising
  /// The first that is the number 1 stays 1; those that are the number 0 stay 0.
  std::vector<Interval> components;
};

[[nodiscard]] inline bool is_one(Interval x) noexcept { return x.lo == 1.0 && x.hi == 1.0; }

/// Adds derivatives to the question's graph.
///
/// Requires  a component is the number 1; the matrix is defined all over the box.
/// Ensures   true only if, whatever values the other coordinates have in the box, some values of the
///           chosen ones in it and some v of the components have A·v = 0.
[[nodiscard]] bool has_null_vector(Question& question, const Box& box, const NullVector& claimed);

}  // namespace regulus::verifier
