// SPDX-License-Identifier: GPL-3.0-or-later
// The certificate of a list of all solutions: runtime/proof/FORMAT.md, "All solutions".
#pragma once

#include <string>

#include "codegen/model/request.hpp"
#include "codegen/question/solve/solutions.hpp"

namespace regulus::detail {

/// The lines of a certificate about the solutions at one place, or why there are none.
struct ListProof {
  std::string head, proof;  ///< up to the line `proof`, and those after it
  std::string obstacle{};   ///< empty: there is a proof
  std::string doubt{};      ///< why the verifier may not finish; empty: no reason is known
};

/// Returns the proof of what is known of the solutions.
///
/// Requires  solutions are those of the request.
[[nodiscard]] ListProof prove_list(const Request& request, const Solutions& solutions);

}  // namespace regulus::detail
