// SPDX-License-Identifier: GPL-3.0-or-later
// `--engine auto` without a compiled kernel in the cache: the search interprets, and for a long
// search the kernel is compiled.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <thread>

#include "codegen/question/engine/kernel_source.hpp"
#include "runtime/problem/observer.hpp"

namespace regulus::detail {

/// Compiles a kernel in a separate thread after the observed search has evaluated a number of
/// boxes, and offers it to the search as Problem::faster_kernel.
///
/// Only the question decides whether it compiles. The time of the compiler decides when the search
/// changes to the compiled kernel; this affects only the running time, because the kernel computes
/// the same bits as the interpreter. If the compiler fails, the search continues with the
/// interpreter.
///
/// The thread blocks every signal, so that other threads receive them.
class LateCompilation : public Observer {
 public:
  /// `after_boxes` ≥ 1. It does not use options.parts, which are for one thread.
  LateCompilation(SharedProgram program, std::uint64_t after_boxes, const CompileOptions& options);
  /// Waits for the compiler.
  ~LateCompilation() override;

  void on_progress(const Statistics& statistics, std::uint64_t frontier) noexcept override;

  [[nodiscard]] std::uint64_t after_boxes() const noexcept { return after_boxes_; }
  /// Null until the kernel is compiled. It lives as long as this object.
  [[nodiscard]] const std::atomic<const regulus_kernel*>& kernel() const noexcept {
    return offered_;
  }
  /// True while the compiler is at work.
  [[nodiscard]] bool is_compiling() const noexcept { return thread_.joinable() && !done_; }

  /// Waits until the compiler is done or `given_up` is true.
  ///
  /// Ensures   false if it is still at work.
  [[nodiscard]] bool wait(const std::atomic<bool>& given_up);
  /// Returns the reason why a requested compilation gave no kernel; otherwise empty.
  ///
  /// Requires  !is_compiling().
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }

 private:
  void start() noexcept;
  void compile() noexcept;

  const SharedProgram program_;
  const std::uint64_t after_boxes_;
  CompileOptions options_;
  bool started_ = false;
  std::atomic<bool> done_ = false;
  std::atomic<const regulus_kernel*> offered_ = nullptr;
  std::optional<CompiledKernel> kernel_;  ///< only for the thread until done_
  std::string failure_;                   ///< the same
  std::thread thread_;
};

}  // namespace regulus::detail
