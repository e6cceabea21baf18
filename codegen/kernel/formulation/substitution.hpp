// SPDX-License-Identifier: GPL-3.0-or-later
// Translates a model and a motion to the variables of a kernel and the meaning of each symbol.
#pragma once

#include <string>
#include <vector>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/symbolic/from_ginac.hpp"

namespace regulus::detail {

/// The replacements of the model's symbols: for exact geometry its value, for uncertain geometry a
/// variable, for pose parameters the motion's map plus a control error if there is one.
class Substitution {
 public:
  /// `meter`: null, or it outlives this object and counts the nodes that are read.
  ///
  /// Throws InputError if the motion has another number of pose parameters than the model, a name
  /// denotes two variables, or shapes do not fit.
  Substitution(const Model& model, const Motion& motion, WorkMeter* meter = nullptr);

  [[nodiscard]] const std::vector<Variable>& variables() const noexcept { return variables_; }
  [[nodiscard]] std::vector<std::string> names() const;

  /// Returns e over the kernel's variables. GiNaC evaluates parts that become constant, such as
  /// sin(pi/6).
  [[nodiscard]] Expression apply(const GiNaC::ex& e);

  /// Returns e with the pose as commanded: without control errors.
  [[nodiscard]] Expression apply_commanded(const GiNaC::ex& e);

  /// Returns the roots, denominators, … of e as written, over the kernel's variables.
  [[nodiscard]] Expressions partial_operations(const GiNaC::ex& e);

 private:
  void add_variable(Variable variable, const GiNaC::ex& symbol);
  void add_geometry(const Model& model);
  void add_pose(const Model& model, const Motion& motion);
  [[nodiscard]] std::string unused_name(const std::string& wish) const;
  Expression apply(const GiNaC::ex& e, const GiNaC::exmap& replaced);

  WorkMeter* meter_;
  std::vector<Variable> variables_;
  std::vector<std::string> reserved_;
  GiNaC::exmap replaced_;  // model and motion symbols, errors included
  GiNaC::exmap commanded_;
  SymbolMeaning symbols_;  // the symbols that stay
  SymbolMeaning written_;  // pose and geometry symbols as the expressions they stand for
};

/// Returns the sub-expressions of e whose operation is undefined for some operands, inner ones
/// first.
[[nodiscard]] Expressions partial_nodes(const Expression& e);

}  // namespace regulus::detail
