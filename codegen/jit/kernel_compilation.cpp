// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/jit/kernel_compilation.hpp"

#include <cstring>

#include "regulus/floating_point_flags.hpp"
#include "runtime/interval/x8.hpp"
#include "runtime/kernel/kernel_headers.hpp"

namespace regulus::inline jit {
namespace {

/// The processor is the oldest x86-64 plus the instruction set's own flags, so that the object does
/// not depend on this machine. With -O1 the front end writes code that passes may change; kPasses
/// alone decides which passes run.
constexpr const char* kFlags[] = {"--target=x86_64-unknown-linux-gnu",
                                  "-std=c++20",
                                  "-O1",
                                  "-w",
                                  "-fPIC",
                                  "-ffreestanding",
                                  "-nostdinc",
                                  "-nostdinc++",
                                  "-fno-exceptions",
                                  "-fno-rtti",
                                  "-fno-asynchronous-unwind-tables",
                                  "-fno-stack-protector",
                                  "-DREGULUS_NO_SYSTEM_HEADERS"};

/// Callees are simplified first and then inlined; the other order takes more than twice as long.
/// Then intervals become registers, and choices with a known sign disappear.
constexpr const char* kPasses = "cgscc(inline,function(sroa,early-cse,instsimplify)),globaldce";

}  // namespace

Compilation kernel_compilation(std::string_view text, Isa isa) {
  Compilation compilation;
  compilation.source = {"kernel.cpp", text};
  compilation.isa = name(isa);
  for (const KernelHeader& header : kernel_headers())
    compilation.headers.push_back({header.path, header.text});
  auto& flags = compilation.flags;
  flags.assign(std::begin(kFlags), std::end(kFlags));
  flags.insert(flags.end(), std::begin(kFloatingPointFlags), std::end(kFloatingPointFlags));
  const auto isa_flags = compile_flags(isa);
  flags.insert(flags.end(), isa_flags.begin(), isa_flags.end());
  compilation.passes = kPasses;
  return compilation;
}

std::vector<ExternalSymbol> kernel_externals() {
  std::vector<ExternalSymbol> externals{{"memcpy", reinterpret_cast<const void*>(&std::memcpy)},
                                        {"memmove", reinterpret_cast<const void*>(&std::memmove)},
                                        {"memset", reinterpret_cast<const void*>(&std::memset)}};
  const regulus_x8_function_table table = regulus_x8_functions();
  for (unsigned i = 0; i < table.count; ++i)
    externals.push_back(
        {table.functions[i].name, reinterpret_cast<const void*>(table.functions[i].address)});
  return externals;
}

}  // namespace regulus::jit
