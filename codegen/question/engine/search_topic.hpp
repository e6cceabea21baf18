// SPDX-License-Identifier: GPL-3.0-or-later
// The matrix that the next searches are about, in words with which other processes can form it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/cluster/workers.hpp"

namespace regulus {
struct Motion;
}  // namespace regulus

namespace regulus::detail {

/// The kernel that searches need.
enum class TopicKind : std::uint8_t {
  kQuestion,           ///< of the question, of a bound: of its bordered matrix
  kExpandedMatrix,     ///< of the matrix itself, with Taylor's expansion (condition_kernel.hpp)
  kMatrixWithSlopes,   ///< the same, with slopes of its entries
  kBranch,             ///< of a bound of a closure: the branch alone, without a quantity
  kBranchWithNominal,  ///< the same with a copy without errors, of a finite error
};

/// For a process that has the same model and words. Each question sets the members that it needs.
///
/// Each process reads the file of way-points by itself, so its digest is told, too.
struct SearchTopic {
  std::string part{};       ///< of a datasheet: the quantity, as BoundSettings::part
  std::string component{};  ///< of the quantity: its label
  double reference = 0;     ///< y of question/quantity/bordered.hpp
  double low = 0;           ///< the ends of the bracket
  std::optional<double> high{};
  TopicKind kind = TopicKind::kQuestion;
  std::string waypoints{};  ///< SHA-256 of their file; empty: the motion follows none
  /// Along way-points. The value of the bracket; nullopt: the kernel serves all values.
  std::optional<double> value{};
  /// The piece that is searched alone; nullopt: all are searched together.
  std::optional<std::uint64_t> piece{};
  /// The unknowns of a closure where the piece begins, approximately.
  std::vector<double> start{};
};

[[nodiscard]] std::string write_topic(const SearchTopic& topic);
/// Accepts any bytes. Throws cluster::MalformedMessage.
[[nodiscard]] SearchTopic read_topic(std::string_view bytes);

/// Tells the topic of the next searches about a motion; `workers` may be null.
void turn_to(cluster::Workers* workers, SearchTopic topic, const Motion& motion);
/// The same, about a piece of its trajectory, or about all.
void turn_to_piece(cluster::Workers* workers, SearchTopic topic, const Motion& motion,
                   std::optional<std::uint64_t> piece);

}  // namespace regulus::detail
