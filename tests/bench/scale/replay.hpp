// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <queue>
#include <vector>

#include "tests/bench/scale/trace.hpp"

namespace regulus::bench {

/// Costs in virtual time, in seconds.
struct ReplayCosts {
  double message = 20e-6;  ///< of the supervisor, for each message that it sends or receives
  double latency = 50e-6;  ///< between two ranks
};

/// Many ranks in virtual time, which decide units as fast as a trace says.
class ReplayedRanks final : public cluster::Workers {
 public:
  /// `slower`: each unit takes so many times as long as in the trace.
  ReplayedRanks(const Trace& trace, std::size_t ranks, double slower, const ReplayCosts& costs)
      : trace_(trace), slower_(slower), costs_(costs), ranks_(ranks) {}

  void begin(const Problem&, const Settings&, const cluster::Learned&) override {}
  void end() noexcept override {}
  [[nodiscard]] std::size_t count() const override { return ranks_.size(); }
  [[nodiscard]] double seconds_of_grant() const override { return 1.0; }
  void send(std::size_t worker, std::string grant) override;
  [[nodiscard]] std::optional<cluster::Received> receive() override;
  [[nodiscard]] double now() const override { return supervisor_; }

  [[nodiscard]] std::uint64_t messages() const noexcept { return messages_; }
  [[nodiscard]] double busy() const noexcept { return busy_; }

 private:
  struct Rank {
    cluster::Worker worker;
    double free_at = 0;
  };
  struct Event {
    double at;
    std::uint64_t number;
    std::size_t rank;
    bool is_grant;
    std::string message;
    friend bool operator<(const Event& a, const Event& b) {
      return a.at != b.at ? a.at > b.at : a.number > b.number;
    }
  };

  void decide(std::size_t rank, double at, const std::string& grant);

  const Trace& trace_;
  const double slower_;
  const ReplayCosts costs_;
  std::vector<Rank> ranks_;
  std::priority_queue<Event> events_;
  std::uint64_t messages_ = 0;
  double supervisor_ = 0, busy_ = 0;
};

}  // namespace regulus::bench
