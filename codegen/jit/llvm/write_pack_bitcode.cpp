// SPDX-License-Identifier: GPL-3.0-or-later
// write_pack_bitcode pack_operations.hpp OUTPUT.cpp ISA…: compiles the operations of packs to
// LLVM's bitcode, as a source file with the bytes. Runs when the project is built.
#include <llvm/ADT/SmallVector.h>
#include <llvm/Bitcode/BitcodeWriter.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "codegen/jit/kernel_compilation.hpp"
#include "codegen/jit/llvm/code_generator.hpp"
#include "codegen/jit/llvm/front_end.hpp"

namespace regulus::inline jit::plugin {
namespace {

regulus_named_text named(const NamedText& file) {
  return {{file.name.data(), file.name.size()}, {file.text.data(), file.text.size()}};
}

/// Uses the flags, headers and passes of kernels.
std::string compile_to_bitcode(const std::string& text, Isa isa) {
  const Compilation compilation = kernel_compilation(text, isa);
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
                                      0};

  const FileSystem files = make_file_system(request);
  Diagnostics diagnostics(*files);
  auto invocation = make_invocation(request, files, diagnostics);
  if (!invocation) throw std::runtime_error(diagnostics.text());
  const auto machine =
      make_target_machine(invocation->getTargetOpts().Triple, invocation->getTargetOpts().CPU,
                          features_of(invocation->getTargetOpts()), diagnostics.stream());
  llvm::LLVMContext context;
  const auto module = run_front_end(std::move(invocation), files, diagnostics, context);
  if (!machine || !module || !optimise(*module, *machine, request.passes, diagnostics.stream()))
    throw std::runtime_error(diagnostics.text());
  llvm::SmallVector<char, 0> bitcode;
  llvm::raw_svector_ostream stream(bitcode);
  llvm::WriteBitcodeToFile(*module, stream);
  return {bitcode.data(), bitcode.size()};
}

std::string array_text(const std::string& name, const std::string& bytes) {
  std::string text = "alignas(8) constexpr unsigned char " + name + "[] = {";
  constexpr std::size_t kPerLine = 24;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    text += (i % kPerLine == 0 ? "\n    " : " ") +
            std::to_string(static_cast<unsigned char>(bytes[i])) + ",";
  return text + "\n};\n";
}

std::string source_of(const std::string& operations, const std::vector<std::string>& isas) {
  std::string arrays;
  std::string table;
  for (const std::string& isa : isas) {
    arrays += array_text(isa, compile_to_bitcode(operations, parse_isa(isa).value()));
    table += "    {\"" + isa + "\", " + isa + ", sizeof " + isa + "},\n";
  }
  return "// Written by codegen/jit/llvm/write_pack_bitcode.cpp.\n"
         "#include \"codegen/jit/llvm/pack_bitcode.hpp\"\n\n"
         "namespace regulus::inline jit::plugin {\nnamespace {\n" +
         arrays + "constexpr PackBitcode kAll[] = {\n" + table +
         "};\n}  // namespace\n\n"
         "std::span<const PackBitcode> pack_bitcode() noexcept { return kAll; }\n\n"
         "}  // namespace regulus::jit::plugin\n";
}

int write(const std::string& operations, const std::string& output,
          const std::vector<std::string>& isas) {
  initialise_llvm();
  std::ifstream file(operations);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::ofstream(output) << source_of(text, isas);
  return 0;
}

}  // namespace
}  // namespace regulus::jit::plugin

int main(int count, char** arguments) try {
  if (count < 4) throw std::runtime_error("usage: write_pack_bitcode HEADER OUTPUT ISA...");
  return regulus::plugin::write(arguments[1], arguments[2], {arguments + 3, arguments + count});
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
