// SPDX-License-Identifier: GPL-3.0-or-later
// Describes, for people, the work of the symbolic stage on a model.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "codegen/kernel/formulation/formulation.hpp"

namespace regulus::detail {

enum class ExplainPart { kAll, kMatrix, kOccurrences };

struct ExplainOptions {
  ExplainPart part = ExplainPart::kAll;
  bool all_entries = false;  ///< every entry of K·A and A·K, not only one row and one column
  FormulationOptions formulation;  ///< matrix and products are always formed
  /// The kernel whose functions are listed; nullopt: what `formulation` forms.
  std::optional<FormulationOptions> kernel;
  std::size_t longest = 1200;  ///< characters of one expression; a cut is marked
};

struct Explanation {
  std::string text;
  MatrixScaling scaling;  ///< of the matrix in K·A and A·K
};

/// Explains the matrix, its scaling, the entries of K·A and A·K before and after rewriting, the
/// occurrences of each variable, the chosen passes and the number of operations.
[[nodiscard]] Explanation explain(const Model& model, const Motion& motion,
                                  const ExplainOptions& options = {});

/// The same over the pose parameters themselves. Without scaling, because scaling needs a motion. Of
/// a model with a closure: its equations, and their matrix over pose and unknowns; also for a motion.
[[nodiscard]] Explanation explain(const Model& model, const ExplainOptions& options = {});

/// The box variety in which every pose parameter is its own motion parameter. Its ranges are
/// points: use it for forms, not for verdicts.
[[nodiscard]] Motion pose_as_motion(const Model& model);

}  // namespace regulus::detail
