// SPDX-License-Identifier: GPL-3.0-or-later
// The tree of a real search, with the processor time that each box took: 8 bytes a box.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "runtime/cluster/worker.hpp"
#include "runtime/cluster/workers.hpp"
#include "runtime/problem/row_structure.hpp"
#include "runtime/search/unit_search.hpp"

namespace regulus::detail::bench {

struct TracedBox {
  std::uint32_t lower =
      0;  ///< the number of the lower half; the upper half has the next; 0: a leaf
  float seconds = 0;
};

struct Trace {
  std::vector<TracedBox> boxes = std::vector<TracedBox>(1);  ///< number 0 is not used
  std::vector<std::uint32_t> roots, depths;  ///< the boxes before the first unit, their splits
  double seconds = 0;                        ///< of all boxes
};

/// One worker, which records what it does: a unit is one batch of boxes, which share its time.
class RecordingWorkers final : public cluster::Workers, public cluster::UnitDecider {
 public:
  explicit RecordingWorkers(Trace& trace) : trace_(trace) {}

  void begin(const Problem& problem, const Settings& settings, const cluster::Learned& learned,
             const cluster::MakeDecider&) override;
  void end() noexcept override {}
  [[nodiscard]] std::size_t count() const override { return 1; }
  [[nodiscard]] double seconds_of_grant() const override { return 0.05; }
  void send(std::size_t, std::string grant) override { worker_.receive(grant); }
  [[nodiscard]] std::optional<cluster::Received> receive() override;
  [[nodiscard]] double now() const override;

  [[nodiscard]] std::optional<std::string> decide(const cluster::Unit& unit) override;

 private:
  using Numbers = std::vector<std::uint32_t>;

  [[nodiscard]] Numbers numbers_of(const cluster::Unit& unit);
  void record(const cluster::Outcome& outcome, const Numbers& boxes, double seconds);
  void add_box(std::uint32_t box, cluster::ByteReader& events, float seconds, Numbers& open);

  Trace& trace_;
  const Settings* settings_ = nullptr;
  cluster::Worker worker_;
  std::unordered_map<std::string, Numbers> waiting_;  ///< boxes of units that were not decided yet
  std::optional<RowStructure> structure_;
  std::unique_ptr<WitnessSearch> witness_;
  std::unique_ptr<UnitSearch> search_;
  const std::atomic<bool> stop_ = false;
};

}  // namespace regulus::detail::bench
