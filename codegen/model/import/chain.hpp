// SPDX-License-Identifier: GPL-3.0-or-later
// The chain of joints between two links.
#pragma once

#include <string>
#include <vector>

#include "codegen/model/import/mechanism.hpp"

namespace regulus::detail {

/// Joints from a base to a tip, each the parent of the next.
struct Chain {
  std::string base, tip;
  std::vector<const ImportedJoint*> joints;  ///< of the mechanism
};

/// Finds the chain. An empty name stands for the only link that can be meant: the only root, the tip
/// behind which no further joint moves.
///
/// Throws    InputError, with the links to choose from; for a joint on the chain that has another
///           type, or follows another joint; for a link with two parents.
[[nodiscard]] Chain find_chain(const Mechanism& mechanism, const std::string& file,
                               const std::string& base, const std::string& tip);

}  // namespace regulus::detail
