// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/certificate/verifier/question.hpp"

namespace regulus::verifier {

/// Writes the expressions of a question anew: a variable of one value only is replaced by that
/// value, and a constant that decides whether an operation is defined by its exact value where that
/// is rational: √(x − π/4) for x = π/4 becomes √0. The variables stay, though nothing depends on
/// those of one value any more; so does what a comparison with a model file reads.
///
/// Requires  the ends of all ranges have values (enclose_variety).
/// Ensures   every expression has the same value as before, and is defined at the same points of
///           the set.
void put_in_single_values(Question& question);

}  // namespace regulus::verifier
