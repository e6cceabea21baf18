// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "runtime/cluster/supervisor.hpp"
#include "runtime/cluster/workers.hpp"
#include "runtime/problem/row_structure.hpp"
#include "runtime/search/search_record.hpp"

namespace regulus::detail {

/// The part of a long search that is cut into units, which workers decide in any order.
///
/// Their outcomes enter the record of the search one after the other, in the order of the units. So
/// the record, and everything that an observer receives, depends neither on the number of workers
/// nor on the time that they take. All that a worker does beyond the end of the search is lost.
class UnitPhase {
 public:
  /// All must outlive this object.
  UnitPhase(SearchRecord& record, const RowStructure& structure);
  ~UnitPhase();

  /// Decides units until none is left, the search stops, or a box cannot be decided. Then the
  /// frontier has the boxes that are left.
  ///
  /// Errors    std::bad_alloc; cluster::Disagreement, cluster::MalformedMessage, and the errors of
  ///           the workers.
  void run();

 private:
  void cut_frontier();
  [[nodiscard]] std::vector<cluster::Unit> units() const;
  void exchange_messages();
  void take_decided();
  [[nodiscard]] bool take(const cluster::Supervisor::Decided& decided);
  [[nodiscard]] bool fits_into_budget(const cluster::Outcome& outcome) noexcept;
  void require_same_boxes(const cluster::Unit& unit) const;
  void replay(const cluster::Outcome& outcome, std::size_t roots);
  void replay_box(cluster::ByteReader& events);
  void leave(const OpenBox& box, Decision& decision);
  void split(const OpenBox& box, std::uint32_t variable);
  void put_back();
  void push(const OpenBox& box);
  void look_for_witness(const cluster::Outcome& outcome);
  void prove_again(const cluster::Unit& unit);
  void save_units();
  void show_progress();
  [[nodiscard]] bool goes_on() noexcept;

  SearchRecord& record_;
  const RowStructure& structure_;
  const cluster::Learned learned_;
  const std::size_t splittable_;
  std::unique_ptr<cluster::Workers> threads_;
  cluster::Workers& workers_;
  std::optional<cluster::Supervisor> supervisor_;
  std::vector<std::uint32_t> sizes_;  ///< of the units in the frontier; the first one is the last
  std::vector<Interval> box_, start_;
  double shown_at_ = 0;

  /// Boxes of the unit that it leaves open.
  struct Left {
    BoxId id;
    std::uint32_t depth;
    std::vector<Interval> box;
  };
  std::vector<Left> left_;
};

}  // namespace regulus::detail
