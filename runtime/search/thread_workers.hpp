// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "runtime/cluster/worker.hpp"
#include "runtime/cluster/workers.hpp"
#include "runtime/problem/row_structure.hpp"

namespace regulus::detail {

/// Threads of this process as workers. The caller's thread is worker 0: it decides units while it
/// waits for messages.
class ThreadWorkers final : public cluster::Workers {
 public:
  using Clock = std::chrono::steady_clock;

  /// After `deadline` no worker begins another batch of boxes.
  explicit ThreadWorkers(unsigned threads, Clock::time_point deadline = Clock::time_point::max())
      : threads_(threads), deadline_(deadline) {}
  ~ThreadWorkers() override { end(); }

  /// If memory or threads for some of the workers cannot be had, there are fewer.
  /// Errors    std::bad_alloc if there is not even memory for one.
  void begin(const Problem& problem, const Settings& settings, const cluster::Learned& learned,
             const cluster::MakeDecider& make) override;
  void end() noexcept override;
  [[nodiscard]] std::size_t count() const override { return places_.size(); }
  [[nodiscard]] double seconds_of_grant() const override;
  void send(std::size_t worker, std::string grant) override;
  [[nodiscard]] std::optional<cluster::Received> receive() override;
  [[nodiscard]] double now() const override;

  /// The same; `wait` false: returns at once if there is neither a message nor work for the caller.
  [[nodiscard]] std::optional<cluster::Received> receive(bool wait);
  [[nodiscard]] bool caller_has_work();

 private:
  /// All that one worker has.
  struct Place {
    std::unique_ptr<cluster::UnitDecider> decider;
    cluster::Worker worker{};
    std::deque<std::string> inbox{};  ///< guarded by mutex_
  };

  [[nodiscard]] cluster::MakeDecider unit_searches(const Problem& problem, const Settings& settings,
                                                   const cluster::Learned& learned);
  void start_threads() noexcept;
  void work(std::size_t place) noexcept;
  void work_while_granted(std::size_t place);
  [[nodiscard]] bool take_grants(Place& place);

  const unsigned threads_;
  const Clock::time_point deadline_;
  std::optional<RowStructure> structure_;
  std::vector<std::unique_ptr<Place>> places_;
  std::vector<std::thread> running_;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::condition_variable granted_, answered_;
  std::deque<cluster::Received> outbox_;  ///< guarded by mutex_, as failure_ is
  std::exception_ptr failure_;
};

}  // namespace regulus::detail
