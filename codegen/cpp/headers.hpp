// SPDX-License-Identifier: GPL-3.0-or-later
// The texts of the generated files besides the kernel itself.
#pragma once

#include <string>

#include "codegen/cpp/kernel_subject.hpp"

namespace regulus::inline cpp {

/// NAME.h: C99 and C++.
[[nodiscard]] std::string c_header(const KernelSubject& subject);

/// NAME.hpp: a class over NAME.h. None of the runtime's own C++ headers, so that no code that
/// depends on floating-point flags is compiled into who includes it.
[[nodiscard]] std::string cpp_header(const KernelSubject& subject);

/// NAME.cpp: what NAME.h declares.
[[nodiscard]] std::string dispatch_source(const KernelSubject& subject);

/// NAME_<isa>.cpp.
[[nodiscard]] std::string isa_source(const KernelSubject& subject, Isa isa);

}  // namespace regulus::inline cpp
