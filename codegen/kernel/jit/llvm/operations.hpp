// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the arithmetic of packs inside a function.
#pragma once

#include <llvm/ADT/ArrayRef.h>
#include <llvm/ADT/SmallVector.h>
#include <llvm/ADT/StringMap.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Module.h>

#include <cstdint>
#include <variant>

namespace regulus::detail::builder {

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

/// An operand: an object, or a plain number or pointer.
using Operand = std::variant<Object*, llvm::Value*>;

/// The functions of operations/pack_operations.hpp, in a module that is read on demand.
class Operations {
 public:
  /// Requires  the module is that of pack_operations.hpp for one instruction set, and
  ///           outlives this.
  /// Throws    std::runtime_error for another.
  explicit Operations(llvm::Module& packs);

  /// Returns the operation if its instructions can be copied to the place of use: it has no
  /// branches, calls or memory of its own. Null if there is none of that name, or it is not of that
  /// kind.
  [[nodiscard]] llvm::Function* find_straight(const char* name);

  /// Appends the operation's instructions to the function that is built.
  ///
  /// Requires  an operation that find_straight found.
  void expand(llvm::IRBuilder<>& code, llvm::Function& operation, llvm::ArrayRef<Operand> operands);

  /// Writes the components of an interval, or of the object, to memory.
  void write(llvm::IRBuilder<>& code, Object& interval, llvm::Value* address);
  void write_components(llvm::IRBuilder<>& code, const Object& object, llvm::Value* address);

  /// Reads the components of an interval in memory, so that later writes do not change it.
  [[nodiscard]] Object read(llvm::IRBuilder<>& code, llvm::Value* address);

  /// Returns the component of that offset; reads it from memory if it is not known.
  [[nodiscard]] llvm::Value* component(llvm::IRBuilder<>& code, Object& object,
                                       std::uint64_t offset, llvm::Type* type);

  /// Returns a function with the target and the floating-point rules of all operations.
  [[nodiscard]] const llvm::Function& sample() const noexcept { return *load_; }

 private:
  struct Part {
    std::uint64_t offset;
    llvm::Type* type;
  };

  [[nodiscard]] llvm::Value* at(llvm::IRBuilder<>& code, llvm::Value* address,
                                std::uint64_t offset);

  llvm::Module& packs_;
  llvm::StringMap<llvm::Function*> straight_;  ///< results of find_straight, by name
  llvm::Function* load_;
  llvm::SmallVector<Part, 4> layout_;  ///< of an interval
};

}  // namespace regulus::detail::builder
