// SPDX-License-Identifier: GPL-3.0-or-later
// The stages of every question about a load along way-points: a search of all pieces, then searches
// of single ones.
#pragma once

#include <chrono>

#include "codegen/question/load/way_forces.hpp"
#include "codegen/question/way/path_parts.hpp"

namespace regulus::detail {

/// What the search of all pieces has found out about one.
struct PieceForces {
  bool is_held = true;      ///< nothing speaks against it
  bool is_within = false;   ///< the load is held on some of its parts
  bool is_outside = false;  ///< some parts lie outside the constraints
  std::uint32_t boxes = 0;
};

class WayForceStage {
 public:
  /// All must live as long as this. `found`: with the request.
  WayForceStage(WayForces& found, const std::string& load, const SearchOptions& search,
                bool wants_trees, const PathWatch& watch);

  /// Prepares the kernel of all pieces and searches them. Throws as prepare_forces().
  void search_all(double model_seconds);

  /// A search of one piece over its exact parameter.
  struct Alone {
    PreparedForces prepared;
    FeasibilityResult result;
  };
  /// `resolution`: of a paving; 0: it is none. `tree` may be null. Throws as prepare_forces().
  [[nodiscard]] Alone search_piece(std::size_t piece, double resolution,
                                   const ForceListener& listener, Observer* tree);

  [[nodiscard]] std::vector<PieceForces>& pieces() noexcept { return pieces_; }
  /// True if an interrupt or a limit has ended all searches. WayForces::reason and `deciding` then
  /// say why, and where.
  [[nodiscard]] bool must_stop(std::size_t piece);
  [[nodiscard]] bool has_ended() const noexcept { return has_ended_; }

 private:
  [[nodiscard]] double seconds_left() const;
  void end(std::size_t piece, Reason reason);
  void search_together();

  WayForces& found_;
  const std::string& load_;
  const SearchOptions& search_;
  const bool wants_trees_;
  const PathWatch watch_;
  const PathBounds path_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<PieceForces> pieces_;
  bool has_ended_ = false;
};

}  // namespace regulus::detail
