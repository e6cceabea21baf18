// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/cluster/messages.hpp"
#include "runtime/cluster/waiting_units.hpp"

namespace regulus::detail::cluster {

/// Two workers gave different outcomes for one unit, so at least one of them computes wrongly.
class Disagreement : public std::runtime_error {
 public:
  Disagreement(std::size_t first, std::size_t second)
      : std::runtime_error("workers " + std::to_string(first) + " and " + std::to_string(second) +
                           " disagree about the same boxes") {}
};

/// Gives the units of a search to workers and puts the outcomes in order. It knows neither threads
/// nor processes: a transport brings the messages and the time, in seconds.
///
/// The order of units is that of the tree, parents first. A unit is given to another worker if its
/// worker does not answer in time; the first answer counts, and a second one must be equal to it.
class Supervisor {
 public:
  struct Pace {
    double seconds = 1.0;    ///< the most work in a grant
    double patience = 30.0;  ///< without an answer, until the work is given to another worker

    /// Returns the most work in a grant for so many processes: short, so that the work is well
    /// divided at the end, but so long that the supervisor can answer all.
    [[nodiscard]] static double seconds_for(std::size_t workers) noexcept;
  };
  struct Outgoing {
    std::size_t worker;
    std::string grant;
  };
  struct Decided {
    const Unit* unit;
    const std::string* outcome;
  };

  Supervisor(std::vector<Unit> units, std::size_t workers, const Pace& pace);

  /// Adds units, which come after all others in order.
  void add(std::vector<Unit> units);

  /// Throws MalformedMessage and Disagreement.
  void receive(std::size_t worker, std::string_view answer, double now);

  /// Returns the grants that must be sent now.
  [[nodiscard]] std::vector<Outgoing> grant_work(double now);

  /// Returns the first unit in order if it is decided; nullopt if it is not, or if none is left.
  [[nodiscard]] std::optional<Decided> first() const;
  /// Forgets the first unit. Its groups come next in order.
  void remove_first();

  [[nodiscard]] bool empty() const noexcept { return units_.empty(); }
  /// Returns the units that no worker has.
  [[nodiscard]] std::size_t waiting() const noexcept { return waiting_.size(); }
  /// Returns the units that are not yet in order: memory is proportional to their number.
  [[nodiscard]] std::size_t known() const noexcept { return units_.size(); }
  /// Returns the workers that did not answer in time.
  [[nodiscard]] std::vector<std::size_t> standing_still() const;

 private:
  struct Entry {
    Unit unit;
    std::uint64_t grant = 0;  ///< the last one that contains it
    std::optional<std::string> outcome;
    std::size_t decided_by = 0;
  };
  struct Sent {
    std::size_t worker = 0;
    std::vector<Place> places;
    double at = 0;
    bool overdue = false;
  };
  struct WorkerState {
    std::set<std::uint64_t> grants;  ///< that are not overdue
    double seconds_a_box = 0;        ///< 0: not known
    bool still = false;
  };

  void add_groups(const Place& parent, std::vector<Unit> groups);
  void accept(std::size_t worker, const Place& place, std::string outcome);
  void give_back(const std::vector<Place>& places, std::uint64_t grant);
  void take_results(std::size_t worker, std::vector<Place> places, std::vector<UnitResult> results);
  void withdraw_overdue(double now);
  [[nodiscard]] Grant make_grant(std::size_t worker, double now);
  [[nodiscard]] Place take_waiting();
  [[nodiscard]] double units_a_worker() const noexcept;
  [[nodiscard]] std::uint64_t budget_for(const WorkerState& worker) const noexcept;
  void file(std::size_t worker);

  const Pace pace_;
  std::map<Place, Entry> units_;
  std::size_t next_unit_ = 0;  ///< of those that no other unit left
  WaitingUnits waiting_;
  std::map<std::uint64_t, Sent> sent_;
  std::uint64_t next_grant_ = 1;
  std::vector<WorkerState> workers_;
  /// The workers with no grant, and with one; others are busy enough or stand still.
  std::set<std::size_t> idle_, nearly_idle_;
  double longest_ = 0;  ///< time for an answer
};

}  // namespace regulus::detail::cluster
