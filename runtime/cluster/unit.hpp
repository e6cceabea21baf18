// SPDX-License-Identifier: Apache-2.0
// The pieces into which a long search is cut.
//
// A unit is a list of boxes. Its outcome depends on these boxes and on what the search had learned
// before its first unit, and on nothing else: not on other units, on the time, or on the process
// that decides it. The boxes that an outcome leaves open are in groups, and each group is a unit
// again. So the units of a search are a tree, and this tree is the same wherever they are decided.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/cluster/bytes.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail::cluster {

struct Unit {
  std::vector<std::uint32_t> depths;  ///< of each box: the splits above it
  std::vector<Interval> ranges;       ///< box by box, of the variables that are split
  double horizon = 0;  ///< of the search, if its boxes are judged with one (search/box_judges.hpp)

  [[nodiscard]] std::size_t size() const noexcept { return depths.size(); }
  friend bool operator==(const Unit&, const Unit&) = default;
};

/// A group has few siblings: its number among them is one byte.
inline constexpr std::size_t kMaxGroups = 4;

enum class OutcomeKind : std::uint8_t {
  kDecided,
  kWitness,  ///< a singularity was proved; to decide the unit again gives the proof
  kMemory,   ///< memory was exhausted: nothing is known about the unit
};

/// The knowledge about a unit after it was decided.
struct Outcome {
  OutcomeKind kind = OutcomeKind::kDecided;
  std::uint64_t boxes = 0;   ///< evaluated
  std::uint64_t probes = 0;  ///< as in Statistics
  /// Ranges, as in Unit, of the first box from which it is worth to look for a singularity; empty
  /// if there is none.
  std::vector<Interval> start;
  /// The boxes that are left, at most kMaxGroups groups of them, in the order of `events`.
  std::vector<Unit> groups;
  /// Splits, leaves and open boxes in preorder (runtime/search/unit_events.hpp).
  std::string events;
};

/// Ensures   equal outcomes give equal bytes; different outcomes give different bytes.
[[nodiscard]] std::string write_outcome(const Outcome& outcome);
/// Accepts any bytes. Throws MalformedMessage.
[[nodiscard]] Outcome read_outcome(std::string_view bytes);
/// Reads the groups alone.
[[nodiscard]] std::vector<Unit> read_groups(std::string_view outcome);

void put(ByteWriter& to, const Unit& unit);
/// Ensures   every box has the same number of ranges; there is at least one box.
[[nodiscard]] Unit take_unit(ByteReader& from);

/// Decides units. A process has one for each thread.
class UnitDecider {
 public:
  UnitDecider() = default;
  UnitDecider(const UnitDecider&) = delete;
  UnitDecider& operator=(const UnitDecider&) = delete;
  virtual ~UnitDecider() = default;

  /// Returns an outcome, written; nullopt if the search must end first.
  ///
  /// Ensures   equal units have equal outcomes, to the byte.
  [[nodiscard]] virtual std::optional<std::string> decide(const Unit& unit) = 0;
};

}  // namespace regulus::detail::cluster
