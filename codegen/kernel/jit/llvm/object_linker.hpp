// SPDX-License-Identifier: GPL-3.0-or-later
// Brings a compiled text into memory by LLVM's linker.
#pragma once

#include <llvm/ADT/ArrayRef.h>
#include <llvm/ADT/StringMap.h>
#include <llvm/ADT/StringRef.h>
#include <llvm/ExecutionEngine/Orc/Core.h>
#include <llvm/ExecutionEngine/Orc/ObjectLinkingLayer.h>

#include <cstdint>
#include <string>

#include "codegen/kernel/jit/clang_interface.h"

namespace regulus::detail::plugin {

/// An object in memory: code readable and executable, constants read-only, variables writable, and
/// nothing ever writable and executable at once. Unmapped by the destructor.
class LinkedObject {
 public:
  /// Requires  a relocatable ELF object for this processor.
  /// Ensures   the object calls only `externals`, and nothing of it runs before it is called.
  /// Throws    std::runtime_error for another object.
  LinkedObject(llvm::StringRef object, llvm::ArrayRef<regulus_external> externals);
  LinkedObject(const LinkedObject&) = delete;
  LinkedObject& operator=(const LinkedObject&) = delete;

  /// Returns the address of a global symbol with at least `size` bytes; null if there is none.
  [[nodiscard]] void* find(llvm::StringRef name, std::uint64_t size) const;

 private:
  struct Symbol {
    void* address = nullptr;
    std::uint64_t size = 0;
  };
  /// Frees the memory while session and layer still live.
  struct End {
    ~End();
    llvm::orc::ExecutionSession& session;
  };

  void define(llvm::ArrayRef<regulus_external> externals);
  void link(llvm::StringRef object);

  std::string errors_;
  llvm::orc::ExecutionSession session_;
  llvm::orc::ObjectLinkingLayer layer_;
  llvm::orc::JITDylib& code_;
  llvm::StringMap<Symbol> symbols_;  ///< that the object defines
  End end_{session_};
};

}  // namespace regulus::detail::plugin
