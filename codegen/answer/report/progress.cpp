// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/support/terminal_width.hpp"

namespace regulus::detail {
namespace {

constexpr std::chrono::milliseconds kPeriod{150};

/// The widths of the bar, without its brackets.
constexpr std::size_t kLongestBar = 24, kShortestBar = 6;

std::size_t columns_of(std::FILE* terminal) { return columns_of_terminal(::fileno(terminal)); }

/// Rewrites the line; the last column stays free, because a full line would wrap.
void rewrite_line(std::FILE* terminal, const std::string& line) {
  std::fprintf(terminal, "\r\033[K%s", line.substr(0, columns_of(terminal) - 1).c_str());
  std::fflush(terminal);
}

/// Returns "[####----] "; nothing if there is no room for it.
std::string bar_of(double part, std::size_t room) {
  if (room < kShortestBar + 3) return "";
  const std::size_t width = std::min(room - 3, kLongestBar);
  const auto full = static_cast<std::size_t>(std::clamp(part, 0.0, 1.0) * double(width));
  return '[' + std::string(full, '#') + std::string(width - full, '-') + "] ";
}

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

std::string describe_progress(const SearchProgress& p, std::size_t columns) {
  const auto rate = static_cast<std::uint64_t>(double(p.boxes) / std::max(p.seconds, 1e-3));
  std::string line =
      fmt::format("{:.2f} % decided, {} boxes, {} waiting, {} boxes/s, {:.1f} s", 100 * p.decided,
                  in_thousands(p.boxes), in_thousands(p.waiting), in_thousands(rate), p.seconds);
  if (std::isfinite(p.time_limit))
    line += fmt::format(", {:.0f} s left", std::max(p.time_limit - p.seconds, 0.0));
  if (!p.workers.empty()) line += ", " + p.workers;
  const std::size_t room = columns > line.size() ? columns - line.size() : 0;
  return (bar_of(p.decided, room) + line).substr(0, columns);
}

void ProgressDisplay::on_start(const Problem&, const Settings& settings) noexcept {
  workers_ = settings.workers;
  time_limit_ = settings.time_limit;
  start_ = last_ = Clock::now();
  decided_ = 0;
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
  const SearchProgress progress{statistics.boxes, frontier,
                                decided_,         seconds(now - start_),
                                time_limit_,      workers_ != nullptr ? workers_->describe() : ""};
  rewrite_line(terminal_, describe_progress(progress, columns_of(terminal_) - 1));
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
  std::string line = fmt::format("{}: {} {}", activity, in_thousands(work), unit);
  if (most != WorkMeter::kNoLimit) line += " of at most " + in_thousands(most);
  rewrite_line(terminal_, line + fmt::format(", {:.1f} s", seconds(now - start_)));
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

}  // namespace regulus::detail
