// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/symbolic_stages.hpp"

namespace regulus::detail {
namespace {

FormulationOptions no_functions(const FormulationOptions& functions) {
  FormulationOptions options;
  options.rewriting = functions.rewriting;
  options.scaling = functions.scaling;
  options.threshold = functions.threshold;
  options.matrix = options.matrix_derivatives = options.left_product = false;
  options.derivatives = options.right_product = false;
  return options;
}

Program matrix_of(const Formulation& outline, const FormingWatch& watch) {
  Formulation f;
  f.variables = outline.variables;
  f.rows = outline.rows;
  f.columns = outline.columns;
  for (int i = 0; i < outline.rows; ++i)
    for (int j = 0; j < outline.columns; ++j)
      f.matrix.push_back(outline.scaling.apply(
          outline.natural_matrix[static_cast<std::size_t>(i * outline.columns + j)], i, j));
  f.must_be_defined = outline.must_be_defined;
  return lower(f, &watch).find("matrix")->program;
}

}  // namespace

const Request& SymbolicStages::request() {
  return made(request_, model_seconds_, [&] { return read_request(text_, options_, &watch_); });
}

const Formulation& SymbolicStages::natural_formulation() {
  const Request& of = request();
  return made(outline_, symbolic_seconds_,
              [&] { return formulate(of.model, of.motion, no_functions(functions_), &watch_); });
}

const Formulation& SymbolicStages::jacobian_formulation() {
  const Request& of = request();
  if (!of.model.jacobian) return natural_formulation();
  return made(jacobian_, symbolic_seconds_, [&] {
    Model model = of.model;
    model.matrix = *model.jacobian;
    return formulate(model, of.motion, no_functions(functions_), &watch_);
  });
}

const Program& SymbolicStages::matrix() {
  const Formulation& of = natural_formulation();
  return made(matrix_, symbolic_seconds_, [&] { return matrix_of(of, watch_); });
}

const Formulation& SymbolicStages::formulation() {
  const Request& of = request();
  return made(formulation_, symbolic_seconds_,
              [&] { return formulate(of.model, of.motion, functions_, &watch_); });
}

const Module& SymbolicStages::module() {
  const Formulation& of = formulation();
  return made(module_, symbolic_seconds_, [&] { return lower(of, &watch_); });
}

void SymbolicStages::give_up() {
  const Request& of = request();
  watch_ = {};
  matrix_.reset();
  outline_ = jacobian_ = formulation_ = formulate_shape(of.model, of.motion);
  module_ = undefined_kernel(
      *formulation_, static_cast<int>(of.motion.reach.size() + of.motion.constraints.size()),
      static_cast<int>(of.model.pose.size()));
}

}  // namespace regulus::detail
