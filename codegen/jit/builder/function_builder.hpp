// SPDX-License-Identifier: GPL-3.0-or-later
// The body of one function of a kernel.
#pragma once

#include <llvm/ADT/StringMap.h>

#include <deque>
#include <string>

#include "regulus/codegen/jit/builder/operations.hpp"
#include "regulus/codegen/jit/reader/syntax.hpp"

namespace regulus::codegen::builder {

/// The functions of the text that have been declared, by their names in it.
using FunctionTable = llvm::StringMap<llvm::Function*>;

class FunctionBuilder {
 public:
  FunctionBuilder(Operations& operations, const FunctionTable& functions, llvm::Function& function,
                  const reader::FunctionText& text);

  /// Throws    reader::OutsideSubset.
  void run();

 private:
  /// A value and what it is: an interval 'I', a point 'P'.
  struct Typed {
    char type;
    Object object;
  };
  /// The operands of an operation and the letters of their kinds.
  struct Operands {
    std::string kinds;
    llvm::SmallVector<Operand, 4> list;
  };

  void execute(const reader::Statement& statement);
  void evaluate(const reader::Expression& call, std::int64_t element, std::string_view variable);
  void store(const reader::Expression& call, std::int64_t element, std::string_view variable);
  void sine_and_cosine(const reader::Expression& call);
  void call_part(const reader::Statement& statement);

  [[nodiscard]] Typed& value(const reader::Expression& expression);
  [[nodiscard]] Typed& operation(const reader::Expression& expression);
  [[nodiscard]] Typed& row(const reader::Expression& call);
  void add_operand(const reader::Expression& expression, std::string_view operation,
                   Operands& operands);
  [[nodiscard]] llvm::Value* row_address(std::string_view array, std::int64_t row);
  [[nodiscard]] llvm::Value* slot_address(std::string_view array, std::int64_t index);
  [[nodiscard]] llvm::Value* pointer(std::string_view name) const;
  [[nodiscard]] Object& mask(std::string_view name);
  void define(std::string_view name, Typed& value);
  [[nodiscard]] Typed& make(char type) { return made_.emplace_back(Typed{type, {}}); }

  Operations& operations_;
  const FunctionTable& functions_;
  const reader::FunctionText& text_;
  llvm::IRBuilder<> code_;
  std::deque<Typed> made_;  ///< all values; they do not move while they are pointed to
  llvm::StringMap<Typed*> values_;
  llvm::StringMap<Object> masks_;
  llvm::StringMap<llvm::Value*> pointers_;
};

}  // namespace regulus::codegen::builder
