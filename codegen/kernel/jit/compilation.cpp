// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/compilation.hpp"

#include "codegen/kernel/jit/cache/key_parts.hpp"
#include "runtime/kernel/abi.hpp"

namespace regulus::detail {
namespace {

/// Increase it if the loader begins to need something that older objects lack.
constexpr int kLoaderVersion = 1;

void add(KeyParts& parts, const NamedText& file) {
  parts.add(file.name);
  parts.add(file.text);
}

}  // namespace

std::string object_key(const Compilation& compilation, std::string_view compiler) {
  KeyParts parts;
  parts.add(kLoaderVersion);
  parts.add(REGULUS_KERNEL_ABI);
  parts.add(compiler);
  parts.add(compilation.isa);
  parts.add(compilation.passes);
  parts.add(compilation.flags);
  parts.begin_list(compilation.headers.size());
  for (const NamedText& header : compilation.headers) add(parts, header);
  add(parts, compilation.source);
  return parts.key();
}

}  // namespace regulus::detail
