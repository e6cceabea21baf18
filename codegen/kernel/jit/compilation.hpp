// SPDX-License-Identifier: GPL-3.0-or-later
// All inputs of the compilation of a text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regulus::detail {

struct NamedText {
  std::string_view name;
  std::string_view text;
};

/// Refers to the texts; does not copy them.
struct Compilation {
  NamedText source;
  std::vector<NamedText> headers;  ///< for #include "name"; no other file is found
  std::vector<std::string> flags;  ///< of the clang++ command line
  std::string passes;              ///< optimiser pipeline, in the syntax of `opt -passes=`
  std::string_view isa = {};       ///< the name of the instruction set
  bool optimises_code = false;     ///< registers and order of instructions; not in the cache's key
};

/// Returns the name of the compilation's object in the cache.
///
/// Shape     64 hexadecimal digits.
/// Requires  `compiler` names the version of the compiler.
/// Ensures   two compilations that differ in any text, name, flag or pass, in the compiler or in
///           the version of the kernel ABI have different keys, up to collisions of SHA-256. Each
///           part is preceded by its length, so different lists of parts give different bytes.
[[nodiscard]] std::string object_key(const Compilation& compilation, std::string_view compiler);

}  // namespace regulus::detail
