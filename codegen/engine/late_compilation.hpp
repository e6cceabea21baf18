// SPDX-License-Identifier: GPL-3.0-or-later
// `--engine auto` where the cache has no compiled kernel: the search interprets, and a long one is
// worth a compiler.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <thread>

#include "codegen/engine/kernel_source.hpp"
#include "runtime/problem/observer.hpp"

namespace regulus::inline engine {

/// Compiles a kernel in a thread of its own once the search that it observes has evaluated a
/// number of boxes, and offers it to the search as Problem::faster_kernel.
///
/// Whether it compiles depends on the question alone. When the compiled kernel takes over depends
/// on the time that the compiler needs, and nothing but time depends on that: it computes the same
/// bits as the interpreter. A compiler that fails leaves the search with the interpreter.
///
/// The thread blocks every signal, so that they go to whoever waits for them.
class LateCompilation : public Observer {
 public:
  /// `after_boxes` ≥ 1. options.parts is left alone: it is for one thread.
  LateCompilation(SharedProgram program, std::uint64_t after_boxes, const CompileOptions& options);
  /// Waits for the compiler.
  ~LateCompilation() override;

  void on_progress(const Statistics& statistics, std::uint64_t frontier) noexcept override;

  [[nodiscard]] std::uint64_t after_boxes() const noexcept { return after_boxes_; }
  /// Null until the kernel is compiled. It lives as long as this.
  [[nodiscard]] const std::atomic<const regulus_kernel*>& kernel() const noexcept {
    return offered_;
  }
  /// True while the compiler is at work.
  [[nodiscard]] bool is_compiling() const noexcept { return thread_.joinable() && !done_; }

  /// Waits until the compiler is done or `given_up` is true.
  ///
  /// Ensures   false if it is still at work.
  [[nodiscard]] bool wait(const std::atomic<bool>& given_up);
  /// Why there is no kernel though the compiler was asked for one; empty if that is not so.
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
  std::optional<CompiledKernel> kernel_;  ///< the thread's until done_
  std::string failure_;                   ///< the same
  std::thread thread_;
};

}  // namespace regulus::inline engine
