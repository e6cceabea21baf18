// SPDX-License-Identifier: GPL-3.0-or-later
// What the program and its compiler plugins say to each other: plain C, so that neither side sees
// the other's LLVM version, standard library or exceptions.
#pragma once

#include <stddef.h>

/// Changes with every incompatible change of this file; the loader refuses another number.
enum { REGULUS_CLANG_INTERFACE = 4 };

/// Bytes with a length; `data` is also followed by a zero.
typedef struct regulus_bytes {
  const char* data;
  size_t size;
} regulus_bytes;

typedef struct regulus_named_text {
  regulus_bytes name;
  regulus_bytes text;
} regulus_named_text;

/// Everything a compilation depends on. No file of the machine is read.
typedef struct regulus_clang_request {
  regulus_named_text source;          ///< the name is what diagnostics say
  const regulus_named_text* headers;  ///< found by `#include "name"`, and by nothing else
  size_t header_count;
  const char* const* flags;  ///< of the clang++ command line
  size_t flag_count;
  const char* passes;  ///< optimiser pipeline, in the syntax of `opt -passes=`
} regulus_clang_request;

typedef struct regulus_clang_seconds {
  double front_end, optimiser, code_generation;
} regulus_clang_seconds;

/// Where the results go; called before regulus_clang_compile returns, on the same thread.
typedef struct regulus_clang_sink {
  void* state;
  void (*object)(void* state,
                 regulus_bytes object);  ///< on success, once or, by a reader, more often
  void (*diagnostics)(void* state, regulus_bytes diagnostics);  ///< at most once, never empty
  void (*seconds)(void* state, regulus_clang_seconds seconds);  ///< once, on success
} regulus_clang_sink;

/// The symbols a plugin exports.
#define REGULUS_CLANG_INTERFACE_SYMBOL "regulus_clang_interface"
#define REGULUS_CLANG_COMPILE_SYMBOL "regulus_clang_compile"

typedef int (*regulus_clang_interface_function)(void);

/// Compiles a C++ text to a relocatable ELF object for x86-64. Returns 0 on success.
typedef int (*regulus_clang_compile_function)(const regulus_clang_request* request,
                                              const regulus_clang_sink* sink);

/// The text of a kernel, and the name of the instruction set that it is for.
typedef struct regulus_reader_request {
  regulus_bytes text;
  regulus_bytes isa;
  int for_others;              ///< other kernels are to use the objects, too, all but the last
  const regulus_bytes* known;  ///< symbols that need not be defined again, with for_others
  size_t known_count;
} regulus_reader_request;

enum { REGULUS_READER_DONE = 0, REGULUS_READER_FAILED = 1, REGULUS_READER_OUTSIDE = 2 };

#define REGULUS_READER_COMPILE_SYMBOL "regulus_reader_compile"

/// Compiles what is written in the part of C++ that emitted kernels use; nothing but the text and
/// the arithmetic of packs enters. Otherwise REGULUS_READER_OUTSIDE, and the diagnostics say why.
typedef int (*regulus_reader_compile_function)(const regulus_reader_request* request,
                                               const regulus_clang_sink* sink);
