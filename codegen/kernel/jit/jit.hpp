// SPDX-License-Identifier: GPL-3.0-or-later
// Compiles a kernel's pack program, or its C++ text, to machine code in this process; a cache keeps
// the code between runs. Any number of threads may compile at once.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "codegen/kernel/cpp/emitted_kernel.hpp"
#include "codegen/kernel/jit/cache/object_cache.hpp"
#include "codegen/kernel/jit/cache/part_store.hpp"
#include "codegen/kernel/jit/machine_code.hpp"
#include "runtime/kernel/abi.hpp"
#include "runtime/kernel/isa.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::detail {

struct CompileOptions {
  Isa isa = Isa::kPortable;
  bool use_cache = true;
  std::filesystem::path cache_directory;  ///< empty: default_cache_directory()
  PartStore* parts = nullptr;             ///< known parts of pack programs; new ones are added
};

/// Compiles a text, or takes the object of an earlier run from the cache.
///
/// The text sees only the headers of runtime/kernel. It may call only the elementary functions of
/// runtime/interval/x8.hpp, memcpy, memmove and memset.
///
/// Requires  a processor with options.isa, to run the code.
/// Ensures   a cache that cannot be used, or an entry that is damaged, only costs time.
///           The caller's floating-point environment is kept.
/// Rounding  the flags of regulus/floating_point_flags.hpp, as for ahead-of-time code.
/// Throws    CompileError, std::bad_alloc.
[[nodiscard]] MachineCode compile_text(std::string_view text, const CompileOptions& options);

/// A kernel; it stays in memory as long as one copy of this object lives.
class CompiledKernel {
 public:
  /// Requires  `owner` keeps the kernel.
  CompiledKernel(std::shared_ptr<const void> owner, const regulus_kernel* kernel,
                 CompileReport report) noexcept
      : owner_(std::move(owner)), kernel_(kernel), report_(std::move(report)) {}

  [[nodiscard]] const regulus_kernel* kernel() const noexcept { return kernel_; }
  [[nodiscard]] const CompileReport& report() const noexcept { return report_; }
  [[nodiscard]] std::string_view cache() const noexcept { return name(report_.cache); }
  [[nodiscard]] const std::string& cache_note() const noexcept { return report_.cache_note; }

 private:
  std::shared_ptr<const void> owner_;
  const regulus_kernel* kernel_;
  CompileReport report_;
};

/// Compiles the parts of a pack program that neither options.parts nor the cache has. Each part is
/// kept separately, so that other kernels may use it.
///
/// Requires  a processor with options.isa, to run the code.
/// Ensures   as MachineKernel of the same program, to the bit. A cache that cannot be used, or an
///           entry that is damaged, only costs time. The caller's floating-point
///           environment is kept.
/// Rounding  the flags of regulus/floating_point_flags.hpp, as for ahead-of-time code.
/// Throws    CompileError; std::invalid_argument for a program that find_fault objects to;
///           std::bad_alloc.
[[nodiscard]] CompiledKernel compile_kernel(const machine::PackKernel& program,
                                            const CompileOptions& options);

/// Returns the same if nothing has to be compiled; nullopt otherwise.
///
/// Throws    std::invalid_argument, std::bad_alloc.
[[nodiscard]] std::optional<CompiledKernel> find_cached_kernel(const machine::PackKernel& program,
                                                               const CompileOptions& options);

/// Calls compile_text for an emitted kernel: the reference for the code of its pack program.
///
/// Ensures   kernel() is not null and of this ABI.
/// Throws    CompileError, also if the text does not define such a kernel; std::bad_alloc.
[[nodiscard]] CompiledKernel compile_kernel(const EmittedKernel& emitted,
                                            const CompileOptions& options);

/// Returns a text that changes with the compiler.
[[nodiscard]] std::string compiler_identity();

/// Compiles the pack program of the rounding self-test of runtime/kernel/self_test.hpp and runs it.
///
/// Requires  supported(options.isa).
/// Ensures   nullopt if code compiled with these options rounds outward; otherwise a description of
///           the wrong result.
/// Throws    CompileError, std::bad_alloc.
[[nodiscard]] std::optional<std::string> rounding_self_test(const CompileOptions& options);
/// The same for the C++ text of the self-test, compiled by Clang.
[[nodiscard]] std::optional<std::string> text_rounding_self_test(const CompileOptions& options);

}  // namespace regulus::detail
