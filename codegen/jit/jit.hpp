// SPDX-License-Identifier: GPL-3.0-or-later
// C++ text of a kernel → machine code in this process, kept in a cache between runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "regulus/codegen/emit/emitted_kernel.hpp"
#include "regulus/codegen/jit/compiled_parts.hpp"
#include "regulus/codegen/jit/machine_code.hpp"
#include "regulus/codegen/jit/object_cache.hpp"
#include "regulus/kernel/abi.hpp"
#include "regulus/kernel/isa.hpp"

namespace regulus::codegen {

struct CompileOptions {
  Isa isa = Isa::kPortable;
  bool use_cache = true;
  std::filesystem::path cache_directory;  ///< empty: default_cache_directory()
  CompiledParts* parts = nullptr;         ///< what need not be compiled again, and gets more
};

/// Compiles a text, or takes what an earlier run made of the same text.
///
/// The text sees the headers of runtime/kernel and no other file, and may call the elementary
/// functions of regulus/interval/x8.hpp, memcpy, memmove and memset, and nothing else.
///
/// Requires  a processor with options.isa, to run what comes out.
/// Ensures   a cache that cannot be used, or an entry that is damaged, costs time and nothing else.
///           The caller's floating-point environment is kept.
/// Rounding  the flags of regulus/floating_point_flags.hpp, as for ahead-of-time code.
/// Throws    CompileError, std::bad_alloc.
[[nodiscard]] MachineCode compile_text(std::string_view text, const CompileOptions& options);

/// What the table of a kernel must be called, and say. An object of another kernel is no use, even
/// one that the cache has under the right key.
struct KernelName {
  std::string symbol;
  std::string identity;  ///< regulus_kernel::identity; empty: that of nothing that was emitted
};
[[nodiscard]] KernelName name_of(const EmittedKernel& emitted);

/// A kernel in memory as long as one copy of this object lives.
class CompiledKernel {
 public:
  [[nodiscard]] const regulus_kernel* kernel() const noexcept { return kernel_; }
  [[nodiscard]] const CompileReport& report() const noexcept { return code_.report(); }
  [[nodiscard]] std::string_view cache() const noexcept { return name(report().cache); }
  [[nodiscard]] const std::string& cache_note() const noexcept { return report().cache_note; }

 private:
  friend CompiledKernel compile_kernel(const EmittedKernel&, const CompileOptions&);
  friend std::optional<CompiledKernel> load_cached_kernel(const ObjectCache&, const std::string&,
                                                          const KernelName&);
  CompiledKernel(MachineCode code, const regulus_kernel* kernel) noexcept
      : code_(std::move(code)), kernel_(kernel) {}

  /// Null unless the code has that kernel, of this ABI.
  [[nodiscard]] static const regulus_kernel* find(const MachineCode& code, const KernelName& name);

  MachineCode code_;
  const regulus_kernel* kernel_;
};

/// compile_text for an emitted kernel.
///
/// Ensures   kernel() is not null and of this ABI.
/// Throws    CompileError, also when the text does not define such a kernel; std::bad_alloc.
[[nodiscard]] CompiledKernel compile_kernel(const EmittedKernel& emitted,
                                            const CompileOptions& options);

/// What the cache calls the object of a kernel.
[[nodiscard]] std::string kernel_object_key(const EmittedKernel& emitted, Isa isa);

/// The kernel that an earlier run compiled, by the key that its report gave; nullopt when the cache
/// has it no longer, or nothing that can be used.
///
/// Requires  the object of that key was compiled for an instruction set that this processor has.
/// Throws    std::bad_alloc.
[[nodiscard]] std::optional<CompiledKernel> load_cached_kernel(const ObjectCache& cache,
                                                               const std::string& key,
                                                               const KernelName& name);

/// Changes when the compiler is exchanged, see ClangCompiler::identity.
[[nodiscard]] std::string compiler_identity();

/// Compiles and runs the rounding self-test of regulus/kernel/self_test.hpp.
///
/// Requires  supported(options.isa).
/// Ensures   nullopt when code compiled with these options rounds outward; otherwise what it
/// computed. Throws    CompileError, std::bad_alloc.
[[nodiscard]] std::optional<std::string> rounding_self_test(const CompileOptions& options);

}  // namespace regulus::codegen
