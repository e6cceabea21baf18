// SPDX-License-Identifier: Apache-2.0
#include "regulus/interval/x8_lanes.hpp"

namespace regulus {

const X8Backend kX8Avx512 = elementary::for_avx512::kBackend;

}  // namespace regulus
