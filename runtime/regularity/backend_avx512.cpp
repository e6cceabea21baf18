// SPDX-License-Identifier: Apache-2.0
#include "runtime/regularity/backend_lanes.hpp"

namespace regulus::detail {

const RegularityBackend kRegularityAvx512 = regularity::kBackend;

}  // namespace regulus::detail
