// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/words.hpp"

#include <algorithm>
#include <array>

#include "codegen/kernel/cpp/names.hpp"

namespace regulus::detail {
namespace {

/// Keywords of C23 and C++20, alternative tokens, and macros of the standard headers and of
/// compilers that could be names in a model. Sorted.
constexpr std::array<std::string_view, 127> kTaken = {"BUFSIZ",
                                                      "DOMAIN",
                                                      "EOF",
                                                      "FILE",
                                                      "HUGE",
                                                      "I",
                                                      "INFINITY",
                                                      "NAN",
                                                      "NULL",
                                                      "OVERFLOW",
                                                      "PLOSS",
                                                      "SING",
                                                      "TLOSS",
                                                      "UNDERFLOW",
                                                      "alignas",
                                                      "alignof",
                                                      "and",
                                                      "and_eq",
                                                      "asm",
                                                      "assert",
                                                      "auto",
                                                      "bitand",
                                                      "bitor",
                                                      "bool",
                                                      "break",
                                                      "case",
                                                      "catch",
                                                      "char",
                                                      "char16_t",
                                                      "char32_t",
                                                      "char8_t",
                                                      "class",
                                                      "co_await",
                                                      "co_return",
                                                      "co_yield",
                                                      "compl",
                                                      "complex",
                                                      "concept",
                                                      "const",
                                                      "const_cast",
                                                      "consteval",
                                                      "constexpr",
                                                      "constinit",
                                                      "continue",
                                                      "decltype",
                                                      "default",
                                                      "delete",
                                                      "do",
                                                      "double",
                                                      "dynamic_cast",
                                                      "else",
                                                      "enum",
                                                      "errno",
                                                      "explicit",
                                                      "export",
                                                      "extern",
                                                      "false",
                                                      "float",
                                                      "for",
                                                      "fortran",
                                                      "friend",
                                                      "goto",
                                                      "i386",
                                                      "if",
                                                      "imaginary",
                                                      "inline",
                                                      "int",
                                                      "linux",
                                                      "long",
                                                      "main",
                                                      "mutable",
                                                      "namespace",
                                                      "new",
                                                      "noexcept",
                                                      "not",
                                                      "not_eq",
                                                      "nullptr",
                                                      "operator",
                                                      "or",
                                                      "or_eq",
                                                      "private",
                                                      "protected",
                                                      "public",
                                                      "register",
                                                      "reinterpret_cast",
                                                      "requires",
                                                      "restrict",
                                                      "return",
                                                      "setjmp",
                                                      "short",
                                                      "signed",
                                                      "sizeof",
                                                      "static",
                                                      "static_assert",
                                                      "static_cast",
                                                      "std",
                                                      "stderr",
                                                      "stdin",
                                                      "stdout",
                                                      "struct",
                                                      "switch",
                                                      "template",
                                                      "this",
                                                      "thread_local",
                                                      "throw",
                                                      "true",
                                                      "try",
                                                      "typedef",
                                                      "typeid",
                                                      "typename",
                                                      "typeof",
                                                      "typeof_unqual",
                                                      "union",
                                                      "unix",
                                                      "unsigned",
                                                      "using",
                                                      "va_arg",
                                                      "va_copy",
                                                      "va_end",
                                                      "va_start",
                                                      "virtual",
                                                      "void",
                                                      "volatile",
                                                      "wchar_t",
                                                      "while",
                                                      "xor",
                                                      "xor_eq"};

static_assert(std::is_sorted(kTaken.begin(), kTaken.end()));

bool is_taken(std::string_view text) {
  return std::binary_search(kTaken.begin(), kTaken.end(), text);
}

}  // namespace

bool is_free_name(std::string_view text) {
  return is_identifier(text) && text.front() != '_' && text.find("__") == std::string_view::npos &&
         !is_taken(text);
}

std::string free_name(std::string_view text) {
  std::string name = identifier_part(text);
  if (!is_identifier(name)) name = "x" + name;
  return is_taken(name) ? name + "_" : name;
}

}  // namespace regulus::detail
