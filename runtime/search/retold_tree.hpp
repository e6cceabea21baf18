// SPDX-License-Identifier: Apache-2.0
// Tells an observer again of a search for regularity, from its tree (saved_tree.hpp). Nothing but
// the splits is a fact: each leaf that claims something is judged again.
//
// The bound of a leaf in the tree is a number for its rule and its reason.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "runtime/problem/observer.hpp"
#include "runtime/search/saved_tree.hpp"

namespace regulus::detail {

/// Returns the bound that stands for a leaf.
[[nodiscard]] double bound_of_leaf(Rule rule, Reason reason) noexcept;

/// What the leaves show that were told.
struct RetoldTree {
  std::array<std::uint64_t, kRules> leaves{};  ///< told, by rule
  std::vector<std::uint64_t> filter_boxes;     ///< of these, by filter
  std::optional<Witness> witness;              ///< the first
  Reason witness_reason = Reason::kOppositeSigns;
  std::optional<BoxId> blocked;  ///< a leaf that claims nothing, as a search names it
  Reason blocked_reason = Reason::kWidth;
  std::vector<BoxId> reopened;  ///< leaves that were not told: no test certified them again
  bool is_complete = true;      ///< false: an interrupt, the time or memory ended it early
};

/// Tells of splits and leaves in their order, but for leaves that are not certified again. A leaf has
/// the rule of the text if that belongs to the same kind of claim.
///
/// Requires  find_fault finds no fault; the tree is one of the problem's.
/// Ensures   each leaf that is told has been judged with these settings, if it claims something.
/// Throws    SavedTreeError if a leaf has no rule, or an interval cannot be halved.
[[nodiscard]] RetoldTree tell_again(const RestoredTree& tree, const Problem& problem,
                                    const Settings& settings, Observer& observer);

}  // namespace regulus::detail
