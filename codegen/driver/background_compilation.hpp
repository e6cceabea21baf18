// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "regulus/codegen/jit/file_descriptor.hpp"
#include "regulus/codegen/jit/jit.hpp"

namespace regulus::codegen {

/// A kernel that is compiled by another process while this one goes on with what it has.
///
/// A process and not a thread: this one may then end at any moment, whatever the compiler is doing,
/// its libraries stay out of this one's memory, and the cache gets the kernel even if the answer is
/// found first. The other one then ends by itself; but only one at a time may outlive its search,
/// or a script that asks one short question after the other would fill the machine with compilers.
class BackgroundCompilation {
 public:
  /// `after` runs in the other process, once the cache has all parts.
  ///
  /// Requires  every other thread of this process is known to hold no lock at this moment, of
  /// malloc,
  ///           of the loader or of its own: it stays locked in the fork for ever. In the command
  ///           these are the watcher of signals, which waits for one, and the workers of a search
  ///           that is over, which wait for work. A program that calls check() may have others:
  ///           SearchOptions::may_fork is false there. Also options.use_cache, and a cache that can
  ///           be used.
  /// Ensures   the other process takes the signals that end a process, whatever this one does with
  ///           them.
  /// Throws    NoCompiler when the system has no process for it.
  BackgroundCompilation(std::shared_ptr<const machine::PackKernel> program,
                        const CompileOptions& options, const std::function<void()>& after);
  BackgroundCompilation(const BackgroundCompilation&) = delete;
  BackgroundCompilation& operator=(const BackgroundCompilation&) = delete;
  /// Does not wait. The other process goes on unless another such is under way for this cache.
  ~BackgroundCompilation();

  /// The kernel, the first time that it is asked for and ready; nullopt before, and if it failed.
  [[nodiscard]] std::optional<CompiledKernel> take();
  /// Why there will be no kernel; empty if there may be one.
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }
  /// Ends the other process, whatever it has done.
  void abandon() noexcept;

 private:
  [[nodiscard]] bool answered();

  std::shared_ptr<const machine::PackKernel> program_;
  CompileOptions options_;
  FileDescriptor answer_;
  /// Of the cache directory, opened before the fork and so held by both: a lock that this process
  /// takes lasts until the other one ends.
  FileDescriptor lock_;
  pid_t process_ = -1;
  std::string text_;
  std::string failure_;
};

}  // namespace regulus::codegen
