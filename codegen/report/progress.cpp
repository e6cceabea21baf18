// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/report/progress.hpp"

#include <unistd.h>

#include <cinttypes>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace regulus::inline report {
namespace {

constexpr std::chrono::milliseconds kPeriod{150};

double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

/// Returns the names of a stage's work and of its count.
std::pair<const char*, const char*> words_of(WorkStage stage) {
  switch (stage) {
    case WorkStage::kSubstitution:
      return {"reading expressions", "nodes"};
    case WorkStage::kForming:
      return {"forming expressions", "terms"};
    case WorkStage::kLowering:
      return {"lowering expressions to programs", "nodes"};
    case WorkStage::kSelection:
      return {"selecting operations", "steps"};
  }
  return {"", ""};
}

}  // namespace

void ProgressDisplay::on_start(const Problem&, const Settings& settings) noexcept {
  workers_ = settings.workers;
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
  const std::string workers = workers_ != nullptr ? workers_->describe() : "";
  if (!workers.empty()) std::fprintf(terminal_, ", %s", workers.c_str());
  std::fflush(terminal_);
}

void ProgressDisplay::on_finish(const Result&) noexcept {
  if (shown_) std::fprintf(terminal_, "\r\033[K");
}

SearchDisplay::SearchDisplay(const OutputOptions& output) {
  if (!output.quiet && isatty(STDERR_FILENO) != 0) display_.emplace(stderr);
}

FormingDisplay::~FormingDisplay() {
  if (shown_) std::fprintf(terminal_, "\r\033[K");
  std::fflush(terminal_);
}

void FormingDisplay::show(WorkStage stage, std::uint64_t work, std::uint64_t most) {
  const Clock::time_point now = Clock::now();
  if (now - last_ < kPeriod) return;
  last_ = now;
  shown_ = true;
  const auto [activity, unit] = words_of(stage);
  std::fprintf(terminal_, "\r\033[K%s: %" PRIu64 " %s", activity, work, unit);
  if (most != WorkMeter::kNoLimit) std::fprintf(terminal_, " of at most %" PRIu64, most);
  std::fprintf(terminal_, ", %.1f s", seconds(now - start_));
  std::fflush(terminal_);
}

FormingWatch forming_watch(const OutputOptions& output, const std::atomic<bool>* interrupt) {
  FormingWatch watch;
  watch.interrupt = interrupt;
  if (output.quiet || isatty(STDERR_FILENO) == 0) return watch;
  auto display = std::make_shared<FormingDisplay>(stderr);
  watch.progress = [display](WorkStage stage, std::uint64_t work, std::uint64_t most) {
    display->show(stage, work, most);
  };
  return watch;
}

}  // namespace regulus::report
