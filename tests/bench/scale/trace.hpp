// SPDX-License-Identifier: GPL-3.0-or-later
// The units of a real search, with the processor time that each took.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <unordered_map>

#include "runtime/cluster/worker.hpp"
#include "runtime/cluster/workers.hpp"
#include "runtime/problem/row_structure.hpp"
#include "runtime/search/unit_search.hpp"

namespace regulus::bench {

struct TracedUnit {
  std::string outcome;
  double seconds = 0;
};

struct Trace {
  std::unordered_map<std::string, TracedUnit> units;  ///< by the unit, written
  double seconds = 0;                                 ///< of all units
};

[[nodiscard]] std::string key_of(const cluster::Unit& unit);

/// One worker, which records what it does.
class RecordingWorkers final : public cluster::Workers, public cluster::UnitDecider {
 public:
  explicit RecordingWorkers(Trace& trace) : trace_(trace) {}

  void begin(const Problem& problem, const Settings& settings,
             const cluster::Learned& learned) override;
  void end() noexcept override {}
  [[nodiscard]] std::size_t count() const override { return 1; }
  [[nodiscard]] double seconds_of_grant() const override { return 0.05; }
  void send(std::size_t, std::string grant) override { worker_.receive(grant); }
  [[nodiscard]] std::optional<cluster::Received> receive() override;
  [[nodiscard]] double now() const override;

  [[nodiscard]] std::optional<std::string> decide(const cluster::Unit& unit) override;

 private:
  Trace& trace_;
  cluster::Worker worker_;
  std::optional<RowStructure> structure_;
  std::unique_ptr<WitnessSearch> witness_;
  std::unique_ptr<UnitSearch> search_;
  const std::atomic<bool> stop_ = false;
};

}  // namespace regulus::bench
