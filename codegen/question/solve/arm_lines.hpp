// SPDX-License-Identifier: GPL-3.0-or-later
// What a certificate says of an arm at a place.
#pragma once

#include <string>

#include "codegen/model/request.hpp"
#include "codegen/question/solve/solutions.hpp"

namespace regulus::detail {

struct CertifiedArm {
  std::string robot;  ///< what the claim calls it
  std::string lines;
};

/// `solutions`: its unknowns are the joints that are free.
[[nodiscard]] CertifiedArm certified_arm(const Request& request, const Solutions& solutions);

}  // namespace regulus::detail
