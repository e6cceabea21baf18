// SPDX-License-Identifier: GPL-3.0-or-later
// The in-process compiler: C++ text → relocatable object, with the Clang front end and the LLVM
// code generator. The only translation unit that sees LLVM; the program opens it when nothing
// cached fits.
//
// The driver parses the flags, so that they mean here what they mean on a command line. The
// optimiser runs only the passes it is asked for, and code generation runs without optimisation: a
// kernel is straight-line code without common sub-expressions, in which the default pipeline finds
// nothing but spends most of the time.
#include <clang/Basic/DiagnosticOptions.h>
#include <clang/CodeGen/CodeGenAction.h>
#include <clang/Frontend/CompilerInstance.h>
#include <clang/Frontend/CompilerInvocation.h>
#include <clang/Frontend/TextDiagnosticPrinter.h>
#include <llvm/Config/llvm-config.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/LegacyPassManager.h>
#include <llvm/IR/Module.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Passes/PassBuilder.h>
#include <llvm/Support/ErrorHandling.h>
#include <llvm/Support/MemoryBuffer.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/Support/VirtualFileSystem.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/Target/TargetMachine.h>
#include <llvm/TargetParser/Triple.h>
#if LLVM_VERSION_MAJOR >= 22
#include <clang/Driver/CreateInvocationFromArgs.h>
#else
#include <clang/Frontend/Utils.h>
#endif

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "regulus/codegen/jit/clang_interface.h"

static_assert(LLVM_VERSION_MAJOR >= 19, "LLVM 19 or newer is needed");

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

llvm::StringRef view(regulus_bytes bytes) { return {bytes.data, bytes.size}; }

/// Ends the process as an internal fault. LLVM's own handler would exit with status 1, which is a
/// verdict of Regulus.
void end_on_fatal_error(void*, const char* reason, bool) {
  std::fprintf(stderr, "internal fault in the code generator: %s\n", reason);
  std::_Exit(70);
}

void initialise_llvm() {
  static std::once_flag once;
  std::call_once(once, [] {
    llvm::install_fatal_error_handler(end_on_fatal_error);
    LLVMInitializeX86TargetInfo();
    LLVMInitializeX86Target();
    LLVMInitializeX86TargetMC();
    LLVMInitializeX86AsmPrinter();
  });
}

using FileSystem = llvm::IntrusiveRefCntPtr<llvm::vfs::InMemoryFileSystem>;

/// The only files the compiler can see: the source and the headers, under the root.
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

std::unique_ptr<llvm::TargetMachine> make_target_machine(const clang::TargetOptions& target,
                                                         llvm::raw_ostream& errors) {
  const llvm::Triple triple(target.Triple);
  std::string error;
#if LLVM_VERSION_MAJOR >= 22
  const llvm::Target* found = llvm::TargetRegistry::lookupTarget(triple, error);
#else
  const llvm::Target* found = llvm::TargetRegistry::lookupTarget(target.Triple, error);
#endif
  if (!found) {
    errors << error << '\n';
    return nullptr;
  }
  std::string features;
  for (const std::string& feature : target.FeaturesAsWritten)
    features += (features.empty() ? "" : ",") + feature;
  llvm::TargetOptions options;
  options.AllowFPOpFusion = llvm::FPOpFusion::Strict;
  return std::unique_ptr<llvm::TargetMachine>(found->createTargetMachine(
#if LLVM_VERSION_MAJOR >= 21
      triple,
#else
      target.Triple,
#endif
      target.CPU, features, options, llvm::Reloc::PIC_, llvm::CodeModel::Small,
      llvm::CodeGenOptLevel::None));
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
                   llvm::SmallVectorImpl<char>& object, llvm::raw_ostream& errors) {
  llvm::raw_svector_ostream stream(object);
  llvm::legacy::PassManager passes;
  if (machine.addPassesToEmitFile(passes, stream, nullptr, llvm::CodeGenFileType::ObjectFile)) {
    errors << "the target cannot write object files\n";
    return false;
  }
  passes.run(module);
  return true;
}

bool compile(const regulus_clang_request& request, Diagnostics& diagnostics,
             const FileSystem& files, llvm::SmallVectorImpl<char>& object,
             regulus_clang_seconds& seconds) {
  auto start = Clock::now();
  const auto lap = [&start] { return seconds_since(std::exchange(start, Clock::now())); };
  auto invocation = make_invocation(request, files, diagnostics);
  if (!invocation) return false;
  const auto machine = make_target_machine(invocation->getTargetOpts(), diagnostics.stream());
  if (!machine) return false;
  llvm::LLVMContext context;
  const auto module = run_front_end(std::move(invocation), files, diagnostics, context);
  seconds.front_end = lap();
  if (!module || !optimise(*module, *machine, request.passes, diagnostics.stream())) return false;
  seconds.optimiser = lap();
  if (!generate_code(*module, *machine, object, diagnostics.stream())) return false;
  seconds.code_generation = lap();
  return true;
}

}  // namespace

extern "C" [[gnu::visibility("default")]] int regulus_clang_interface(void) {
  return REGULUS_CLANG_INTERFACE;
}

extern "C" [[gnu::visibility("default")]] int regulus_clang_compile(
    const regulus_clang_request* request, const regulus_clang_sink* sink) {
  initialise_llvm();
  const FileSystem files = make_file_system(*request);
  Diagnostics diagnostics(*files);
  llvm::SmallVector<char, 0> object;
  regulus_clang_seconds seconds{};
  const bool done = compile(*request, diagnostics, files, object, seconds);
  if (!diagnostics.text().empty())
    sink->diagnostics(sink->state, {diagnostics.text().data(), diagnostics.text().size()});
  if (!done) return 1;
  sink->seconds(sink->state, seconds);
  sink->object(sink->state, {object.data(), object.size()});
  return 0;
}
