// SPDX-License-Identifier: Apache-2.0
// A regulus_kernel for a pack program; any engine may run the program's functions.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "runtime/kernel/abi.hpp"
#include "runtime/kernel/isa.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::detail::machine {

/// A function of the kernel's table for each row of kKernelFunctions.
using Callers = std::array<regulus_function, kKernelFunctions.size()>;

/// Throws    std::invalid_argument for a program with a fault that find_fault reports.
void require_no_fault(const PackKernel& program);

/// The table of a kernel and all that it points to.
///
/// Requires  find_fault finds none in the program's functions.
class KernelTable {
 public:
  /// `callers` are the functions that the program has; they are called with `context`.
  KernelTable(const PackKernel& program, Isa isa, const Callers& callers, const void* context);
  KernelTable(const KernelTable&) = delete;
  KernelTable& operator=(const KernelTable&) = delete;

  /// Valid for the life of this object.
  [[nodiscard]] const regulus_kernel* get() const noexcept { return &kernel_; }

 private:
  void fill_expansion(const Callers& callers);
  [[nodiscard]] regulus_derivatives derivatives(std::size_t number, const Callers& callers) const;

  std::string identity_;
  PackExpansion expansion_;
  std::vector<double> nominal_;
  regulus_expansion table_{};
  regulus_kernel kernel_{};
};

/// A kernel whose functions are objects of one type.
///
/// Requires  Function has `unsigned run(const double* boxes, const double* points, double* out)
///           const noexcept`, which does what regulus_function says.
template <class Function>
class KernelOf {
 public:
  using Functions = std::array<Function, kKernelFunctions.size()>;

  KernelOf(const PackKernel& program, Isa isa, Functions functions)
      : functions_(std::move(functions)), table_(program, isa, kCallers, &functions_) {}

  [[nodiscard]] const regulus_kernel* get() const noexcept { return table_.get(); }

 private:
  /// The function that the ABI calls: its context is the array of all functions.
  template <std::size_t row>
  static unsigned call(const double* boxes, const double* points, double* out,
                       const void* context) noexcept {
    return (*static_cast<const Functions*>(context))[row].run(boxes, points, out);
  }
  template <std::size_t... row>
  static constexpr Callers make_callers(std::index_sequence<row...>) {
    return {&call<row>...};
  }
  static constexpr Callers kCallers =
      make_callers(std::make_index_sequence<kKernelFunctions.size()>());

  Functions functions_;
  KernelTable table_;
};

}  // namespace regulus::detail::machine
