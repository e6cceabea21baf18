// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/progress.hpp"

#include <unistd.h>

#include <cinttypes>
#include <cmath>
#include <memory>

namespace regulus::codegen {
namespace {

constexpr std::chrono::milliseconds kPeriod{150};

double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

}  // namespace

void ProgressDisplay::on_start(const Problem&, const Settings&) noexcept {
  start_ = last_ = Clock::now();
}

// Every split halves a range, so a leaf at depth d holds 2^-d of the volume.
void ProgressDisplay::on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept {
  if (rule != Rule::kBlocked) decided_ += std::ldexp(1.0, -int(box.depth));
}

void ProgressDisplay::on_progress(const Statistics& statistics, std::uint64_t frontier) noexcept {
  const Clock::time_point now = Clock::now();
  if (now - last_ < kPeriod) return;
  last_ = now;
  shown_ = true;
  const double elapsed = seconds(now - start_);
  std::fprintf(
      terminal_,
      "\r\033[K%" PRIu64 " boxes, %" PRIu64 " waiting, %.2f %% decided, %.3g boxes/s, %.1f s",
      statistics.boxes, frontier, 100 * decided_, double(statistics.boxes) / elapsed, elapsed);
  std::fflush(terminal_);
}

void ProgressDisplay::on_finish(const Result&) noexcept {
  if (shown_) std::fprintf(terminal_, "\r\033[K");
}

FormingDisplay::~FormingDisplay() {
  if (shown_) std::fprintf(terminal_, "\r\033[K");
  std::fflush(terminal_);
}

void FormingDisplay::show(std::uint64_t work, std::uint64_t most) {
  const Clock::time_point now = Clock::now();
  if (now - last_ < kPeriod) return;
  last_ = now;
  shown_ = true;
  std::fprintf(terminal_, "\r\033[Kforming expressions: %" PRIu64 " terms", work);
  if (most != WorkMeter::kNoLimit) std::fprintf(terminal_, " of at most %" PRIu64, most);
  std::fprintf(terminal_, ", %.1f s", seconds(now - start_));
  std::fflush(terminal_);
}

FormingWatch forming_watch(const OutputOptions& output, const std::atomic<bool>* interrupt) {
  FormingWatch watch;
  watch.interrupt = interrupt;
  if (output.quiet || isatty(STDERR_FILENO) == 0) return watch;
  auto display = std::make_shared<FormingDisplay>(stderr);
  watch.progress = [display](std::uint64_t work, std::uint64_t most) { display->show(work, most); };
  return watch;
}

}  // namespace regulus::codegen
