// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace regulus::detail {

/// Binds the questions about all solutions, and their findings.
void bind_solutions(pybind11::module_& module);

}  // namespace regulus::detail
