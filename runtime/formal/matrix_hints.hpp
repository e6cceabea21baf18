// SPDX-License-Identifier: Apache-2.0
// How the definitions of a certificate are related to the names of a matrix in a model file. Numbers at
// some points suggest it; nothing is proved here.
#pragma once

#include <string>
#include <vector>

#include "runtime/formal/named_matrix.hpp"

namespace regulus::verifier {

/// A definition of the certificate is `word`, a multiple of a name; "": nothing is suggested. One sees
/// it if these names give way to their values, in this order.
struct DefinitionHint {
  std::string word;
  std::vector<std::string> without;
};

struct MatrixHints {
  std::vector<DefinitionHint> definitions;                ///< in the order of the question in Coq
  std::vector<std::vector<std::string>> entries, scales;  ///< the names that give way
};

/// `lines`: of the question. Appends to the robot's graph.
[[nodiscard]] MatrixHints find_matrix_hints(const Question& question,
                                            const std::vector<std::string>& lines,
                                            RobotOfModel& robot, const NamedMatrix& matrix);

}  // namespace regulus::verifier
