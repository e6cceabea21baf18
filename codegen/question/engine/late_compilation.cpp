// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/late_compilation.hpp"

#include <chrono>
#include <exception>

#include "codegen/support/no_signals.hpp"
#include "runtime/kernel/call.hpp"

namespace regulus::detail {
namespace {

constexpr std::chrono::milliseconds kLook{10};

}  // namespace

LateCompilation::LateCompilation(SharedProgram program, std::uint64_t after_boxes,
                                 const CompileOptions& options)
    : program_(std::move(program)), after_boxes_(after_boxes), options_(options) {
  options_.parts = nullptr;
}

LateCompilation::~LateCompilation() {
  if (thread_.joinable()) thread_.join();
}

void LateCompilation::on_progress(const Statistics& statistics, std::uint64_t) noexcept {
  if (started_ || statistics.boxes < after_boxes_) return;
  started_ = true;
  start();
}

void LateCompilation::start() noexcept try {
  const NoSignals no_signals;
  thread_ = std::thread([this] { compile(); });
} catch (const std::exception& error) {
  failure_ = error.what();
}

void LateCompilation::compile() noexcept {
  try {
    kernel_.emplace(detail::compile(*program_, options_));
    static_cast<void>(CheckedKernel(*kernel_->kernel()));  // throws if it cannot be called
    offered_.store(kernel_->kernel(), std::memory_order_release);
  } catch (const std::exception& error) {
    failure_ = error.what();
  }
  done_ = true;
}

bool LateCompilation::wait(const std::atomic<bool>& given_up) {
  while (is_compiling()) {
    if (given_up) return false;
    std::this_thread::sleep_for(kLook);
  }
  return true;
}

}  // namespace regulus::detail
