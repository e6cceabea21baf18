// SPDX-License-Identifier: GPL-3.0-or-later
// The Clang front end, without access to files of the machine. The driver parses the flags, so they
// have the same meaning as on a command line.
#pragma once

#include <clang/Basic/DiagnosticOptions.h>
#include <clang/Frontend/CompilerInstance.h>
#include <clang/Frontend/CompilerInvocation.h>
#include <clang/Frontend/TextDiagnosticPrinter.h>
#include <llvm/Config/llvm-config.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Module.h>
#include <llvm/Support/VirtualFileSystem.h>
#include <llvm/Support/raw_ostream.h>

#include <memory>
#include <string>

#include "codegen/kernel/jit/clang_interface.h"

static_assert(LLVM_VERSION_MAJOR >= 19, "LLVM 19 or newer is needed");

namespace regulus::detail::plugin {

using FileSystem = llvm::IntrusiveRefCntPtr<llvm::vfs::InMemoryFileSystem>;

/// The only files the compiler can see: the source and the headers, under the root.
[[nodiscard]] FileSystem make_file_system(const regulus_clang_request& request);

/// Diagnostics written to a string, for the driver and for the front end.
class Diagnostics {
 public:
  explicit Diagnostics(llvm::vfs::FileSystem& files)
#if LLVM_VERSION_MAJOR >= 21
      : printer_(stream_, options_),
        engine_(clang::CompilerInstance::createDiagnostics(files, options_, &printer_, false))
#elif LLVM_VERSION_MAJOR == 20
      : options_(new clang::DiagnosticOptions),
        printer_(stream_, options_.get()),
        engine_(clang::CompilerInstance::createDiagnostics(files, options_.get(), &printer_, false))
#else
      : options_(new clang::DiagnosticOptions),
        printer_(stream_, options_.get()),
        engine_(clang::CompilerInstance::createDiagnostics(options_.get(), &printer_, false))
#endif
  {
    (void)files;
  }

  clang::DiagnosticsEngine& engine() { return *engine_; }
  llvm::IntrusiveRefCntPtr<clang::DiagnosticsEngine> shared_engine() { return engine_; }
  clang::DiagnosticConsumer& consumer() { return printer_; }
  llvm::raw_ostream& stream() { return stream_; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  llvm::raw_string_ostream stream_{text_};
#if LLVM_VERSION_MAJOR >= 21
  clang::DiagnosticOptions options_;
#else
  llvm::IntrusiveRefCntPtr<clang::DiagnosticOptions> options_;
#endif
  clang::TextDiagnosticPrinter printer_;
  llvm::IntrusiveRefCntPtr<clang::DiagnosticsEngine> engine_;
};

/// Returns null if the flags have an error.
[[nodiscard]] std::unique_ptr<clang::CompilerInvocation> make_invocation(
    const regulus_clang_request& request, const FileSystem& files, Diagnostics& diagnostics);

/// Returns intermediate code before any pass; null if the text has an error.
[[nodiscard]] std::unique_ptr<llvm::Module> run_front_end(
    std::unique_ptr<clang::CompilerInvocation> invocation, const FileSystem& files,
    Diagnostics& diagnostics, llvm::LLVMContext& context);

/// Returns the features of the `-target-feature` options in the form for a target machine.
[[nodiscard]] std::string features_of(const clang::TargetOptions& target);

}  // namespace regulus::detail::plugin
