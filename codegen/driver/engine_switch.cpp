// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/engine_switch.hpp"

#include <exception>

namespace regulus::codegen {

void EngineSwitch::on_progress(const Statistics& statistics, std::uint64_t) noexcept {
  if (!switched_) interpreted_boxes_ = statistics.boxes;
  if (looking_) look();
}

/// A compiler that fails is no reason to stop: the interpreter goes on.
void EngineSwitch::look() noexcept try {
  if (auto kernel = compilation_.take()) {
    compiled_.emplace(std::move(*kernel));
    switched_ = kernel_.switch_to(*compiled_->kernel());
    if (!switched_) failure_ = "the compiled kernel is of another shape";
    looking_ = false;
  } else if (!compilation_.failure().empty()) {
    failure_ = compilation_.failure();
    looking_ = false;
  }
} catch (const std::exception&) {
  looking_ = false;
}

}  // namespace regulus::codegen
