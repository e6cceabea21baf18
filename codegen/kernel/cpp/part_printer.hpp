// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the instructions of one part of a function as C++ statements.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "codegen/kernel/cpp/expression_text.hpp"
#include "codegen/kernel/cpp/value_names.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "codegen/kernel/program/module.hpp"

namespace regulus::detail {

/// A sum, product or sign that is read once is written inside the expression that reads it, if that
/// fits on a line. This is the only decision of the printer.
class PartPrinter {
 public:
  PartPrinter(const Module& module, const Function& function, const SelectedFunction& selected,
              ValueNames& names, std::uint32_t part);

  /// The parameters that the statements use.
  struct Usage {
    bool boxes = false;
    bool points = false;
    bool out = false;
    bool shared = false;
  };

  void print();

  [[nodiscard]] const std::string& declarations() const noexcept { return declarations_; }
  [[nodiscard]] const std::string& statements() const noexcept { return statements_; }
  [[nodiscard]] const Usage& usage() const noexcept { return usage_; }

 private:
  using ValueId = machine::ValueId;
  using Instruction = machine::PackInstruction;

  [[nodiscard]] const Instruction& at(ValueId value) const { return selected_.code.code[value]; }
  [[nodiscard]] bool is_pending(ValueId value) const { return pending_.contains(value); }

  void count_uses();
  void print_mark(const SelectedFunction::Mark& mark);
  void print_instruction(ValueId value);
  void print_store(const Instruction& instruction);
  void print_keep(const Instruction& instruction);
  void print_sine_and_cosine(ValueId value);
  void define(ValueId value, const std::string& expression);
  void declare(ValueId value, const std::string& expression);
  [[nodiscard]] bool can_wait(ValueId value) const;
  [[nodiscard]] bool is_kept(ValueId value) const;
  [[nodiscard]] bool is_checked_constant(ValueId value) const;

  /// The expression of the instruction, short enough for a line.
  [[nodiscard]] ExpressionText compute(ValueId value);
  [[nodiscard]] ExpressionText render(ValueId value);
  [[nodiscard]] ExpressionText render_call(const Instruction& instruction);
  /// Returns the value as an operand: its name, or its expression if it is pending.
  [[nodiscard]] ExpressionText use(ValueId value);
  [[nodiscard]] std::string name_of(ValueId value);

  const Module& module_;
  const Function& function_;
  const SelectedFunction& selected_;
  ValueNames& names_;
  std::uint32_t begin_, end_;
  std::vector<std::uint32_t> uses_;                      ///< by instructions of this part
  std::unordered_map<ValueId, ExpressionText> pending_;  ///< to be written at its only use
  std::unordered_map<ValueId, std::string> named_;
  std::string declarations_;
  std::string statements_;
  Usage usage_;
};

}  // namespace regulus::detail
