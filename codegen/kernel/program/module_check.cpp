// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/module_check.hpp"

#include <set>
#include <stdexcept>

namespace regulus::detail {
namespace {

[[noreturn]] void refuse(const Function& function, const std::string& reason) {
  throw std::invalid_argument("function " + function.name + ": " + reason);
}

void require(bool condition, const Function& function, const char* reason) {
  if (!condition) refuse(function, reason);
}

bool lists_derivatives(const std::string& name) {
  return name == "nominal_first" || name == "expansion_second" || name == "row_first" ||
         name == "row_second";
}

/// Returns the number of outputs of the function in the ABI; −1 for an unknown name.
long expected_outputs(const Module& module, const Function& function) {
  const std::string& name = function.name;
  const long rows = module.rows;
  const long columns = module.columns;
  if (name == "matrix") return rows * columns;
  if (name == "matrix_derivatives")
    return static_cast<long>(module.variables.size()) * rows * columns;
  if (name == "left_product") return columns * columns;
  if (name == "left_derivatives")
    return static_cast<long>(module.variables.size()) * columns * columns;
  if (name == "right_product") return rows * rows;
  if (name == "row_scale") return 1;
  if (name == "constraint") return module.constraints;
  if (name == "pose") return module.pose_parameters;
  if (name == "determinant") return 1;
  if (name == "determinant_derivatives") return static_cast<long>(module.variables.size());
  if (name == "nominal_product") return columns * columns;
  if (lists_derivatives(name)) return static_cast<long>(function.derivatives.size());
  return -1;
}

bool needs_square_matrix(const std::string& name) {
  return name == "right_product" || name == "determinant" || name == "determinant_derivatives";
}

void check_shape(const Module& module, const Function& function) {
  const long expected = expected_outputs(module, function);
  const auto found = static_cast<long>(function.program.outputs.size());
  require(expected >= 0, function, "not a function of the kernel ABI");
  require(!needs_square_matrix(function.name) || module.rows == module.columns, function,
          "needs a square matrix");
  if (found != expected)
    refuse(function,
           "has " + std::to_string(found) + " outputs, expected " + std::to_string(expected));
  const std::size_t points = function.program.points.size();
  require(points == 0 || points == static_cast<std::size_t>(module.rows) * module.columns, function,
          "must read all entries of K or none");
  require(function.program.inputs == module.variables, function,
          "must read the variables of its module");
}

void check_derivatives(const Module& module, const Function& function) {
  const bool of_second_order = function.name == "expansion_second" || function.name == "row_second";
  const auto variables = static_cast<int>(module.variables.size());
  for (const DerivativeIndex& d : function.derivatives) {
    require(d.row >= 0 && d.row < module.rows && d.column >= 0 && d.column < module.columns,
            function, "a derivative of no entry");
    require(d.first >= 0 && d.first < variables, function, "a derivative by no variable");
    require(of_second_order ? d.second >= d.first && d.second < variables
                            : d.second == DerivativeIndex::kNone,
            function, "a derivative of another order");
  }
}

void check_expansion(const Module& module) {
  const Expansion& expansion = *module.expansion;
  const auto fits = [&](const std::string& name, bool listed) {
    const Function* function = module.find(name);
    return function != nullptr &&
           (!listed || function->derivatives.size() == function->program.outputs.size());
  };
  if (!fits(expansion.product, false) || (!expansion.first.empty() && !fits(expansion.first, true)))
    throw std::invalid_argument("the expansion lacks its product or its first derivatives");
  if (expansion.row_of_variable.size() != module.variables.size() ||
      (!expansion.ball_of_variable.empty() &&
       expansion.ball_of_variable.size() != module.variables.size()) ||
      (!expansion.nominal.empty() && expansion.nominal.size() != module.variables.size()))
    throw std::invalid_argument("the expansion has not one row, or value, for each variable");
}

void check_node(const Function& function, std::size_t i) {
  const Program& program = function.program;
  const Node& node = program.nodes[i];
  const int operands = operand_count(node.op);
  require(operands < 1 || node.a < i, function, "operand after its use");
  require(operands < 2 || node.b < i, function, "operand after its use");
  require(node.op != Op::kConstant || node.index < program.constants.size(), function,
          "undeclared constant");
  require(node.op != Op::kInput || node.index < program.inputs.size(), function,
          "undeclared input");
  require(node.op != Op::kPoint || node.index < program.points.size(), function,
          "undeclared point");
  require(node.op != Op::kPower || node.index >= 2, function, "exponent below 2");
}

}  // namespace

void check_module(const Module& module) {
  const auto variables = static_cast<int>(module.variables.size());
  if (module.columns < 1 || module.rows < module.columns)
    throw std::invalid_argument("the matrix must have at least as many rows as columns");
  if (module.motion_variables < 0 || module.motion_variables > variables)
    throw std::invalid_argument("more motion variables than variables");
  std::set<std::string> names;
  for (const Function& function : module.functions) {
    require(names.insert(function.name).second, function, "given twice");
    check_shape(module, function);
    check_derivatives(module, function);
    for (std::size_t i = 0; i < function.program.nodes.size(); ++i) check_node(function, i);
    for (const NodeId output : function.program.outputs)
      require(output < function.program.nodes.size(), function, "output is no node");
  }
  if (module.expansion) check_expansion(module);
}

}  // namespace regulus::detail
