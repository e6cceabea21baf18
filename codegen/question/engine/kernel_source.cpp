// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/kernel_source.hpp"

#include "codegen/support/errors.hpp"

namespace regulus::detail {

CompiledKernel compile(const machine::PackKernel& program, const CompileOptions& options) {
  require_sound_rounding(options);
  return compile_kernel(program, options);
}

CompiledKernel compile(const EmittedKernel& text, const CompileOptions& options) {
  require_sound_rounding(text_rounding_self_test(options));
  return compile_kernel(text, options);
}

void require_sound_rounding(const CompileOptions& options) {
  require_sound_rounding(rounding_self_test(options));
}

void require_sound_rounding(const std::optional<std::string>& failure) {
  if (failure) throw InternalError("the rounding self-test failed: " + *failure);
}

}  // namespace regulus::detail
