// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/llvm/code_generator.hpp"

#include <llvm/Analysis/TargetTransformInfo.h>
#include <llvm/Config/llvm-config.h>
#include <llvm/IR/LegacyPassManager.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Passes/PassBuilder.h>
#include <llvm/Support/ErrorHandling.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/TargetParser/Triple.h>
#include <llvm/Transforms/Scalar.h>

#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <new>
#include <utility>

namespace regulus::detail::plugin {
namespace {

/// Ends the process as an internal fault. LLVM's own handler would exit with status 1, which is a
/// verdict of Regulus.
void end_on_fatal_error(void*, const char* reason, bool) {
  std::fprintf(stderr, "internal fault in the code generator: %s\n", reason);
  std::_Exit(70);
}

/// LLVM's own handler ends the process, and with it the answer that the interpreter would find.
void throw_bad_alloc(void*, const char*, bool) { throw std::bad_alloc(); }

}  // namespace

void initialise_llvm() {
  static std::once_flag once;
  std::call_once(once, [] {
    llvm::remove_fatal_error_handler();  // that of the other plugin, which does the same
    llvm::install_fatal_error_handler(end_on_fatal_error);
    llvm::remove_bad_alloc_error_handler();
    llvm::install_bad_alloc_error_handler(throw_bad_alloc);
    LLVMInitializeX86TargetInfo();
    LLVMInitializeX86Target();
    LLVMInitializeX86TargetMC();
    LLVMInitializeX86AsmPrinter();
  });
}

std::unique_ptr<llvm::TargetMachine> make_target_machine(const std::string& name,
                                                         const std::string& cpu,
                                                         const std::string& features,
                                                         llvm::raw_ostream& errors,
                                                         bool optimises_code) {
  const llvm::Triple triple(name);
  std::string error;
#if LLVM_VERSION_MAJOR >= 22
  const llvm::Target* found = llvm::TargetRegistry::lookupTarget(triple, error);
#else
  const llvm::Target* found = llvm::TargetRegistry::lookupTarget(name, error);
#endif
  if (!found) {
    errors << error << '\n';
    return nullptr;
  }
  llvm::TargetOptions options;
  options.AllowFPOpFusion = llvm::FPOpFusion::Strict;
  return std::unique_ptr<llvm::TargetMachine>(found->createTargetMachine(
#if LLVM_VERSION_MAJOR >= 21
      triple,
#else
      name,
#endif
      cpu, features, options, llvm::Reloc::PIC_, llvm::CodeModel::Small,
      optimises_code ? llvm::CodeGenOptLevel::Default : llvm::CodeGenOptLevel::None));
}

bool optimise(llvm::Module& module, llvm::TargetMachine& machine, const char* passes,
              llvm::raw_ostream& errors) {
  llvm::LoopAnalysisManager loops;
  llvm::FunctionAnalysisManager functions;
  llvm::CGSCCAnalysisManager components;
  llvm::ModuleAnalysisManager modules;
  llvm::PassBuilder builder(&machine);
  builder.registerModuleAnalyses(modules);
  builder.registerCGSCCAnalyses(components);
  builder.registerFunctionAnalyses(functions);
  builder.registerLoopAnalyses(loops);
  builder.crossRegisterProxies(loops, functions, components, modules);
  llvm::ModulePassManager pipeline;
  if (llvm::Error error = builder.parsePassPipeline(pipeline, passes)) {
    errors << llvm::toString(std::move(error)) << '\n';
    return false;
  }
  pipeline.run(module, modules);
  return true;
}

bool generate_code(llvm::Module& module, llvm::TargetMachine& machine,
                   llvm::SmallVectorImpl<char>& object, llvm::raw_ostream& errors,
                   Repeated repeated) {
  llvm::raw_svector_ostream stream(object);
  llvm::legacy::PassManager passes;
  if (repeated == Repeated::kJoined) {
    passes.add(llvm::createTargetTransformInfoWrapperPass(machine.getTargetIRAnalysis()));
    passes.add(llvm::createEarlyCSEPass());
  }
  if (machine.addPassesToEmitFile(passes, stream, nullptr, llvm::CodeGenFileType::ObjectFile)) {
    errors << "the target cannot write object files\n";
    return false;
  }
  passes.run(module);
  return true;
}

}  // namespace regulus::detail::plugin
