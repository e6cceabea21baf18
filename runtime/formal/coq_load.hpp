// SPDX-License-Identifier: Apache-2.0
// A load in a certificate, as variables of a question: an uncertain quantity for each component that
// varies. And the question of a certificate about forces within limits: Limits.v has its proof.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/formal/coq_tree.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// Returns the name, with '_' at its end until no line mentions it.
[[nodiscard]] std::string free_name(std::string name, const std::vector<std::string>& lines);

/// Returns the text E of each line `KEY E`.
[[nodiscard]] std::vector<std::string> rests_of(const std::vector<std::string>& lines,
                                                std::string_view key);

/// Throws Rejection unless each of these spreads or radii is certainly at least 0: a theorem about no
/// vector would be true.
void require_vectors(const Question& question, const std::vector<NodeId>& sizes);

/// A variable of a load: a component, within its spread, or a coordinate of a ball.
struct LoadVariable {
  std::size_t column = 0;
  std::optional<std::size_t> ball;
  bool has_middle = false;  ///< it is about the middle of the component, not about 0
};

struct LoadVariables {
  std::string lines;                    ///< `uncertain` and `ball`
  std::vector<LoadVariable> variables;  ///< the uncertain quantities
  std::vector<std::string> components;  ///< by column: an expression in their names
};

/// Reads the lines `wrench` and `wrench-ball` among the lines of a certificate. Throws Rejection if a
/// spread or a radius is negative.
///
/// Requires  that they have been read without a fault; `set`: the load that they say.
[[nodiscard]] LoadVariables load_variables(const Question& question, const VectorSetLines& set,
                                           const std::vector<std::string>& lines);

/// Returns the lines before that which begins with `end`, as a question about the matrix, NO
/// SINGULARITY, with the variables of the load and, before the matrix, these lines.
[[nodiscard]] std::string question_with(const LoadVariables& load, const Question& question,
                                        const std::vector<std::string>& lines, std::string_view end,
                                        const std::string& before_matrix);

/// A question about forces within limits.
struct LimitsQuestion {
  std::string question;           ///< about the matrix
  std::vector<std::string> more;  ///< lines for coq_question: `scale`, `load` and `limits`
  VariablesOfCoq variables;
  std::vector<LoadVariable> of_load;  ///< those that are not of the certificate, in their order
};

/// Returns coordinates of a vector of the load that is farthest along a direction, or nearly so, in the
/// order of `variables`: hexadecimal doubles, or `upper` and `lower` for the ends of a range.
[[nodiscard]] std::vector<std::string> farthest_load(const Question& question,
                                                     const std::vector<LoadVariable>& variables,
                                                     const std::vector<double>& direction);

/// Takes the load and the limits out of the lines of a certificate, which are those of `question`.
/// Throws Rejection if the load or the limits are empty.
[[nodiscard]] LimitsQuestion split_limits(const Question& question,
                                          const std::vector<std::string>& lines);

}  // namespace regulus::verifier
