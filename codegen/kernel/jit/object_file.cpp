// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/object_file.hpp"

#include "codegen/kernel/jit/clang_compiler.hpp"
#include "codegen/kernel/jit/kernel_compilation.hpp"
#include "codegen/kernel/jit/plugin.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/kernel/self_test.hpp"

namespace regulus::detail {

std::string compile_object_file(NamedText source, const std::vector<NamedText>& headers, Isa isa) {
  Compilation compilation = kernel_compilation(source.text, isa);
  compilation.source = source;
  compilation.headers.push_back({"runtime/kernel/self_test_program.hpp", kSelfTestSource});
  compilation.headers.insert(compilation.headers.end(), headers.begin(), headers.end());
  // The portable packs are large functions of small steps: it would take longer and gain nothing.
  compilation.optimises_code = isa != Isa::kPortable;
  try {
    CompiledObject compiled = ClangCompiler().compile(compilation);
    if (!compiled.object.empty()) return std::move(compiled.object);
    throw CompileError(std::string(source.name) + " does not compile:\n" + compiled.diagnostics,
                       compiled.diagnostics, std::string(source.text));
  } catch (const CompilerUnavailable& error) {
    throw NoCompiler(error.what());
  }
}

}  // namespace regulus::detail
