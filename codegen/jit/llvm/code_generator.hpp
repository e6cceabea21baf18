// SPDX-License-Identifier: GPL-3.0-or-later
// From LLVM's intermediate code to an object: what both plugins end with.
#pragma once

#include <llvm/ADT/SmallVector.h>
#include <llvm/IR/Module.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/Target/TargetMachine.h>

#include <memory>
#include <string>

namespace regulus::inline jit::plugin {

/// Once per process. A fatal error of LLVM ends the process as an internal fault.
void initialise_llvm();

/// Without a processor's name: the oldest of the triple, plus the features.
[[nodiscard]] std::unique_ptr<llvm::TargetMachine> make_target_machine(const std::string& triple,
                                                                       const std::string& cpu,
                                                                       const std::string& features,
                                                                       llvm::raw_ostream& errors);

/// Runs the passes, in the syntax of `opt -passes=`, and no others.
[[nodiscard]] bool optimise(llvm::Module& module, llvm::TargetMachine& machine, const char* passes,
                            llvm::raw_ostream& errors);

/// Equal computations in a straight list can be made one: masks of signs that several operations
/// look at. That cannot merge two roundings: calls are joined that are equal in every argument, the
/// rounding included, and constrained arithmetic of dynamic rounding is left alone.
enum class Repeated { kAsTheyAre, kJoined };

/// Code generation runs without optimisation: a kernel is straight-line code without common
/// sub-expressions, in which the default pipeline finds nothing but spends most of the time.
[[nodiscard]] bool generate_code(llvm::Module& module, llvm::TargetMachine& machine,
                                 llvm::SmallVectorImpl<char>& object, llvm::raw_ostream& errors,
                                 Repeated repeated = Repeated::kAsTheyAre);

}  // namespace regulus::inline jit::plugin
