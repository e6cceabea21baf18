/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where a program finds the compiler plugins that is installed elsewhere than they are. */
#ifndef REGULUS_CODEGEN_JIT_PLUGIN_FOLDER_H
#define REGULUS_CODEGEN_JIT_PLUGIN_FOLDER_H

#ifdef __cplusplus
extern "C" {
#endif

/* The folder, or "". A library cannot know where a program that holds it will be: the package
 * compiles an answer of its own into programs that link Regulus::jit, and the linker takes that
 * one. */
const char* regulus_plugin_folder(void);

#ifdef __cplusplus
}
#endif

#endif
