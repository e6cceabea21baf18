// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/options_key.hpp"

#include <string>

namespace regulus::detail {
namespace {

// In these functions the structured binding names all members: a new member does not compile
// until it is in the key.

void add(KeyParts& parts, const RewriteOptions& options) {
  const auto& [rewrite, horner, trigonometric, most_terms, nesting, weights, squares_roots] =
      options;
  const auto& [order, factor, complete_squares] = nesting;
  for (const bool flag : {rewrite, horner, trigonometric, factor, complete_squares})
    parts.add(flag);
  parts.add(static_cast<int>(order));
  parts.add(std::to_string(most_terms));
  parts.add(squares_roots);
  parts.begin_list(weights.size());
  for (const auto& [name, weight] : weights) {
    parts.add(name);
    parts.add(std::to_string(weight));
  }
}

}  // namespace

void add(KeyParts& parts, const FormulationOptions& options) {
  const auto& [matrix, matrix_derivatives, left_product, derivatives, right_product, determinant,
               determinant_budget, expansion, rows, columns, scaling, threshold, counts, rewriting,
               forming_budget] = options;
  for (const bool flag : {matrix, matrix_derivatives, left_product, derivatives, right_product,
                          determinant, rows, scaling, threshold, counts})
    parts.add(flag);
  parts.add(std::to_string(determinant_budget));
  parts.add(std::to_string(forming_budget));
  parts.add(static_cast<int>(expansion));
  parts.add(static_cast<int>(columns));
  add(parts, rewriting);
}

}  // namespace regulus::detail
