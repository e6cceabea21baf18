// SPDX-License-Identifier: Apache-2.0
// Judges boxes in several threads, and many boxes at once by workers, too.
//
// A judge says what is true of a box, for one question. Its findings depend on the box and, if the
// question has one, on the horizon alone: a number ≥ 0 that says what is of no use any more. So a
// search has the same boxes whoever judges them. A type of judges has
//
//     Question      what judges need; its parts outlive them; `.problem`: with the kernel;
//                   `.settings`: if judges have any
//     Finding       what a judge says; one that is new says nothing
//     static size_t intervals(const Question&)
//                   of a box, if they are not the variables of the problem alone
//     Judge(const Question&)
//     void judge(span<const Box>, span<Finding>, double horizon)
//                   about at most kLanes boxes; MXCSR is at nearest
//     static void put(ByteWriter&, const Finding&)
//     static Finding take(ByteReader&, const Question&)      throws MalformedMessage
//     static double& bound(Finding&)
//                   if there is one: a bound over the box, which holds over each part of it, too
//     static void inherit(Finding& own, Finding& above)
//                   if there is more that a part of the box has: own may lack it
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/interval/lanes.hpp"
#include "runtime/search/shared_boxes.hpp"

namespace regulus::detail {

/// Judges units for another thread or process. It may be called with any rounding.
template <class Judge>
class UnitJudge final : public cluster::UnitDecider {
 public:
  explicit UnitJudge(const typename Judge::Question& question)
      : intervals_(intervals_of(question)), judge_(question) {}

  [[nodiscard]] std::optional<std::string> decide(const cluster::Unit& unit) override {
    const auto boxes = boxes_of(unit, intervals_);
    cluster::Outcome outcome;
    outcome.boxes = unit.size();
    try {
      outcome.events = judged(boxes, unit.horizon);
    } catch (const std::bad_alloc&) {
      outcome.kind = cluster::OutcomeKind::kMemory;
    }
    return write_outcome(outcome);
  }

 private:
  [[nodiscard]] std::string judged(std::span<const SharedBoxes::Box> boxes, double horizon) {
    const FloatingPointScope nearest(FloatingPointRounding::kNearest);
    std::vector<typename Judge::Finding> findings(boxes.size());
    judge_.judge(boxes, findings, horizon);
    cluster::ByteWriter bytes;
    for (const auto& finding : findings) Judge::put(bytes, finding);
    return bytes.take();
  }

  [[nodiscard]] static std::size_t intervals_of(const typename Judge::Question& question) {
    if constexpr (requires { Judge::intervals(question); })
      return Judge::intervals(question);
    else
      return question.problem.outer.size();
  }

  const std::size_t intervals_;
  Judge judge_;
};

/// Makes judges of units. The parts of the question must outlive them.
template <class Judge>
[[nodiscard]] cluster::MakeDecider unit_judges(const typename Judge::Question& question) {
  return [question] { return std::make_unique<UnitJudge<Judge>>(question); };
}

/// Reads what a UnitJudge says about as many boxes as `findings`. Throws MalformedMessage.
template <class Judge>
void read_findings(std::string_view text, const typename Judge::Question& question,
                   std::span<typename Judge::Finding> findings) {
  cluster::ByteReader bytes(text);
  for (auto& finding : findings) finding = Judge::take(bytes, question);
  if (!bytes.at_end()) throw cluster::MalformedMessage();
}

template <class Judge>
class BoxJudges {
 public:
  using Box = SharedBoxes::Box;
  using Question = typename Judge::Question;
  using Finding = typename Judge::Finding;

  /// `threads`: at least 1. `most`: the number of boxes that are usually judged at once.
  BoxJudges(const Question& question, unsigned threads, std::size_t most,
            const BoxSharing& sharing = {})
      : question_(question),
        shared_(question.problem, settings_of(question), unit_judges<Judge>(question), sharing) {
    const auto needed = unsigned(std::max<std::size_t>(most / kLanes, 1));
    threads_ = std::clamp(threads, 1U, needed);
    judges_.push_back(std::make_unique<Judge>(question));
  }

  /// Requires  as many findings as boxes.
  /// Ensures   false if memory ran out; some findings then say nothing about their boxes.
  /// Throws    the exceptions of the workers.
  [[nodiscard]] bool judge(std::span<const Box> boxes, std::span<Finding> findings,
                           double horizon) try {
    const auto take = [&](std::size_t at, std::size_t count, std::string_view text) {
      read_findings<Judge>(text, question_, findings.subspan(at, count));
    };
    if (shared_.judge(boxes, horizon, take)) return true;
    std::ranges::fill(findings, Finding{});
    return judge_here(boxes, findings, horizon);
  } catch (const std::bad_alloc&) {
    return false;
  }

 private:
  [[nodiscard]] static Settings settings_of(const Question& question) {
    if constexpr (requires { question.settings; })
      return question.settings;
    else
      return {};
  }

  [[nodiscard]] bool judge_here(std::span<const Box> boxes, std::span<Finding> findings,
                                double horizon) {
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> is_out_of_memory = false;
    const auto work = [&](Judge& judge) noexcept {
      const FloatingPointScope nearest(FloatingPointRounding::kNearest);
      for (std::size_t at; (at = kLanes * next++) < boxes.size();) {
        const std::size_t count = std::min(kLanes, boxes.size() - at);
        try {
          judge.judge(boxes.subspan(at, count), findings.subspan(at, count), horizon);
        } catch (const std::bad_alloc&) {
          is_out_of_memory = true;
        }
      }
    };
    const std::size_t batches = (boxes.size() + kLanes - 1) / kLanes;
    const std::size_t threads = std::min<std::size_t>(threads_, batches);
    // Most searches end before their rounds need many.
    while (judges_.size() < threads) judges_.push_back(std::make_unique<Judge>(question_));
    {
      std::vector<std::jthread> others;
      try {
        for (std::size_t t = 1; t < threads; ++t)
          others.emplace_back([&work, this, t] { work(*judges_[t]); });
      } catch (const std::system_error&) {  // fewer threads are to be had
      }
      work(*judges_.front());
    }
    return !is_out_of_memory;
  }

  const Question question_;
  std::size_t threads_ = 1;
  std::vector<std::unique_ptr<Judge>> judges_;  ///< one a thread, made when first needed
  SharedBoxes shared_;
};

}  // namespace regulus::detail
