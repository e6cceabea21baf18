// SPDX-License-Identifier: GPL-3.0-or-later
// A kernel as files, from which a program that checks a robot is built without this program.
#pragma once

#include <string>
#include <vector>

#include "codegen/model/request.hpp"
#include "runtime/kernel/isa.hpp"

namespace regulus::detail {

struct GenerateOptions {
  std::string name;        ///< of the files and of the symbols in them: a C identifier
  std::string name_space;  ///< of the C++ header, such as "plant::robot"; empty: as `name`
  std::vector<Isa> isas;   ///< besides the portable one, which is always among them
  std::string command;     ///< the command line, for the files' first lines
};

struct GeneratedFile {
  std::string name;
  std::string text;
};

/// Returns the default name of the files of a model's motion: "robot_1_wide_15".
[[nodiscard]] std::string default_kernel_name(const Request& request);

/// Returns the files of a kernel: NAME.h and NAME.hpp, the check in C and in C++; NAME.cpp, which
/// chooses the instruction set at run time; NAME_kernel.inc, the kernel as emit() writes it, and
/// NAME_<isa>.cpp, which compiles it for one instruction set.
///
/// Ensures   equal requests and options give equal bytes. Names of the model appear outside
///           comments only as identifiers, and never as a keyword.
/// Throws    UsageError if the names, or a motion without a range, do not allow such files;
///           InputError.
[[nodiscard]] std::vector<GeneratedFile> generate(const Request& request,
                                                  const GenerateOptions& options);

}  // namespace regulus::detail
