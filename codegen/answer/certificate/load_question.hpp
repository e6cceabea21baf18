// SPDX-License-Identifier: GPL-3.0-or-later
// The question of a certificate about forces that hold a load.
#pragma once

#include <set>
#include <string>

#include "codegen/model/request.hpp"
#include "runtime/proof/format.hpp"

namespace regulus::detail {

/// Returns the lines `wrench` and `wrench-ball` of a load or a set of twists.
[[nodiscard]] std::string vector_lines(const VectorSet& set);

/// Returns the lines about the load and the limits (FORMAT.md, "Forces within limits").
///
/// Requires  the model has limits of force.
[[nodiscard]] std::string load_lines(const Model& model, const VectorSet& load);

/// A question about forces, without its verdict.
struct CertifiedLoad {
  std::string text;  ///< the lines from `model` on
  format::ClaimedSet set;

  /// Returns a certificate up to its proof, with the verdict FEASIBLE, INFEASIBLE or PAVING.
  [[nodiscard]] std::string head(const std::string& verdict) const;
};

/// `uncertain`: as for certified_question.
///
/// Requires  the motion has no threshold, and the matrix its row scales.
/// Throws    as certified_question.
[[nodiscard]] CertifiedLoad certified_load(const Request& request,
                                           const std::set<std::string>& uncertain,
                                           const VectorSet& load);

/// Returns why the verifier could not read such a certificate; empty if it can.
[[nodiscard]] std::string certificate_obstacle(const CertifiedLoad& question);

}  // namespace regulus::detail
