// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/clang_compiler.hpp"

#include <dlfcn.h>
#include <sys/auxv.h>
#include <sys/stat.h>

#include <cfenv>
#include <chrono>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "regulus/codegen/jit/clang_interface.h"
#include "regulus/codegen/jit/object_bundle.hpp"
#include "regulus/codegen/jit/plugin_folder.h"

namespace regulus::codegen {
namespace {

namespace fs = std::filesystem;

/// Where /proc is not mounted, by the name the program was started with, links followed.
fs::path folder_of_executable() {
  std::error_code error;
  fs::path executable = fs::read_symlink("/proc/self/exe", error);
  const auto* started = reinterpret_cast<const char*>(::getauxval(AT_EXECFN));
  if (error && started) executable = fs::canonical(started, error);
  return error ? fs::path() : executable.parent_path();
}

/// The folders that may hold plugins: the one the environment names, then beside the executable as
/// it is installed and as it is built, then the one that a program linked with this library says.
std::vector<fs::path> plugin_folders() {
  std::vector<fs::path> folders;
  if (const char* named = std::getenv("REGULUS_PLUGINS"); named && *named)
    folders.emplace_back(named);
  if (const fs::path folder = folder_of_executable(); !folder.empty()) {
    folders.push_back(folder / "../lib/regulus/plugins");
    folders.push_back(folder / "../lib");
  }
  if (const std::string linked = regulus_plugin_folder(); !linked.empty())
    folders.emplace_back(linked);
  return folders;
}

/// Where there is none, what to say that is missing.
fs::path find_plugin(const char* file) {
  std::error_code error;
  for (const fs::path& folder : plugin_folders())
    if (fs::exists(folder / file, error)) return folder / file;
  return file;
}

template <class Function>
Function find_function(void* library, const char* name) {
  void* found = ::dlsym(library, name);
  if (!found) throw CompilerUnavailable(std::string("the compiler plugin has no ") + name);
  return reinterpret_cast<Function>(found);
}

/// The handle is never given back: LLVM cannot be unloaded, and opening it again costs nothing.
template <class Function>
Function open_plugin(const std::filesystem::path& plugin, const char* symbol) {
  void* library = ::dlopen(plugin.c_str(), RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
  if (!library) {
    const char* reason = ::dlerror();
    throw CompilerUnavailable(std::string("the compiler plugin cannot be opened: ") +
                              (reason ? reason : plugin.string()) +
                              " (REGULUS_PLUGINS names the folder it is in)");
  }
  const auto version =
      find_function<regulus_clang_interface_function>(library, REGULUS_CLANG_INTERFACE_SYMBOL);
  if (version() != REGULUS_CLANG_INTERFACE)
    throw CompilerUnavailable("the compiler plugin belongs to another version: " + plugin.string());
  return find_function<Function>(library, symbol);
}

/// The plugin's function, and how long it took to have it.
template <class Function>
Function open(const std::filesystem::path& plugin, const char* symbol, double& seconds) {
  const auto start = std::chrono::steady_clock::now();
  const auto function = open_plugin<Function>(plugin, symbol);
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return function;
}

regulus_bytes bytes_of(std::string_view text) { return {text.data(), text.size()}; }
regulus_named_text named(const NamedText& file) {
  return {bytes_of(file.name), bytes_of(file.text)};
}

regulus_clang_sink sink_into(CompiledObject& result) {
  return {&result,
          [](void* state, regulus_bytes object) {
            add_to_bundle(static_cast<CompiledObject*>(state)->object, {object.data, object.size});
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

std::string file_identity(const std::filesystem::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return file.string() + " absent";
  return file.string() + " " + std::to_string(status.st_size) + " " +
         std::to_string(status.st_mtim.tv_sec) + "." + std::to_string(status.st_mtim.tv_nsec);
}

ClangCompiler::ClangCompiler()
    : reader_(find_plugin(REGULUS_READER_PLUGIN)),
      plugin_(find_plugin(REGULUS_CLANG_PLUGIN)),
      identity_("Clang " REGULUS_CLANG_VERSION "; " + file_identity(reader_) + "; " +
                file_identity(plugin_) + "; " + file_identity(REGULUS_CLANG_LIBRARY) + "; " +
                file_identity(REGULUS_LLVM_LIBRARY)) {}

CompiledObject ClangCompiler::compile(const Compilation& compilation,
                                      const CompiledParts* parts) const {
  CompiledObject result = read(compilation, parts);
  if (result.not_read.empty()) return result;
  CompiledObject compiled = compile_any(compilation);
  compiled.not_read = std::move(result.not_read);
  compiled.open_seconds += result.open_seconds;
  return compiled;
}

CompiledObject ClangCompiler::read(const Compilation& compilation,
                                   const CompiledParts* parts) const {
  const DefaultFloatingPoint environment;
  CompiledObject result;
  const auto compile_kernel = open<regulus_reader_compile_function>(
      reader_, REGULUS_READER_COMPILE_SYMBOL, result.open_seconds);
  std::vector<regulus_bytes> known;
  if (parts)
    for (const std::string_view symbol : parts->symbols()) known.push_back(bytes_of(symbol));
  const regulus_reader_request request{bytes_of(compilation.source.text), bytes_of(compilation.isa),
                                       parts != nullptr, known.data(), known.size()};
  const regulus_clang_sink sink = sink_into(result);
  const int outcome = compile_kernel(&request, &sink);
  if (outcome != REGULUS_READER_DONE) result.object.clear();
  if (outcome == REGULUS_READER_OUTSIDE) result.not_read = std::move(result.diagnostics);
  return result;
}

CompiledObject ClangCompiler::compile_any(const Compilation& compilation) const {
  const DefaultFloatingPoint environment;
  CompiledObject result;
  const auto compile_text = open<regulus_clang_compile_function>(
      plugin_, REGULUS_CLANG_COMPILE_SYMBOL, result.open_seconds);
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
