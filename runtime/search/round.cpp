// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/round.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <exception>
#include <functional>
#include <new>
#include <optional>

#include "runtime/kernel/rounding_scope.hpp"
#include "runtime/search/hand_over.hpp"

namespace regulus::detail {

/// Owns the threads; the caller is the first of them.
class Round::Threads {
 public:
  explicit Threads(unsigned count) : of_place_(count), arena_(static_cast<int>(count)) {
    // It is for the whole process: changed only if more threads are wanted than it would give.
    if (static_cast<int>(count) > tbb::info::default_concurrency())
      allowed_.emplace(tbb::global_control::max_allowed_parallelism, count);
  }

  /// Calls `body(thread, index)` for each index below `count`; thread < the number of threads.
  template <typename Body>
  void for_each(std::size_t count, const Body& body) {
    const std::function<void(std::size_t)> call = [&body, this](std::size_t index) {
      const auto thread = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
      of_place_[thread].take();
      body(thread, index);
      of_place_[thread].give();
    };
    entrance_.lead_to(call);
    arena_.execute(
        [&] { tbb::parallel_for(std::size_t{0}, count, entrance_, tbb::simple_partitioner()); });
    for (const HandOver& place : of_place_) place.take();
  }

 private:
  /// A thread reads only an atomic pointer before it knows what the caller has written.
  class Entrance {
   public:
    void lead_to(const std::function<void(std::size_t)>& call) noexcept {
      call_.store(&call, std::memory_order_release);
    }
    void operator()(std::size_t index) const { (*call_.load(std::memory_order_acquire))(index); }

   private:
    std::atomic<const std::function<void(std::size_t)>*> call_ = nullptr;
  };

  Entrance entrance_;
  std::vector<HandOver> of_place_;  ///< for the threads that use one place of the arena in turn
  std::optional<tbb::global_control> allowed_;
  tbb::task_arena arena_;
};

Round::Round(const Problem& problem, const Settings& settings, const RowStructure& structure)
    : problem_(problem),
      settings_(settings),
      structure_(structure),
      // Users' code may require that only one thread at a time calls it.
      thread_count_(settings.filters.empty() ? settings.threads : 1) {
  deciders_.push_back(std::make_unique<Decider>(problem, settings, structure));
}

void Round::take_ranges() {
  clear();
  for (const std::unique_ptr<Decider>& decider : deciders_) decider->take_ranges();
}

Round::~Round() = default;

Decisions* Round::append() noexcept try {
  if (size_ == batches_.size())
    batches_.push_back(std::make_unique<Decisions>(*problem_.kernel, order()));
  Decisions* next = batches_[size_++].get();
  next->clear();
  return next;
} catch (const std::bad_alloc&) {
  return nullptr;
}

bool Round::must_stop() const noexcept {
  return (settings_.interrupt != nullptr && settings_.interrupt->load(std::memory_order_relaxed)) ||
         Clock::now() >= deadline_;
}

/// If memory is exhausted in any thread, the batch stays undecided.
void Round::decide(Decider& decider, std::size_t index) noexcept try {
  const RoundingScope scope(REGULUS_ROUND_NEAREST);
  if (index == 0 || !must_stop()) decider.decide(batch(index), size_ > 1);
} catch (const std::bad_alloc&) {
  memory_exhausted_.store(true, std::memory_order_relaxed);
}

void Round::decide_in_parallel() {
  if (!threads_) {
    while (deciders_.size() < thread_count_)
      deciders_.push_back(std::make_unique<Decider>(problem_, settings_, structure_));
    threads_ = std::make_unique<Threads>(thread_count_);
  }
  threads_->for_each(
      size_, [this](std::size_t thread, std::size_t index) { decide(*deciders_[thread], index); });
}

bool Round::decide(const AdaptiveThreshold& threshold) noexcept {
  for (std::size_t i = 0; i < size_; ++i) batch(i).budget.threshold = threshold;
  // If more threads cannot be made, one thread does the work.
  if (thread_count_ > 1 && size_ > 1) try {
      decide_in_parallel();
    } catch (const std::exception&) {
    }
  // One thread alone may get the memory that several together did not get.
  memory_exhausted_ = false;
  for (std::size_t i = 0; i < size_; ++i)
    if (!batch(i).decided) decide(*deciders_.front(), i);
  return !memory_exhausted_;
}

bool Round::decide(Foresight& foresight) noexcept {
  return size_ == 1 && foresight.decide(batch(0), *deciders_.front());
}

}  // namespace regulus::detail
