// SPDX-License-Identifier: GPL-3.0-or-later
// The in-process compiler of emitted kernels: the text is read as the little C++ it is and built
// from the packs' operations, which Clang compiled when the project was built. The text means the
// same here as to a C++ compiler; what is not of that form is left to one (clang_plugin.cpp).
#include <llvm/Bitcode/BitcodeReader.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Verifier.h>
#include <llvm/Support/MemoryBuffer.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

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
  bool done = false;
};

struct Work {
  reader::KernelText kernel;
  reader::Symbols symbols;
  std::vector<reader::Share> shares;
  std::string_view isa;
};

Work read(const regulus_reader_request& request) {
  Work work;
  work.kernel = reader::parse_kernel({request.text.data, request.text.size});
  work.symbols = reader::symbols_of(work.kernel);
  work.isa = {request.isa.data, request.isa.size};
  std::set<std::string_view> known;
  for (std::size_t i = 0; i < request.known_count; ++i)
    known.emplace(request.known[i].data, request.known[i].size);
  work.shares = request.for_others ? share_out_unknown(work.kernel, work.symbols, known)
                                   : share_out(work.kernel);
  return work;
}

Result compile(const Work& work, const reader::Share& share) {
  Result result;
  auto start = std::chrono::steady_clock::now();
  const auto lap = [&start] {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start, now)).count();
  };
  llvm::raw_string_ostream errors(result.diagnostics);
  llvm::LLVMContext context;
  const auto module = packs_of(work.isa, context);
  builder::build_kernel(work.kernel, work.symbols, share, *module);
#ifndef NDEBUG
  if (llvm::verifyModule(*module, &errors)) return result;
#endif
  result.seconds.front_end = lap();
#if LLVM_VERSION_MAJOR >= 21
  const std::string triple = module->getTargetTriple().str();
#else
  const std::string triple = module->getTargetTriple();
#endif
  const auto machine = make_target_machine(triple, "x86-64", "", errors);
  if (!machine || !optimise(*module, *machine, kPasses, errors)) return result;
  result.seconds.optimiser = lap();
  result.done = generate_code(*module, *machine, result.object, errors);
  result.seconds.code_generation = lap();
  return result;
}

/// The shares side by side, each in a thread and an LLVM context of its own. An object refers only
/// to those before it.
std::vector<Result> compile_all(const regulus_reader_request& request) {
  const Work work = read(request);
  std::vector<std::future<Result>> others;
  for (std::size_t i = 0; i + 1 < work.shares.size(); ++i)
    others.push_back(
        std::async(std::launch::async, [&work, i] { return compile(work, work.shares[i]); }));
  Result last = compile(work, work.shares.back());
  std::vector<Result> results;
  for (auto& other : others) results.push_back(other.get());
  results.push_back(std::move(last));
  return results;
}

/// What the slowest took, which is what the caller waited for.
regulus_clang_seconds longest(const std::vector<Result>& results) {
  const auto total = [](const Result& r) {
    return r.seconds.front_end + r.seconds.optimiser + r.seconds.code_generation;
  };
  return std::max_element(results.begin(), results.end(),
                          [total](const auto& a, const auto& b) { return total(a) < total(b); })
      ->seconds;
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
  std::vector<plugin::Result> results;
  std::string diagnostics;
  int outcome = REGULUS_READER_DONE;
  try {
    results = plugin::compile_all(*request);
  } catch (const reader::OutsideSubset& reason) {
    diagnostics = reason.what();
    outcome = REGULUS_READER_OUTSIDE;
  }
  for (const plugin::Result& result : results) {
    diagnostics += result.diagnostics;
    if (!result.done) outcome = REGULUS_READER_FAILED;
  }
  if (!diagnostics.empty())
    sink->diagnostics(sink->state, {diagnostics.data(), diagnostics.size()});
  if (outcome != REGULUS_READER_DONE) return outcome;
  sink->seconds(sink->state, plugin::longest(results));
  for (const plugin::Result& result : results)
    sink->object(sink->state, {result.object.data(), result.object.size()});
  return outcome;
}
