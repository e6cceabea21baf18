// SPDX-License-Identifier: GPL-3.0-or-later
// The in-process C++ compiler: it compiles any text to a relocatable object, with the Clang front
// end and the LLVM code generator, and loads such an object by LLVM's linker.
#include <chrono>
#include <exception>
#include <memory>
#include <new>
#include <string_view>
#include <utility>

#include "codegen/kernel/jit/llvm/code_generator.hpp"
#include "codegen/kernel/jit/llvm/front_end.hpp"
#include "codegen/kernel/jit/llvm/object_linker.hpp"

namespace regulus::detail::plugin {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool compile(const regulus_clang_request& request, Diagnostics& diagnostics,
             const FileSystem& files, llvm::SmallVectorImpl<char>& object,
             regulus_clang_seconds& seconds) {
  auto start = Clock::now();
  const auto lap = [&start] { return seconds_since(std::exchange(start, Clock::now())); };
  auto invocation = make_invocation(request, files, diagnostics);
  if (!invocation) return false;
  const auto machine = make_target_machine(
      invocation->getTargetOpts().Triple, invocation->getTargetOpts().CPU,
      features_of(invocation->getTargetOpts()), diagnostics.stream(), request.optimises_code != 0);
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
}  // namespace regulus::detail::plugin

extern "C" [[gnu::visibility("default")]] int regulus_clang_interface(void) {
  return REGULUS_CLANG_INTERFACE;
}

extern "C" [[gnu::visibility("default")]] int regulus_clang_compile(
    const regulus_clang_request* request, const regulus_clang_sink* sink) try {
  using namespace regulus::detail::plugin;
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
} catch (const std::bad_alloc&) {
  return REGULUS_CLANG_NO_MEMORY;
}

extern "C" [[gnu::visibility("default")]] int regulus_clang_load(regulus_bytes object,
                                                                 const regulus_external* externals,
                                                                 std::size_t external_count,
                                                                 const regulus_clang_sink* sink,
                                                                 regulus_loaded* loaded) try {
  using regulus::detail::plugin::LinkedObject;
  regulus::detail::plugin::initialise_llvm();
  auto linked =
      std::make_unique<LinkedObject>(llvm::StringRef(object.data, object.size),
                                     llvm::ArrayRef<regulus_external>(externals, external_count));
  *loaded = {linked.release(),
             [](void* state, regulus_bytes name, std::size_t size) {
               return static_cast<LinkedObject*>(state)->find({name.data, name.size}, size);
             },
             [](void* state) { delete static_cast<LinkedObject*>(state); }};
  return 0;
} catch (const std::bad_alloc&) {
  return REGULUS_CLANG_NO_MEMORY;
} catch (const std::exception& error) {
  const std::string_view reason = error.what();
  sink->diagnostics(sink->state, {reason.data(), reason.size()});
  return 1;
}
