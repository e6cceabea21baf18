// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/condition_judge.hpp"

#include <algorithm>
#include <atomic>
#include <new>
#include <thread>

#include "runtime/interval/floating_point_scope.hpp"

namespace regulus {

BoxJudges::BoxJudges(const ConditionQuestion& question, unsigned threads, std::size_t most,
                     const BoxSharing& sharing)
    : shared_(question, sharing) {
  const auto needed = unsigned(std::max<std::size_t>(most / kLanes, 1));
  for (unsigned t = 0; t < std::clamp(threads, 1U, needed); ++t)
    judges_.push_back(std::make_unique<BoxJudge>(question));
}

bool BoxJudges::judge(std::span<const Box> boxes, std::span<BoxFinding> findings,
                      double attained) try {
  return shared_.judge(boxes, findings, attained) || judge_here(boxes, findings, attained);
} catch (const std::bad_alloc&) {
  return false;
}

bool BoxJudges::judge_here(std::span<const Box> boxes, std::span<BoxFinding> findings,
                           double attained) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> is_out_of_memory = false;
  const auto work = [&](BoxJudge& judge) noexcept {
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    for (std::size_t at; (at = kLanes * next++) < boxes.size();) {
      const std::size_t count = std::min(kLanes, boxes.size() - at);
      try {
        judge.judge(boxes.subspan(at, count), findings.subspan(at, count), attained);
      } catch (const std::bad_alloc&) {
        is_out_of_memory = true;
      }
    }
  };
  const std::size_t batches = (boxes.size() + kLanes - 1) / kLanes;
  {
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < std::min(judges_.size(), batches); ++t)
      others.emplace_back([&work, this, t] { work(*judges_[t]); });
    work(*judges_.front());
  }
  return !is_out_of_memory;
}

}  // namespace regulus
