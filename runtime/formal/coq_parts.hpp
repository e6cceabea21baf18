// SPDX-License-Identifier: Apache-2.0
// The parts of a set that a theorem about a paving keeps, in the words of Parts.v.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/formal/coq_tree.hpp"

namespace regulus::verifier {

/// Says if the theorem keeps a leaf with this word. A leaf outside the set may be in any part.
using IsKept = std::function<bool(std::string_view)>;

/// Returns the parts of a tree. Parts beside each other that have the same fate are one.
[[nodiscard]] std::string coq_parts(const TreeOfBoxes& boxes, const IsKept& is_kept);

/// Returns the definition of parts, or that of a list of parts, if there are pieces.
[[nodiscard]] std::string coq_parts_definition(const std::string& comment, const std::string& name,
                                               const std::vector<TreeOfBoxes>& trees,
                                               bool has_pieces, const IsKept& is_kept);

}  // namespace regulus::verifier
