// SPDX-License-Identifier: GPL-3.0-or-later
// The platform of a claim about all its poses: runtime/proof/FORMAT.md, "All solutions".
#pragma once

#include <string>

#include "codegen/model/request.hpp"

namespace regulus::detail {

/// A platform as the lines of a certificate state it.
struct CertifiedLegs {
  std::string lines;  ///< `constant`, `uncertain`, `ball` if there are tolerances or errors; `leg`
  std::size_t uncertain = 0;  ///< quantities and errors
};

/// Requires  the request has legs, and its motion a place.
[[nodiscard]] CertifiedLegs certified_legs(const Request& request);

[[nodiscard]] inline bool is_in_plane(const Request& request) {
  return request.model.legs.size() == 3;
}

}  // namespace regulus::detail
