// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace regulus::detail {

/// Adds check_load, locate_load and their results to the module.
void bind_loads(pybind11::module_& module);

}  // namespace regulus::detail
