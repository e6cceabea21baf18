// SPDX-License-Identifier: GPL-3.0-or-later
// What the symbolic stage did to a model, for people.
#pragma once

#include <cstddef>
#include <string>

#include "codegen/formulation/formulation.hpp"

namespace regulus::inline formulation {

enum class ExplainPart { kAll, kMatrix, kOccurrences };

struct ExplainOptions {
  ExplainPart part = ExplainPart::kAll;
  bool all_entries = false;        ///< every entry of K·A and A·K, not one row and one column
  FormulationOptions formulation;  ///< matrix and products are always formed
  std::size_t longest = 1200;      ///< characters of one expression; what is cut is said to be
};

struct Explanation {
  std::string text;
  MatrixScaling scaling;  ///< of the matrix that K·A and A·K are made of
};

/// The matrix, its scaling, the forms of K·A's and A·K's entries before and after, how often each
/// variable occurs in them, the passes that were chosen and the operations that are left.
[[nodiscard]] Explanation explain(const Model& model, const Motion& motion,
                                  const ExplainOptions& options = {});

/// The same over the pose parameters themselves, without scaling: scales are judged over a motion.
[[nodiscard]] Explanation explain(const Model& model, const ExplainOptions& options = {});

/// The box variety in which every pose parameter is its own motion parameter. Its ranges are
/// points: it is for forms, not for verdicts.
[[nodiscard]] Motion pose_as_motion(const Model& model);

}  // namespace regulus::inline formulation
