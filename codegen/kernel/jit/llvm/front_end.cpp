// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/llvm/front_end.hpp"

#include <clang/CodeGen/CodeGenAction.h>
#include <llvm/Support/MemoryBuffer.h>
#if LLVM_VERSION_MAJOR >= 22
#include <clang/Driver/CreateInvocationFromArgs.h>
#else
#include <clang/Frontend/Utils.h>
#endif

#include <utility>
#include <vector>

namespace regulus::detail::plugin {
namespace {

llvm::StringRef view(regulus_bytes bytes) { return {bytes.data, bytes.size}; }

}  // namespace

FileSystem make_file_system(const regulus_clang_request& request) {
  FileSystem files(new llvm::vfs::InMemoryFileSystem);
  const auto add = [&files](const regulus_named_text& file) {
    files->addFile("/" + view(file.name), 0,
                   llvm::MemoryBuffer::getMemBuffer(view(file.text), view(file.name)));
  };
  add(request.source);
  for (size_t i = 0; i < request.header_count; ++i) add(request.headers[i]);
  files->setCurrentWorkingDirectory("/");
  return files;
}

std::unique_ptr<clang::CompilerInvocation> make_invocation(const regulus_clang_request& request,
                                                           const FileSystem& files,
                                                           Diagnostics& diagnostics) {
  const std::string source = ("/" + view(request.source.name)).str();
  std::vector<const char*> arguments{"/clang++", "-xc++", "-I/"};
  arguments.insert(arguments.end(), request.flags, request.flags + request.flag_count);
  arguments.push_back(source.c_str());

  clang::CreateInvocationOptions options;
  options.Diags = diagnostics.shared_engine();
  options.VFS = files;
  auto invocation = clang::createInvocation(arguments, options);
  if (!invocation) return nullptr;
  clang::CodeGenOptions& code = invocation->getCodeGenOpts();
  code.DisableLLVMPasses = true;
  code.DisableLifetimeMarkers = true;
  code.RelaxedAliasing = true;
  code.DisableFree = false;
  invocation->getFrontendOpts().DisableFree = false;
  return invocation;
}

std::unique_ptr<llvm::Module> run_front_end(std::unique_ptr<clang::CompilerInvocation> invocation,
                                            const FileSystem& files, Diagnostics& diagnostics,
                                            llvm::LLVMContext& context) {
#if LLVM_VERSION_MAJOR >= 21
  clang::CompilerInstance instance(
      std::shared_ptr<clang::CompilerInvocation>(std::move(invocation)));
#else
  clang::CompilerInstance instance;
  instance.setInvocation(std::shared_ptr<clang::CompilerInvocation>(std::move(invocation)));
#endif
#if LLVM_VERSION_MAJOR >= 22
  instance.setVirtualFileSystem(files);
  instance.createDiagnostics(&diagnostics.consumer(), false);
  instance.createFileManager();
#else
  instance.setDiagnostics(diagnostics.shared_engine().get());
  instance.createFileManager(files);
#endif
  instance.setVerboseOutputStream(diagnostics.stream());
  clang::EmitLLVMOnlyAction action(&context);
  if (!instance.ExecuteAction(action)) return nullptr;
  return action.takeModule();
}

std::string features_of(const clang::TargetOptions& target) {
  std::string features;
  for (const std::string& feature : target.FeaturesAsWritten)
    features += (features.empty() ? "" : ",") + feature;
  return features;
}

}  // namespace regulus::detail::plugin
