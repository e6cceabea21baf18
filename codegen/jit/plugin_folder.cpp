// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/jit/plugin_folder.h"

// Alone in its file: left out by the linker where the program has the function.
extern "C" const char* regulus_plugin_folder() { return ""; }
