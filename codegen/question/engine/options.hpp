// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a search, as on the command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "codegen/kernel/program/budgets.hpp"
#include "runtime/kernel/isa.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus {
namespace detail {
class PartStore;
}  // namespace detail

/// kAuto: compiled if the cache has the kernel; otherwise interpreted, and compiled in parallel
/// with a long search. kJit: built with LLVM from the list of operations. kClang: the C++ text,
/// compiled by Clang in this process; this takes longer and computes the same bits.
enum class Engine { kAuto, kJit, kClang, kInterpreted };

/// After this many boxes the kernel is compiled. The time saved for each box pays for the
/// compilation within 65 000 to 80 000 boxes, whatever the size of the kernel
/// (runtime/PERFORMANCE.md). Compilation takes half the time of this many interpreted boxes in one
/// thread, so even if the search ends just after compilation began, the wait is shorter than the
/// search.
inline constexpr std::uint64_t kBoxesBeforeCompiling = 50'000;

/// The options of a search.
struct SearchOptions {
  Method method = Method::kAuto;
  Determinant determinant = Determinant::kBoth;
  std::optional<Entries> entries;  ///< nullopt: as the method needs
  Bisection bisection = Bisection::kImpact;
  std::vector<std::string> weights;  ///< NAME=W, of ranges, for Bisection::kWeighted
  Uncertainty uncertainty = Uncertainty::kElements;
  Engine engine = Engine::kJit;
  std::optional<Isa> isa;  ///< nullopt: the best of this processor
  bool use_cache = true;
  std::vector<std::string> filters;  ///< shared objects
  /// The C++ text of the kernel, edited by a person; compiled by Clang, whatever `engine` is. Empty:
  /// the text of the model. Only for check.
  std::string kernel;
  std::vector<std::string> without;                    ///< see ingredients.hpp
  std::uint64_t max_boxes = 0;                         ///< 0: no bound
  unsigned threads = 0;                                ///< 0: as many as there are processors
  detail::cluster::Workers* workers = nullptr;         ///< in the place of threads
  double time_limit = 0;                               ///< seconds, 0: no bound
  std::uint64_t symbolic_budget = kDeterminantBudget;  ///< terms of a closed form
  long precision = 1024;                               ///< most bits if doubles cannot decide
  detail::PartStore* parts = nullptr;                  ///< of kernels compiled before
  /// For Engine::kAuto. 0: the kernel is compiled before the search, and interpreted only if there
  /// is no compiler.
  std::uint64_t boxes_before_compiling = kBoxesBeforeCompiling;
  bool threshold = false;  ///< α may be raised above 0 once the kernel is formed
};

struct CheckpointOptions {
  std::string path;      ///< empty: none
  double interval = 10;  ///< seconds
};

}  // namespace regulus
