// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/kernel_compilation.hpp"

#include <cstring>

#include "regulus/floating_point_flags.hpp"
#include "regulus/text_flags.hpp"
#include "runtime/interval/x8.hpp"
#include "runtime/kernel/kernel_headers.hpp"

namespace regulus::detail {
Compilation kernel_compilation(std::string_view text, Isa isa) {
  Compilation compilation;
  compilation.source = {"kernel.cpp", text};
  compilation.isa = name(isa);
  for (const KernelHeader& header : kernel_headers())
    compilation.headers.push_back({header.path, header.text});
  auto& flags = compilation.flags;
  flags.assign(std::begin(kTextFlags), std::end(kTextFlags));
  flags.insert(flags.end(), std::begin(kFloatingPointFlags), std::end(kFloatingPointFlags));
  const auto isa_flags = compile_flags(isa);
  flags.insert(flags.end(), isa_flags.begin(), isa_flags.end());
  compilation.passes = kTextPasses;
  return compilation;
}

std::vector<regulus_external> kernel_externals() {
  std::vector<regulus_external> externals{{"memcpy", reinterpret_cast<const void*>(&std::memcpy)},
                                          {"memmove", reinterpret_cast<const void*>(&std::memmove)},
                                          {"memset", reinterpret_cast<const void*>(&std::memset)}};
  const regulus_x8_function_table table = regulus_x8_functions();
  for (unsigned i = 0; i < table.count; ++i)
    externals.push_back(
        {table.functions[i].name, reinterpret_cast<const void*>(table.functions[i].address)});
  return externals;
}

}  // namespace regulus::detail
