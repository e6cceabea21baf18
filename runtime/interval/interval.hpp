// SPDX-License-Identifier: Apache-2.0
// Everything about one interval of doubles.
#pragma once

#include "runtime/interval/arithmetic.hpp"  // IWYU pragma: export
#include "runtime/interval/elementary.hpp"  // IWYU pragma: export
#include "runtime/interval/rounding.hpp"    // IWYU pragma: export
#include "runtime/interval/type.hpp"        // IWYU pragma: export
