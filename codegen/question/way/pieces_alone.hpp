// SPDX-License-Identifier: GPL-3.0-or-later
// The second stage of a question about a trajectory: the pieces that a search of all has left open
// are searched alone.
#pragma once

#include <cstddef>
#include <cstdint>

namespace regulus::detail {

/// After so many pieces without an answer, no more are searched alone.
inline constexpr std::size_t kMostUndecidedPieces = 8;

enum class PieceAnswer : std::uint8_t {
  kProved,   ///< the claim holds on the piece
  kRefuted,  ///< it does not: no other piece matters
  kOpen,     ///< neither was shown
  kStopped,  ///< the same, and nothing more can be searched
};

/// Asks about the pieces that are open, in their order, as long as the answer for the trajectory is
/// not known. `is_open`: piece → bool; `ask`: piece → PieceAnswer.
template <class IsOpen, class Ask>
void ask_pieces_alone(std::size_t pieces, const IsOpen& is_open, const Ask& ask) {
  std::size_t undecided = 0;
  for (std::size_t k = 0; k < pieces; ++k) {
    if (!is_open(k)) continue;
    const PieceAnswer answer = ask(k);
    if (answer == PieceAnswer::kRefuted || answer == PieceAnswer::kStopped) return;
    if (answer == PieceAnswer::kOpen && ++undecided == kMostUndecidedPieces) return;
  }
}

}  // namespace regulus::detail
