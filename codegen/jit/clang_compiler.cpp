// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/clang_compiler.hpp"

#include <dlfcn.h>
#include <sys/stat.h>

#include <cfenv>
#include <chrono>
#include <system_error>
#include <vector>

#include "regulus/codegen/jit/clang_interface.h"

namespace regulus::codegen {
namespace {

constexpr const char* kPluginName = "libregulus-clang.so";

std::filesystem::path find_plugin() {
  std::error_code error;
  const auto executable = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error)
    for (const char* folder : {"../lib/regulus", "../lib"}) {
      const auto candidate = executable.parent_path() / folder / kPluginName;
      if (std::filesystem::exists(candidate, error)) return candidate;
    }
  return REGULUS_CLANG_PLUGIN;
}

/// "PATH SIZE SECONDS.NANOSECONDS", or "PATH absent".
std::string file_identity(const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return file.string() + " absent";
  return file.string() + " " + std::to_string(status.st_size) + " " +
         std::to_string(status.st_mtim.tv_sec) + "." + std::to_string(status.st_mtim.tv_nsec);
}

template <class Function>
Function find_function(void* library, const char* name) {
  void* found = ::dlsym(library, name);
  if (!found) throw CompilerUnavailable(std::string("the compiler plugin has no ") + name);
  return reinterpret_cast<Function>(found);
}

/// The handle is never given back: LLVM cannot be unloaded, and opening it again costs nothing.
regulus_clang_compile_function open_plugin(const std::filesystem::path& plugin) {
  void* library = ::dlopen(plugin.c_str(), RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
  if (!library) {
    const char* reason = ::dlerror();
    throw CompilerUnavailable(std::string("the compiler plugin cannot be opened: ") +
                              (reason ? reason : plugin.string()));
  }
  const auto version =
      find_function<regulus_clang_interface_function>(library, REGULUS_CLANG_INTERFACE_SYMBOL);
  if (version() != REGULUS_CLANG_INTERFACE)
    throw CompilerUnavailable("the compiler plugin belongs to another version: " + plugin.string());
  return find_function<regulus_clang_compile_function>(library, REGULUS_CLANG_COMPILE_SYMBOL);
}

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

/// The default floating-point environment while it lives, whatever the caller or the compiler sets.
class DefaultFloatingPoint {
 public:
  DefaultFloatingPoint() noexcept {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatingPoint() { std::fesetenv(&saved_); }
  DefaultFloatingPoint(const DefaultFloatingPoint&) = delete;
  DefaultFloatingPoint& operator=(const DefaultFloatingPoint&) = delete;

 private:
  std::fenv_t saved_;
};

}  // namespace

ClangCompiler::ClangCompiler()
    : plugin_(find_plugin()),
      identity_("Clang " REGULUS_CLANG_VERSION "; " + file_identity(plugin_) + "; " +
                file_identity(REGULUS_CLANG_LIBRARY) + "; " + file_identity(REGULUS_LLVM_LIBRARY)) {
}

CompiledObject ClangCompiler::compile(const Compilation& compilation) const {
  const DefaultFloatingPoint environment;
  CompiledObject result;
  const auto start = std::chrono::steady_clock::now();
  const regulus_clang_compile_function compile_text = open_plugin(plugin_);
  result.open_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::vector<regulus_named_text> headers;
  for (const NamedText& header : compilation.headers) headers.push_back(named(header));
  std::vector<const char*> flags;
  for (const std::string& flag : compilation.flags) flags.push_back(flag.c_str());
  const regulus_clang_request request{
      named(compilation.source), headers.data(), headers.size(), flags.data(), flags.size(),
      compilation.passes.c_str()};
  const regulus_clang_sink sink = sink_into(result);
  if (compile_text(&request, &sink) != 0) result.object.clear();
  return result;
}

}  // namespace regulus::codegen
