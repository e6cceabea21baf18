// SPDX-License-Identifier: GPL-3.0-or-later
// The interface between the program and its compiler plugins. Plain C, so that neither side depends
// on the other's LLVM version, standard library or exceptions.
#pragma once

#include <stddef.h>

/// Changes with every incompatible change of this file; the loader refuses another number.
enum { REGULUS_CLANG_INTERFACE = 8 };

/// What a compilation returns if memory ran out, which says nothing about the text.
enum { REGULUS_CLANG_NO_MEMORY = 2 };

/// Bytes with a length; `data` is also followed by a zero.
typedef struct regulus_bytes {
  const char* data;
  size_t size;
} regulus_bytes;

typedef struct regulus_named_text {
  regulus_bytes name;
  regulus_bytes text;
} regulus_named_text;

/// All inputs of a compilation. No file of the machine is read.
typedef struct regulus_clang_request {
  regulus_named_text source;          ///< the name appears in diagnostics
  const regulus_named_text* headers;  ///< found only by `#include "name"`
  size_t header_count;
  const char* const* flags;  ///< of the clang++ command line
  size_t flag_count;
  const char* passes;  ///< optimiser pipeline, in the syntax of `opt -passes=`
  int optimises_code;  ///< not 0: code generation is optimised
} regulus_clang_request;

typedef struct regulus_clang_seconds {
  double front_end, optimiser, code_generation;
} regulus_clang_seconds;

/// Receives the results; called before regulus_clang_compile returns, on the same thread.
typedef struct regulus_clang_sink {
  void* state;
  void (*object)(void* state, regulus_bytes object);            ///< on success; once for each part
  void (*diagnostics)(void* state, regulus_bytes diagnostics);  ///< at most once, never empty
  void (*seconds)(void* state, regulus_clang_seconds seconds);  ///< once, on success
} regulus_clang_sink;

/// The symbols a plugin exports.
#define REGULUS_CLANG_INTERFACE_SYMBOL "regulus_clang_interface"
#define REGULUS_CLANG_COMPILE_SYMBOL "regulus_clang_compile"
#define REGULUS_CLANG_LOAD_SYMBOL "regulus_clang_load"

typedef int (*regulus_clang_interface_function)(void);

/// Compiles a C++ text to a relocatable ELF object for x86-64. Returns 0 on success.
typedef int (*regulus_clang_compile_function)(const regulus_clang_request* request,
                                              const regulus_clang_sink* sink);

/// A function of this process that an object may call.
typedef struct regulus_external {
  const char* name;
  const void* address;
} regulus_external;

/// The object in memory.
typedef struct regulus_loaded {
  void* state;
  void* (*find)(void* state, regulus_bytes name, size_t size);  ///< null: no such symbol
  void (*unload)(void* state);
} regulus_loaded;

/// Loads an object of regulus_clang_compile by LLVM's linker. Returns 0 on success; otherwise the
/// sink has the reason.
typedef int (*regulus_clang_load_function)(regulus_bytes object, const regulus_external* externals,
                                           size_t external_count, const regulus_clang_sink* sink,
                                           regulus_loaded* loaded);

/// Parts of pack programs (part.hpp), and the name of their instruction set.
typedef struct regulus_parts_request {
  const regulus_bytes* parts;
  size_t part_count;
  regulus_bytes isa;
} regulus_parts_request;

#define REGULUS_PARTS_COMPILE_SYMBOL "regulus_parts_compile"

/// Compiles each part to flat code (part.hpp); the sink gets them in their order. Returns 0 on
/// success.
typedef int (*regulus_parts_compile_function)(const regulus_parts_request* request,
                                              const regulus_clang_sink* sink);
