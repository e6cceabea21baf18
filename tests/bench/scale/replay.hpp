// SPDX-License-Identifier: GPL-3.0-or-later
// Many ranks in virtual time, which decide boxes as fast as a trace says. All grants and answers
// pass through the real supervisor and the real workers.
#pragma once

#include <queue>
#include <string>
#include <vector>

#include "runtime/cluster/supervisor.hpp"
#include "runtime/cluster/worker.hpp"
#include "tests/bench/scale/trace.hpp"

namespace regulus::detail::bench {

struct Job {
  std::size_t ranks;
  double seconds;          ///< of ideal work for each; boxes take so much longer than in the trace
  std::uint64_t unit;      ///< boxes of a unit
  double message = 20e-6;  ///< seconds of rank 0, for each message that it sends or receives
  double in_order = 0.1e-6;  ///< seconds of rank 0, for each box whose outcome it puts in order
  double latency = 50e-6;    ///< seconds between two ranks
};

struct Replayed {
  double seconds = 0;  ///< until the last outcome is in order
  double busy = 0;     ///< seconds of all ranks
  std::uint64_t messages = 0, units = 0;
  std::size_t most_known = 0;  ///< units in the supervisor
  double most_megabytes = 0;   ///< of the supervisor, all workers and all messages
  double own_seconds = 0;      ///< processor time of the real supervisor
};

class Replay {
 public:
  Replay(const Trace& trace, const Job& job);
  [[nodiscard]] Replayed run();

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

  void send_grants();
  void take_in_order();
  void take_event();
  void decide(const Event& event);
  void measure_memory();

  const Trace& trace_;
  const Job job_;
  const double slower_;
  cluster::Supervisor supervisor_;
  std::vector<Rank> ranks_;
  std::priority_queue<Event> events_;
  double now_ = 0;  ///< of rank 0
  double memory_before_ = 0;
  Replayed result_;
};

}  // namespace regulus::detail::bench
