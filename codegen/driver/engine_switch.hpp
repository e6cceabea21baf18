// SPDX-License-Identifier: GPL-3.0-or-later
// `--engine auto`: the interpreter until the compiler is done.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "regulus/codegen/driver/background_compilation.hpp"
#include "regulus/codegen/driver/loaded_kernel.hpp"
#include "regulus/codegen/driver/switching_kernel.hpp"
#include "regulus/machine/machine_kernel.hpp"
#include "regulus/search/observer.hpp"

namespace regulus::codegen {

/// A kernel that is interpreted at first. After each batch of a search that it observes it looks
/// whether the compiled one is ready, and if so, that one is called from then on.
class EngineSwitch : public LoadedKernel, public Observer {
 public:
  /// See BackgroundCompilation.
  EngineSwitch(const std::shared_ptr<const machine::PackKernel>& program,
               const CompileOptions& options, const std::function<void()>& after)
      : interpreted_(*program, options.isa),
        kernel_(*interpreted_.get()),
        compilation_(program, options, after) {}

  [[nodiscard]] const regulus_kernel& functions() const noexcept override {
    return kernel_.functions();
  }
  void on_progress(const Statistics& statistics, std::uint64_t frontier) noexcept override;

  [[nodiscard]] bool switched() const noexcept { return switched_; }
  /// How many boxes the search had evaluated when it went over to the compiled kernel.
  [[nodiscard]] std::uint64_t interpreted_boxes() const noexcept { return interpreted_boxes_; }
  /// Why there is no compiled kernel; empty if there is or may be one.
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }
  void abandon() noexcept { compilation_.abandon(); }

 private:
  void look() noexcept;

  machine::MachineKernel interpreted_;
  SwitchingKernel kernel_;
  BackgroundCompilation compilation_;
  std::optional<CompiledKernel> compiled_;
  std::string failure_;
  std::uint64_t interpreted_boxes_ = 0;
  bool looking_ = true, switched_ = false;
};

}  // namespace regulus::codegen
