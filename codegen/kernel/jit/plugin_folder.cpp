// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/plugin_folder.h"

// Alone in its file, so that the linker omits it if the program defines the function.
extern "C" const char* regulus_plugin_folder() { return ""; }
