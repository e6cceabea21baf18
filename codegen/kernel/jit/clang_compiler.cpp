// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/clang_compiler.hpp"

#include <vector>

#include "codegen/kernel/jit/clang_interface.h"
#include "codegen/kernel/jit/kernel_compilation.hpp"
#include "codegen/kernel/jit/load_error.hpp"
#include "codegen/kernel/jit/plugin.hpp"

namespace regulus::detail {
namespace {

regulus_bytes bytes_of(std::string_view text) { return {text.data(), text.size()}; }
regulus_named_text named(const NamedText& file) {
  return {bytes_of(file.name), bytes_of(file.text)};
}

regulus_clang_sink sink_into(CompiledObject& result) {
  return {&result,
          [](void* state, regulus_bytes object) {
            static_cast<CompiledObject*>(state)->object.assign(object.data, object.size);
          },
          [](void* state, regulus_bytes diagnostics) {
            static_cast<CompiledObject*>(state)->diagnostics.assign(diagnostics.data,
                                                                    diagnostics.size);
          },
          [](void* state, regulus_clang_seconds seconds) {
            auto& into = *static_cast<CompiledObject*>(state);
            into.front_end_seconds = seconds.front_end;
            into.optimiser_seconds = seconds.optimiser;
            into.code_generation_seconds = seconds.code_generation;
          }};
}

}  // namespace

ClangCompiler::ClangCompiler()
    : plugin_(find_plugin(REGULUS_CLANG_PLUGIN)),
      identity_("Clang " REGULUS_CLANG_VERSION "; " + file_identity(plugin_) + "; " +
                file_identity(REGULUS_CLANG_LIBRARY) + "; " + file_identity(REGULUS_LLVM_LIBRARY)) {
}

CompiledObject ClangCompiler::compile(const Compilation& compilation) const {
  const DefaultFloatingPoint environment;
  CompiledObject result;
  const auto compile_text = reinterpret_cast<regulus_clang_compile_function>(
      open_plugin(plugin_, REGULUS_CLANG_COMPILE_SYMBOL, result.open_seconds));
  std::vector<regulus_named_text> headers;
  for (const NamedText& header : compilation.headers) headers.push_back(named(header));
  std::vector<const char*> flags;
  for (const std::string& flag : compilation.flags) flags.push_back(flag.c_str());
  const regulus_clang_request request{named(compilation.source),
                                      headers.data(),
                                      headers.size(),
                                      flags.data(),
                                      flags.size(),
                                      compilation.passes.c_str(),
                                      compilation.optimises_code ? 1 : 0};
  const regulus_clang_sink sink = sink_into(result);
  const int code = compile_text(&request, &sink);
  require_memory(code);
  if (code != 0) result.object.clear();
  return result;
}

LoadedText ClangCompiler::load(std::string_view object) const {
  const DefaultFloatingPoint environment;
  CompiledObject result;
  const auto load_object = reinterpret_cast<regulus_clang_load_function>(
      open_plugin(plugin_, REGULUS_CLANG_LOAD_SYMBOL, result.open_seconds));
  const std::vector<regulus_external> externals = kernel_externals();
  const regulus_clang_sink sink = sink_into(result);
  regulus_loaded loaded{};
  const int code =
      load_object(bytes_of(object), externals.data(), externals.size(), &sink, &loaded);
  require_memory(code);
  if (code != 0) throw LoadError(result.diagnostics);
  return LoadedText(loaded);
}

}  // namespace regulus::detail
