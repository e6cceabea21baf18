// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/runner/progress.hpp"

#include <fmt/format.h>

namespace regulus::detail::attack {
namespace {

constexpr const char* kEmptyLine = "\r\033[K";
constexpr std::chrono::milliseconds kBetweenLines{250};

}  // namespace

std::string progress_text(const Summary& summary, std::uint64_t total, double seconds) {
  const std::uint64_t done = summary.models();
  std::string text = fmt::format("{} of {} models", done, total);
  if (seconds > 0) text += fmt::format(", {:.1f} a second", static_cast<double>(done) / seconds);
  text += fmt::format(", {} contradictions", summary.count(Judgement::kContradiction));
  const auto add = [&text](std::uint64_t count, const char* what) {
    if (count > 0) text += fmt::format(", {} {}", count, what);
  };
  add(summary.count(Judgement::kCrash), "crashes");
  add(summary.count(Proof::kRejected) + summary.count(Proof::kBroken), "proofs rejected or broken");
  return text;
}

Progress::~Progress() {
  if (shown_) out_ << kEmptyLine << std::flush;
}

void Progress::update(const Summary& summary) {
  const Clock::time_point now = Clock::now();
  if (!shown_ || now < next_) return;
  next_ = now + kBetweenLines;
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  out_ << kEmptyLine << progress_text(summary, total_, seconds) << std::flush;
}

}  // namespace regulus::detail::attack
