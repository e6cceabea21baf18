// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "codegen/answer/certificate/verify_file.hpp"

namespace regulus::detail {

/// Returns the report of `regulus verify --json`. Its texts may have any bytes.
[[nodiscard]] nlohmann::ordered_json json_verification(const VerificationRequest& request,
                                                       const verifier::Verification& v);

}  // namespace regulus::detail
