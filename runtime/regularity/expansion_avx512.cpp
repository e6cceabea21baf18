// SPDX-License-Identifier: Apache-2.0
#include "regulus/regularity/expansion_lanes.hpp"

namespace regulus {

const ExpansionBackend kExpansionAvx512 = expansion::kExpansion;

}  // namespace regulus
