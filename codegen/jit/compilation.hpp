// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that decides what object a text becomes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regulus::inline jit {

struct NamedText {
  std::string_view name;
  std::string_view text;
};

/// The texts are referred to, not copied.
struct Compilation {
  NamedText source;
  std::vector<NamedText> headers;  ///< found by #include "name"; nothing else is
  std::vector<std::string> flags;  ///< of the clang++ command line
  std::string passes;              ///< optimiser pipeline, in the syntax of `opt -passes=`
  std::string_view isa = {};       ///< the name of the instruction set
};

/// The name of the compilation's object in the cache.
///
/// Shape     64 hexadecimal digits.
/// Requires  `compiler` names the version of the compiler.
/// Ensures   two compilations that differ in any text, name, flag or pass, in the compiler or in
/// the
///           version of the kernel ABI have different keys, up to collisions of SHA-256. Each part
///           is preceded by its length, so that no two lists of parts read the same.
[[nodiscard]] std::string object_key(const Compilation& compilation, std::string_view compiler);

}  // namespace regulus::inline jit
