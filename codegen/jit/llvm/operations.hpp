// SPDX-License-Identifier: GPL-3.0-or-later
// The arithmetic of packs inside a function that is being built.
#pragma once

#include <llvm/ADT/ArrayRef.h>
#include <llvm/ADT/SmallVector.h>
#include <llvm/ADT/StringMap.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Module.h>

#include <cstdint>
#include <variant>

namespace regulus::inline jit::builder {

/// A vector or number of an object, at its offset in the object's type.
struct Component {
  std::uint64_t offset;
  llvm::Value* value;
};

/// An interval, a point or a mask of lanes: its components, its place in memory, or both.
struct Object {
  llvm::SmallVector<Component, 4> components;
  llvm::Value* address = nullptr;
};

/// An operand: an object, or a number or pointer as it is.
using Operand = std::variant<Object*, llvm::Value*>;

/// The functions of operations/pack_operations.hpp in a module that is read as they are needed.
class Operations {
 public:
  /// Requires  the module is that of pack_operations.hpp for one instruction set, and outlives
  /// this. Throws    std::runtime_error for another.
  explicit Operations(llvm::Module& packs);

  /// The operation whose instructions may stand where it is used: without branches, calls and
  /// memory of its own. Null when there is none of that name, or it is not of that kind.
  [[nodiscard]] llvm::Function* find_straight(const char* name);

  /// Puts the operation's instructions at the end of the function that is built.
  ///
  /// Requires  an operation that find_straight found.
  void expand(llvm::IRBuilder<>& code, llvm::Function& operation, llvm::ArrayRef<Operand> operands);

  /// Writes the components of an interval, or those that the object has, to memory.
  void write(llvm::IRBuilder<>& code, Object& interval, llvm::Value* address);
  void write_components(llvm::IRBuilder<>& code, const Object& object, llvm::Value* address);

  /// The interval in memory with its components read, so that later writes do not change it.
  [[nodiscard]] Object read(llvm::IRBuilder<>& code, llvm::Value* address);

  /// The component of that offset, read from memory if it is not known.
  [[nodiscard]] llvm::Value* component(llvm::IRBuilder<>& code, Object& object,
                                       std::uint64_t offset, llvm::Type* type);

  /// With the target and the floating-point rules that all operations were compiled for.
  [[nodiscard]] const llvm::Function& sample() const noexcept { return *load_; }

 private:
  struct Part {
    std::uint64_t offset;
    llvm::Type* type;
  };

  [[nodiscard]] llvm::Value* at(llvm::IRBuilder<>& code, llvm::Value* address,
                                std::uint64_t offset);

  llvm::Module& packs_;
  llvm::StringMap<llvm::Function*> straight_;  ///< those that were looked for; null: it is none
  llvm::Function* load_;
  llvm::SmallVector<Part, 4> layout_;  ///< of an interval
};

}  // namespace regulus::inline jit::builder
