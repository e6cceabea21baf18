// SPDX-License-Identifier: Apache-2.0
// Everything about one interval of doubles.
#pragma once

#include "regulus/interval/arithmetic.hpp"  // IWYU pragma: export
#include "regulus/interval/elementary.hpp"  // IWYU pragma: export
#include "regulus/interval/rounding.hpp"    // IWYU pragma: export
#include "regulus/interval/type.hpp"        // IWYU pragma: export
