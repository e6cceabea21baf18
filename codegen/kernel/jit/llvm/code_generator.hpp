// SPDX-License-Identifier: GPL-3.0-or-later
// Generates an object from LLVM's intermediate code: the last stage of both plugins.
#pragma once

#include <llvm/ADT/SmallVector.h>
#include <llvm/IR/Module.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/Target/TargetMachine.h>

#include <memory>
#include <string>

namespace regulus::detail::plugin {

/// Call it once per process. A fatal error of LLVM ends the process as an internal fault.
void initialise_llvm();

/// Makes a target without a processor's name: the oldest processor of the triple, plus the
/// features. `optimises_code`: takes longer to choose registers and the order of instructions.
[[nodiscard]] std::unique_ptr<llvm::TargetMachine> make_target_machine(const std::string& triple,
                                                                       const std::string& cpu,
                                                                       const std::string& features,
                                                                       llvm::raw_ostream& errors,
                                                                       bool optimises_code = false);

/// Runs the passes, in the syntax of `opt -passes=`, and no others.
[[nodiscard]] bool optimise(llvm::Module& module, llvm::TargetMachine& machine, const char* passes,
                            llvm::raw_ostream& errors);

/// Selects whether equal computations in a straight list are joined, such as masks of signs that
/// several operations use. This cannot merge two roundings: only calls that are equal in every
/// argument, including the rounding, are joined, and constrained arithmetic of dynamic rounding is
/// not changed.
enum class Repeated { kAsTheyAre, kJoined };

/// For a search, code generation runs without optimisation: a kernel is straight-line code without
/// common sub-expressions, in which the default pipeline finds little and takes most of the time.
[[nodiscard]] bool generate_code(llvm::Module& module, llvm::TargetMachine& machine,
                                 llvm::SmallVectorImpl<char>& object, llvm::raw_ostream& errors,
                                 Repeated repeated = Repeated::kAsTheyAre);

}  // namespace regulus::detail::plugin
