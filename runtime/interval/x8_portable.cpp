// SPDX-License-Identifier: Apache-2.0
#include "runtime/interval/x8_lanes.hpp"

namespace regulus::detail {

const X8Backend kX8Portable = elementary::kBackend;

}  // namespace regulus::detail
