// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace regulus::detail {

/// Binds locate() and what it returns.
void bind_pavings(pybind11::module_& module);

}  // namespace regulus::detail
