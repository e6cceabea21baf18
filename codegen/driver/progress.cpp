// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/progress.hpp"

#include <cinttypes>
#include <cmath>

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

}  // namespace regulus::codegen
