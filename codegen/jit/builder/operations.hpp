// SPDX-License-Identifier: GPL-3.0-or-later
// The arithmetic of packs inside a function that is being built.
#pragma once

#include <llvm/ADT/ArrayRef.h>
#include <llvm/ADT/SmallVector.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Module.h>

#include <cstdint>
#include <string>
#include <variant>

namespace regulus::codegen::builder {

/// A vector or number of an object, at its offset in the object's type.
struct Component {
  std::uint64_t offset;
  llvm::Value* value;
};

/// An interval, a point or a mask of lanes: its components, its place in memory, or both. Only a
/// mask changes.
struct Object {
  bool changes = false;
  llvm::SmallVector<Component, 4> components;
  llvm::Value* address = nullptr;
};

/// An operand: an object, or a number or pointer as it is.
using Operand = std::variant<Object*, llvm::Value*>;

/// The functions of operations/pack_operations.hpp in a module.
class Operations {
 public:
  /// Requires  the module is that of pack_operations.hpp for one instruction set.
  explicit Operations(llvm::Module& module);

  /// Puts the operation's instructions at the end of the function. One without branches and memory
  /// of its own becomes its instructions on the operands' components; another is called.
  ///
  /// Throws    reader::OutsideSubset when there is no such operation.
  void apply(llvm::IRBuilder<>& code, const std::string& name, llvm::ArrayRef<Operand> operands);

  /// Memory for one interval or more, in the function's first block.
  [[nodiscard]] llvm::Value* reserve(llvm::IRBuilder<>& code, std::uint64_t intervals);

  /// The interval in memory with its components read, so that later writes do not change it; and
  /// the reverse.
  [[nodiscard]] Object read(llvm::IRBuilder<>& code, llvm::Value* address);
  void write(llvm::IRBuilder<>& code, Object& value, llvm::Value* address);

  /// Where the object is in memory, written there if it was not.
  [[nodiscard]] llvm::Value* address(llvm::IRBuilder<>& code, Object& object);

  [[nodiscard]] const llvm::Function& sample() const noexcept { return *load_; }

 private:
  struct Part {
    std::uint64_t offset;
    llvm::Type* type;
  };

  [[nodiscard]] llvm::Value* at(llvm::IRBuilder<>& code, llvm::Value* address,
                                std::uint64_t offset);
  [[nodiscard]] llvm::Value* component(llvm::IRBuilder<>& code, Object& object,
                                       std::uint64_t offset, llvm::Type* type);
  void expand(llvm::IRBuilder<>& code, llvm::Function& operation, llvm::ArrayRef<Operand> operands);
  void call(llvm::IRBuilder<>& code, llvm::Function& operation, llvm::ArrayRef<Operand> operands);

  llvm::Module& module_;
  llvm::Function* load_;
  llvm::SmallVector<Part, 4> layout_;  ///< of an interval
};

}  // namespace regulus::codegen::builder
