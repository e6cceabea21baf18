// SPDX-License-Identifier: GPL-3.0-or-later
// What an answer about all solutions tells.
#pragma once

#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/engine/options.hpp"
#include "codegen/question/solve/solutions.hpp"

namespace regulus {

/// Returns "COMPLETE: 6 poses", "NONE" or "INCOMPLETE: at least 2 poses".
[[nodiscard]] std::string describe_result(const Solutions& solutions, const SolvedNoun& noun);

/// Returns the claim as a sentence.
[[nodiscard]] std::string describe_claim(const Solutions& solutions, const SolvedNoun& noun);

/// `asked`: the request as it was asked.
void tell_solutions(const Request& asked, const SearchOptions& search, const Solutions& solutions,
                    const SolvedNoun& noun, Facts& facts);

}  // namespace regulus
