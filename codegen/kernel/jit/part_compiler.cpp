// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/part_compiler.hpp"

#include "codegen/kernel/jit/clang_interface.h"
#include "codegen/kernel/jit/plugin.hpp"

namespace regulus::detail {
namespace {

regulus_bytes bytes_of(std::string_view text) { return {text.data(), text.size()}; }

regulus_clang_sink sink_into(CompiledParts& result) {
  return {&result,
          [](void* state, regulus_bytes code) {
            static_cast<CompiledParts*>(state)->codes.emplace_back(code.data, code.size);
          },
          [](void* state, regulus_bytes diagnostics) {
            static_cast<CompiledParts*>(state)->diagnostics.assign(diagnostics.data,
                                                                   diagnostics.size);
          },
          [](void* state, regulus_clang_seconds seconds) {
            auto& into = *static_cast<CompiledParts*>(state);
            into.front_end_seconds = seconds.front_end;
            into.code_generation_seconds = seconds.code_generation;
          }};
}

}  // namespace

PartCompiler::PartCompiler()
    : plugin_(find_plugin(REGULUS_PACK_PLUGIN)),
      identity_("LLVM " REGULUS_CLANG_VERSION "; " + file_identity(plugin_) + "; " +
                file_identity(REGULUS_LLVM_LIBRARY)) {}

CompiledParts PartCompiler::compile(const std::vector<std::string_view>& parts, Isa isa) const {
  const DefaultFloatingPoint environment;
  CompiledParts result;
  const auto compile_parts = reinterpret_cast<regulus_parts_compile_function>(
      open_plugin(plugin_, REGULUS_PARTS_COMPILE_SYMBOL, result.open_seconds));
  std::vector<regulus_bytes> bytes;
  for (const std::string_view part : parts) bytes.push_back(bytes_of(part));
  const regulus_parts_request request{bytes.data(), bytes.size(), bytes_of(name(isa))};
  const regulus_clang_sink sink = sink_into(result);
  const int code = compile_parts(&request, &sink);
  require_memory(code);
  if (code != 0) result.codes.clear();
  return result;
}

}  // namespace regulus::detail
