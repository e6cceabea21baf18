// SPDX-License-Identifier: GPL-3.0-or-later
// The texts of the generated files other than the kernel.
#pragma once

#include <string>

#include "codegen/kernel/cpp/kernel_subject.hpp"

namespace regulus::detail {

/// NAME.h: C99 and C++.
[[nodiscard]] std::string c_header(const KernelSubject& subject);

/// NAME.hpp: a class over NAME.h. It includes no C++ header of the runtime, so no code that depends
/// on floating-point flags is compiled into the user's program.
[[nodiscard]] std::string cpp_header(const KernelSubject& subject);

/// NAME.cpp: defines the functions of NAME.h.
[[nodiscard]] std::string dispatch_source(const KernelSubject& subject);

/// NAME_<isa>.cpp.
[[nodiscard]] std::string isa_source(const KernelSubject& subject, Isa isa);

}  // namespace regulus::detail
