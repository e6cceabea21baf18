/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The folder of the compiler plugins, for programs that are installed elsewhere. */
#ifndef REGULUS_CODEGEN_JIT_PLUGIN_FOLDER_H
#define REGULUS_CODEGEN_JIT_PLUGIN_FOLDER_H

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the folder, or "". A library cannot know the place of the program that links it, so the
 * package compiles its own definition into programs that link Regulus::jit, and the linker takes
 * that one. */
const char* regulus_plugin_folder(void);

#ifdef __cplusplus
}
#endif

#endif
