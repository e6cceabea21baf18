// SPDX-License-Identifier: GPL-3.0-or-later
// The in-process compiler of pack programs: each part is built from the operations of packs. Clang
// compiled these when the project was built, so all engines use the arithmetic of the same headers.
#include <llvm/Bitcode/BitcodeReader.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Verifier.h>
#include <llvm/Support/MemoryBuffer.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "codegen/kernel/jit/clang_interface.h"
#include "codegen/kernel/jit/llvm/code_generator.hpp"
#include "codegen/kernel/jit/llvm/flat_code.hpp"
#include "codegen/kernel/jit/llvm/pack_bitcode.hpp"
#include "codegen/kernel/jit/llvm/part_builder.hpp"

namespace regulus::detail::plugin {
namespace {

// With fewer parts a second thread costs more than it saves; more threads do not help.
constexpr std::size_t kPartsPerThread = 4;
constexpr std::size_t kMaxThreads = 8;

std::unique_ptr<llvm::Module> packs_of(std::string_view isa, llvm::LLVMContext& context) {
  const std::span<const unsigned char> packs = pack_bitcode(isa);
  if (packs.empty()) throw std::runtime_error("the instruction set has no operations here");
  const llvm::StringRef bytes(reinterpret_cast<const char*>(packs.data()), packs.size());
  auto module = llvm::getLazyBitcodeModule({bytes, "packs"}, context);
  if (!module) throw std::runtime_error(llvm::toString(module.takeError()));
  return std::move(*module);
}

/// Compiles parts one after the other, in a thread and an LLVM context of its own.
class Worker {
 public:
  explicit Worker(std::string_view isa)
      : packs_(packs_of(isa, context_)), operations_(*packs_), machine_(machine_of(*packs_)) {}

  std::string compile(std::string_view bytes) {
    const auto start = Clock::now();
    llvm::Module module("pack", context_);
    module.setDataLayout(packs_->getDataLayout());
    module.setTargetTriple(packs_->getTargetTriple());
    module.setPICLevel(llvm::PICLevel::BigPIC);
    builder::build_part(read_part(bytes), operations_, module);
#ifndef NDEBUG
    std::string errors;
    llvm::raw_string_ostream stream(errors);
    if (llvm::verifyModule(module, &stream)) throw std::runtime_error(errors);
#endif
    const auto built = Clock::now();
    std::string code = generate(module);
    seconds_.front_end += seconds(built - start);
    seconds_.code_generation += seconds(Clock::now() - built);
    return code;
  }

  [[nodiscard]] const regulus_clang_seconds& seconds() const noexcept { return seconds_; }

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds(Clock::duration time) {
    return std::chrono::duration<double>(time).count();
  }

  static std::unique_ptr<llvm::TargetMachine> machine_of(const llvm::Module& packs) {
    std::string errors;
    llvm::raw_string_ostream stream(errors);
#if LLVM_VERSION_MAJOR >= 21
    const std::string triple = packs.getTargetTriple().str();
#else
    const std::string triple = packs.getTargetTriple();
#endif
    auto machine = make_target_machine(triple, "x86-64", "", stream);
    if (!machine) throw std::runtime_error(errors);
    return machine;
  }

  std::string generate(llvm::Module& module) {
    llvm::SmallVector<char, 0> object;
    std::string errors;
    llvm::raw_string_ostream stream(errors);
    if (!generate_code(module, *machine_, object, stream, Repeated::kJoined))
      throw std::runtime_error(errors);
    return flat_code({object.data(), object.size()}, llvm::StringRef(kPartSymbol), kCodeAlignment);
  }

  llvm::LLVMContext context_;
  std::unique_ptr<llvm::Module> packs_;
  builder::Operations operations_;
  std::unique_ptr<llvm::TargetMachine> machine_;
  regulus_clang_seconds seconds_{};
};

struct Result {
  std::vector<std::string> codes;
  regulus_clang_seconds seconds{};
};

/// Which thread compiles a part is random; the code of the part is not.
Result compile_all(const regulus_parts_request& request) {
  Result result;
  result.codes.resize(request.part_count);
  std::atomic<std::size_t> next = 0;
  const std::string_view isa{request.isa.data, request.isa.size};
  const auto work = [&] {
    Worker worker(isa);
    for (std::size_t i = next++; i < request.part_count; i = next++)
      result.codes[i] = worker.compile({request.parts[i].data, request.parts[i].size});
    return worker.seconds();
  };
  const std::size_t useful = 1 + request.part_count / kPartsPerThread;
  const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::future<regulus_clang_seconds>> others;
  try {
    while (others.size() + 1 < std::min({useful, processors, kMaxThreads}))
      others.push_back(std::async(std::launch::async, work));
  } catch (const std::system_error&) {
    // No room for another stack: the threads that there are do it.
  }
  result.seconds = work();
  for (auto& other : others) (void)other.get();
  return result;
}

}  // namespace
}  // namespace regulus::detail::plugin

extern "C" [[gnu::visibility("default")]] int regulus_clang_interface(void) {
  return REGULUS_CLANG_INTERFACE;
}

extern "C" [[gnu::visibility("default")]] int regulus_parts_compile(
    const regulus_parts_request* request, const regulus_clang_sink* sink) try {
  using namespace regulus;
  using namespace regulus::detail;
  plugin::initialise_llvm();
  const plugin::Result result = plugin::compile_all(*request);
  sink->seconds(sink->state, result.seconds);
  for (const std::string& code : result.codes)
    sink->object(sink->state, {code.data(), code.size()});
  return 0;
} catch (const std::bad_alloc&) {
  return REGULUS_CLANG_NO_MEMORY;
} catch (const std::exception& error) {
  const std::string_view reason = error.what();
  sink->diagnostics(sink->state, {reason.data(), reason.size()});
  return 1;
}
