// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/print.hpp"

#include <cln/rational_io.h>

#include <sstream>

#include "runtime/files/sha256.hpp"

namespace regulus::detail {
namespace {

// The length in front separates two lists of names, whatever the names contain.
void print_names(std::ostream& text, const char* what, const std::vector<std::string>& names) {
  text << what << ' ' << names.size();
  for (const std::string& name : names) text << ' ' << name.size() << ':' << name;
  text << '\n';
}

void print_expansion(std::ostream& text, const Expansion& expansion) {
  text << "expansion " << expansion.product << ' ' << expansion.first << "\nrows";
  for (const int row : expansion.row_of_variable) text << ' ' << row;
  text << "\nballs";
  for (const int ball : expansion.ball_of_variable) text << ' ' << ball;
  text << "\nnominal" << std::hexfloat;
  for (const Interval& x : expansion.nominal) text << ' ' << x.lo << ' ' << x.hi;
  text << '\n' << std::defaultfloat;
}

void print_leaf(std::ostream& text, const Program& program, const Node& node) {
  if (node.op == Op::kConstant)
    text << ' ' << program.constants[node.index];
  else if (node.op != Op::kNumberPi)
    text << ' ' << node.index;
}

}  // namespace

std::string to_text(const Program& program) {
  std::ostringstream text;
  print_names(text, "inputs", program.inputs);
  print_names(text, "points", program.points);
  for (std::size_t i = 0; i < program.nodes.size(); ++i) {
    const Node& node = program.nodes[i];
    const int operands = operand_count(node.op);
    text << '%' << i << " = " << op_name(node.op);
    if (operands == 0) print_leaf(text, program, node);
    if (operands >= 1) text << " %" << node.a;
    if (operands == 2) text << " %" << node.b;
    if (node.op == Op::kPower) text << ' ' << node.index;
    text << '\n';
  }
  text << "outputs";
  for (const NodeId output : program.outputs) text << " %" << output;
  text << '\n';
  return text.str();
}

std::string to_text(const Module& module) {
  std::ostringstream text;
  print_names(text, "variables", module.variables);
  text << "motion_variables " << module.motion_variables << "\nrows " << module.rows << "\ncolumns "
       << module.columns << "\nconstraints " << module.constraints << "\npose_parameters "
       << module.pose_parameters << '\n';
  for (const Function& function : module.functions) {
    text << "function " << function.name << '\n' << to_text(function.program);
    for (const DerivativeIndex& d : function.derivatives)
      text << "derivative " << d.row << ' ' << d.column << ' ' << d.first << ' ' << d.second
           << '\n';
  }
  if (module.expansion) print_expansion(text, *module.expansion);
  return text.str();
}

std::string identity(const Module& module) { return sha256(to_text(module)); }

}  // namespace regulus::detail
