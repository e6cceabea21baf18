// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "codegen/answer/kinds.hpp"
#include "codegen/answer/services.hpp"

namespace regulus::detail {
struct Margin;
struct MarginQuestion;
struct MarginStep;

/// Returns the proofs of a component's ends; none if none were wanted.
[[nodiscard]] std::vector<ProofOfEnd> proofs_of_ends(const EndProofs& ends,
                                                     const std::string& component);

/// Returns what a bracket says: it is refuted if the least value has a witness, so that none is safe.
[[nodiscard]] Word word_of(const MarginQuestion& question, const Margin& margin);

/// Sets the ends of an answer.
void set_ends(MarginAnswer& answer, const Margin& margin);

/// Tells each step in a line. Both must outlive the function.
[[nodiscard]] std::function<void(const MarginStep&)> steps_of(const MarginQuestion& question,
                                                              const Services& services);

/// Puts the files of a run in their places. What is missing is noted in `ends` and in the answer.
void settle_files(HeldFiles& held, const std::vector<EndProofs*>& ends, Answer& answer);

}  // namespace regulus::detail
