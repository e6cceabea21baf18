// SPDX-License-Identifier: GPL-3.0-or-later
// What an answer about a closure tells.
#pragma once

#include <string>

#include "codegen/answer/facts.hpp"
#include "codegen/question/closure/fold_search.hpp"
#include "runtime/problem/result.hpp"

namespace regulus {

/// What was found about a closure: the search, and a singular configuration if it led to one.
struct ClosureFinding {
  ClosureResult searched;
  std::optional<Fold> fold{};

  [[nodiscard]] bool is_refuted() const { return fold && fold->is_on_branch; }
};

/// Asks whether the branch is regular all over the motion. `progress` may be null.
[[nodiscard]] ClosureFinding check_closure(PreparedClosure& prepared, const SearchOptions& search,
                                           const FormingWatch& watch, Observer* progress);

/// Returns the finding in the terms of a check.
[[nodiscard]] Result check_result(const PreparedClosure& prepared, const ClosureFinding& found);

/// Returns the claim, or why there is none, in words.
[[nodiscard]] std::string describe_claim(const PreparedClosure& prepared,
                                         const ClosureFinding& found);

void tell_closure(const PreparedClosure& prepared, const SearchOptions& search,
                  const ClosureFinding& found, Facts& facts);

}  // namespace regulus
