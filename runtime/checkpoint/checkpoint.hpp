// SPDX-License-Identifier: Apache-2.0
// The state of a search, as text; FORMAT.md describes it.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/problem/observer.hpp"

namespace regulus {

/// The question of a checkpoint. Both must agree before a search can continue from it.
struct CheckpointedQuestion {
  std::string identity;  ///< 64 hexadecimal digits: of the model, the variety, the uncertainty, α
  std::size_t splittable = 0;    ///< variables 0 … splittable − 1 differ from box to box
  std::vector<Interval> ranges;  ///< of all variables
};

struct Checkpoint {
  SearchState state;
  std::vector<BoxId> ids;  ///< of the open boxes, in the order in which they would be decided
  std::vector<std::uint32_t> depths;
  std::vector<Interval> boxes;  ///< one after the other, all variables of each

  /// The result refers to this object.
  [[nodiscard]] std::vector<OpenBox> open() const;
};

/// The text is not a checkpoint, is damaged, or has another question; the message says which.
class CheckpointError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns a checkpoint as text. It does not contain the witness of an exhaustive search.
[[nodiscard]] std::string write_checkpoint(const CheckpointedQuestion& question,
                                           const SearchState& state, const OpenBoxes& open);

/// Returns the last line of a checkpoint: the SHA-256 of all lines before it.
[[nodiscard]] std::string end_of_checkpoint(std::string_view before);

/// Accepts any bytes. Throws CheckpointError.
///
/// Ensures   every box lies in the ranges of the question, its ends are in order, its number is
///           below next_id; no number occurs twice.
[[nodiscard]] Checkpoint read_checkpoint(std::string_view text,
                                         const CheckpointedQuestion& question);

}  // namespace regulus
