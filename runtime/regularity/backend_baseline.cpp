// SPDX-License-Identifier: Apache-2.0
#include "regulus/regularity/backend_lanes.hpp"

namespace regulus {

const RegularityBackend kRegularityBaseline = regularity::kBackend;

}  // namespace regulus
