// SPDX-License-Identifier: GPL-3.0-or-later
// Compiled into programs that link Regulus::jit: where this package has the compiler plugins
// (codegen/kernel/jit/plugin_folder.h).
#include "codegen/kernel/jit/plugin_folder.h"

extern "C" const char* regulus_plugin_folder() { return REGULUS_PLUGIN_FOLDER; }
