// SPDX-License-Identifier: GPL-3.0-or-later
// The in-process compiler of emitted kernels: the text is read as the little C++ it is and built
// from the packs' operations, which Clang compiled when the project was built. The text means the
// same here as to a C++ compiler; what is not of that form is left to one (clang_plugin.cpp).
#include <llvm/Bitcode/BitcodeReader.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Verifier.h>
#include <llvm/Support/MemoryBuffer.h>

#include <chrono>
#include <memory>
#include <utility>

#include "regulus/codegen/jit/builder/kernel_builder.hpp"
#include "regulus/codegen/jit/clang_interface.h"
#include "regulus/codegen/jit/plugin/code_generator.hpp"
#include "regulus/codegen/jit/plugin/pack_bitcode.hpp"
#include "regulus/codegen/jit/reader/parser.hpp"

namespace regulus::codegen::plugin {
namespace {

/// Operations that the kernel does not use go; masks of signs that several operations look at are
/// computed once. Neither can merge two roundings: early-cse joins calls that are equal in every
/// argument, the rounding included, and leaves constrained arithmetic of dynamic rounding alone.
constexpr const char* kPasses = "globaldce,function(early-cse)";

std::unique_ptr<llvm::Module> packs_of(std::string_view isa, llvm::LLVMContext& context) {
  for (const PackBitcode& packs : pack_bitcode())
    if (packs.isa == isa) {
      const llvm::StringRef bytes(reinterpret_cast<const char*>(packs.data), packs.size);
      auto module = llvm::parseBitcodeFile({bytes, "packs"}, context);
      if (!module) throw reader::OutsideSubset(llvm::toString(module.takeError()));
      return std::move(*module);
    }
  throw reader::OutsideSubset("the instruction set has no operations here");
}

struct Result {
  llvm::SmallVector<char, 0> object;
  std::string diagnostics;
  regulus_clang_seconds seconds{};
};

bool compile(const regulus_reader_request& request, Result& result) {
  auto start = std::chrono::steady_clock::now();
  const auto lap = [&start] {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start, now)).count();
  };
  llvm::raw_string_ostream errors(result.diagnostics);
  llvm::LLVMContext context;
  const auto kernel = reader::parse_kernel({request.text.data, request.text.size});
  const auto module = packs_of({request.isa.data, request.isa.size}, context);
  builder::build_kernel(kernel, *module);
#ifndef NDEBUG
  if (llvm::verifyModule(*module, &errors)) return false;
#endif
  result.seconds.front_end = lap();
#if LLVM_VERSION_MAJOR >= 21
  const std::string triple = module->getTargetTriple().str();
#else
  const std::string triple = module->getTargetTriple();
#endif
  const auto machine = make_target_machine(triple, "x86-64", "", errors);
  if (!machine || !optimise(*module, *machine, kPasses, errors)) return false;
  result.seconds.optimiser = lap();
  if (!generate_code(*module, *machine, result.object, errors)) return false;
  result.seconds.code_generation = lap();
  return true;
}

}  // namespace
}  // namespace regulus::codegen::plugin

extern "C" [[gnu::visibility("default")]] int regulus_clang_interface(void) {
  return REGULUS_CLANG_INTERFACE;
}

extern "C" [[gnu::visibility("default")]] int regulus_reader_compile(
    const regulus_reader_request* request, const regulus_clang_sink* sink) {
  using namespace regulus::codegen;
  plugin::initialise_llvm();
  plugin::Result result;
  int outcome = REGULUS_READER_DONE;
  try {
    if (!plugin::compile(*request, result)) outcome = REGULUS_READER_FAILED;
  } catch (const reader::OutsideSubset& reason) {
    result.diagnostics = reason.what();
    outcome = REGULUS_READER_OUTSIDE;
  }
  if (!result.diagnostics.empty())
    sink->diagnostics(sink->state, {result.diagnostics.data(), result.diagnostics.size()});
  if (outcome != REGULUS_READER_DONE) return outcome;
  sink->seconds(sink->state, result.seconds);
  sink->object(sink->state, {result.object.data(), result.object.size()});
  return outcome;
}
