// SPDX-License-Identifier: Apache-2.0
#include "runtime/search/thread_workers.hpp"

#include <new>
#include <system_error>
#include <utility>

#include "runtime/search/unit_search.hpp"

namespace regulus::detail {
namespace {

/// Small enough that a user who interrupts the search loses little.
constexpr double kSecondsOfGrant = 0.05;

constexpr std::chrono::milliseconds kLongestWait{20};

/// Decides the units of Algorithm 1.
class ThreadSearch final : public cluster::UnitDecider {
 public:
  ThreadSearch(const Problem& problem, const Settings& settings, const RowStructure& structure,
               const cluster::Learned& learned, const std::atomic<bool>& stop,
               ThreadWorkers::Clock::time_point deadline)
      : witness_(problem, settings, false),
        search_(problem, settings, structure, learned, witness_, stop, deadline) {}

  [[nodiscard]] std::optional<std::string> decide(const cluster::Unit& unit) override {
    return search_.decide(unit);
  }

 private:
  WitnessSearch witness_;
  UnitSearch search_;
};

}  // namespace

double ThreadWorkers::seconds_of_grant() const { return kSecondsOfGrant; }

double ThreadWorkers::now() const {
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

cluster::MakeDecider ThreadWorkers::unit_searches(const Problem& problem, const Settings& settings,
                                                  const cluster::Learned& learned) {
  structure_.emplace(find_row_structure(problem, settings));
  return [&, this] {
    return std::make_unique<ThreadSearch>(problem, settings, *structure_, learned, stop_,
                                          deadline_);
  };
}

void ThreadWorkers::begin(const Problem& problem, const Settings& settings,
                          const cluster::Learned& learned, const cluster::MakeDecider& make) {
  stop_ = false;
  const cluster::MakeDecider decider = make ? make : unit_searches(problem, settings, learned);
  const auto add = [&] { places_.push_back(std::make_unique<Place>(Place{decider()})); };
  add();
  try {
    while (places_.size() < threads_) add();
  } catch (const std::bad_alloc&) {
  }
  start_threads();
}

void ThreadWorkers::start_threads() noexcept {
  try {
    while (running_.size() + 1 < places_.size())
      running_.emplace_back([this, place = running_.size() + 1] { work(place); });
  } catch (const std::exception&) {
    places_.resize(running_.size() + 1);
  }
}

void ThreadWorkers::end() noexcept {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  granted_.notify_all();
  for (std::thread& thread : running_) thread.join();
  running_.clear();
  places_.clear();
  outbox_.clear();
  failure_ = nullptr;
}

void ThreadWorkers::send(std::size_t worker, std::string grant) {
  {
    const std::lock_guard lock(mutex_);
    places_[worker]->inbox.push_back(std::move(grant));
  }
  if (worker > 0) granted_.notify_all();
}

/// Moves the grants from the inbox to the worker. Returns false if it has nothing to do.
bool ThreadWorkers::take_grants(Place& place) {
  for (; !place.inbox.empty(); place.inbox.pop_front()) place.worker.receive(place.inbox.front());
  return place.worker.has_work();
}

void ThreadWorkers::work_while_granted(std::size_t number) {
  Place& place = *places_[number];
  std::unique_lock lock(mutex_);
  for (;;) {
    granted_.wait(lock, [&] { return stop_ || !place.inbox.empty() || place.worker.has_work(); });
    if (stop_) return;
    static_cast<void>(take_grants(place));
    lock.unlock();
    std::optional<std::string> answer = place.worker.step(*place.decider, [this] { return now(); });
    lock.lock();
    if (!answer) continue;
    outbox_.push_back({number, std::move(*answer)});
    answered_.notify_one();
  }
}

void ThreadWorkers::work(std::size_t number) noexcept try {
  work_while_granted(number);
} catch (...) {
  const std::lock_guard lock(mutex_);
  failure_ = std::current_exception();
  answered_.notify_one();
}

bool ThreadWorkers::caller_has_work() {
  const std::lock_guard lock(mutex_);
  return take_grants(*places_.front());
}

std::optional<cluster::Received> ThreadWorkers::receive() { return receive(true); }

std::optional<cluster::Received> ThreadWorkers::receive(bool wait) {
  std::unique_lock lock(mutex_);
  Place& own = *places_.front();
  const bool has_work = take_grants(own);
  if (wait && !has_work)
    answered_.wait_for(lock, kLongestWait, [this] { return failure_ || !outbox_.empty(); });
  if (failure_) std::rethrow_exception(failure_);
  if (!outbox_.empty()) {
    cluster::Received received = std::move(outbox_.front());
    outbox_.pop_front();
    return received;
  }
  if (!has_work) return std::nullopt;
  lock.unlock();
  std::optional<std::string> answer = own.worker.step(*own.decider, [this] { return now(); });
  if (!answer) return std::nullopt;
  return cluster::Received{0, std::move(*answer)};
}

}  // namespace regulus::detail
