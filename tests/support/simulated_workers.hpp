// SPDX-License-Identifier: GPL-3.0-or-later
// Workers in virtual time, whose messages are late, lost or repeated, and who die and come back.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <queue>
#include <random>
#include <string>
#include <vector>

#include "runtime/cluster/search_description.hpp"
#include "runtime/cluster/worker.hpp"
#include "runtime/cluster/workers.hpp"
#include "runtime/problem/row_structure.hpp"
#include "runtime/search/unit_search.hpp"

namespace regulus::detail::test {

/// What a simulation may do wrong; each is a probability.
struct Troubles {
  double loss = 0, repetition = 0, death = 0;
  double longest_delay = 0.01;  ///< seconds
};

/// Keeps outcomes between simulations with one kernel: they depend on the search and the unit alone.
using KnownOutcomes = std::map<std::string, std::string>;

class SimulatedWorkers final : public cluster::Workers {
 public:
  SimulatedWorkers(std::size_t count, const Troubles& troubles, unsigned seed, KnownOutcomes& known)
      : troubles_(troubles), random_(seed), known_(known), workers_(count), dead_until_(count) {}

  void begin(const Problem& problem, const Settings& settings, const cluster::Learned& learned,
             const cluster::MakeDecider& make) override {
    search_key_ = std::hash<std::string>()(cluster::write_search(problem, settings, learned));
    if (make) {
      decider_ = make();
      return;
    }
    structure_.emplace(find_row_structure(problem, settings));
    witness_ = std::make_unique<WitnessSearch>(problem, settings, false);
    decider_ =
        std::make_unique<UnitSearch>(problem, settings, *structure_, learned, *witness_, stop_);
  }
  void end() noexcept override {}
  [[nodiscard]] std::size_t count() const override { return workers_.size(); }
  [[nodiscard]] double seconds_of_grant() const override { return 0.1; }
  [[nodiscard]] double now() const override { return now_; }

  void send(std::size_t worker, std::string grant) override {
    post(worker, true, std::move(grant));
  }

  [[nodiscard]] std::optional<cluster::Received> receive() override {
    for (int events = 0; events < kEventsAtOnce && !events_.empty(); ++events) {
      Event event = events_.top();
      events_.pop();
      now_ = event.at;
      if (!event.to_worker) return cluster::Received{event.worker, std::move(event.message)};
      work(event.worker, event.message);
    }
    if (events_.empty()) now_ += kIdle;
    for (std::size_t i = 0; i < workers_.size(); ++i)
      if (now_ >= dead_until_[i])
        if (auto reminder = workers_[i].tick(now_)) post(i, false, std::move(*reminder));
    return std::nullopt;
  }

  std::size_t deaths = 0, losses = 0, repetitions = 0;

 private:
  static constexpr int kEventsAtOnce = 8;
  static constexpr double kIdle = 0.5, kLongestUnit = 0.02, kLongestDeath = 100;

  struct Event {
    double at;
    std::uint64_t number;
    std::size_t worker;
    bool to_worker;
    std::string message;
    friend bool operator<(const Event& a, const Event& b) {
      return a.at != b.at ? a.at > b.at : a.number > b.number;
    }
  };

  /// Takes outcomes from earlier simulations, in virtual time.
  class Decider final : public cluster::UnitDecider {
   public:
    explicit Decider(SimulatedWorkers& of) : of_(of) {}
    std::optional<std::string> decide(const cluster::Unit& unit) override {
      cluster::ByteWriter key;
      key.put(of_.search_key_);
      put(key, unit);
      const auto [found, added] = of_.known_.try_emplace(key.bytes());
      if (added) found->second = of_.decider_->decide(unit).value();
      of_.busy_ += of_.uniform() * kLongestUnit;
      return found->second;
    }

   private:
    SimulatedWorkers& of_;
  };

  [[nodiscard]] double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  void post(std::size_t worker, bool to_worker, std::string message, double after = 0) {
    if (uniform() < troubles_.loss) return void(++losses);
    const bool twice = uniform() < troubles_.repetition;
    if (twice) ++repetitions;
    for (int copies = twice ? 2 : 1; copies > 0; --copies)
      events_.push({now_ + after + uniform() * troubles_.longest_delay, next_++, worker, to_worker,
                    message});
  }

  void work(std::size_t number, const std::string& grant) {
    if (now_ < dead_until_[number]) return;
    if (uniform() < troubles_.death) {
      ++deaths;
      workers_[number] = {};
      dead_until_[number] = now_ + uniform() * kLongestDeath;
      return;
    }
    Decider decider(*this);
    busy_ = 0;
    workers_[number].receive(grant);
    while (workers_[number].has_work())
      if (auto answer = workers_[number].step(decider, [this] { return now_ + busy_; }))
        post(number, false, std::move(*answer), busy_);
  }

  const Troubles troubles_;
  std::mt19937 random_;
  KnownOutcomes& known_;
  std::vector<cluster::Worker> workers_;
  std::vector<double> dead_until_;
  std::size_t search_key_ = 0;
  std::optional<RowStructure> structure_;
  std::unique_ptr<WitnessSearch> witness_;
  std::unique_ptr<cluster::UnitDecider> decider_;
  const std::atomic<bool> stop_ = false;
  std::priority_queue<Event> events_;
  std::uint64_t next_ = 0;
  double now_ = 0, busy_ = 0;
};

}  // namespace regulus::detail::test
