// SPDX-License-Identifier: Apache-2.0
// A kernel as data: each of its functions is a straight list of the operations of packs
// (runtime/kernel/pack.hpp). C++ text, machine code and the vector machine are made from this list
// and decide nothing, so they give the same bounds to the bit.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/interval/interval.hpp"
#include "runtime/kernel/abi.hpp"
#include "runtime/kernel/kernel_functions.hpp"

namespace regulus::detail::machine {

/// One operation of packs. The letters name the operands: I an interval, P exact doubles, N a
/// count, U the mask of undefined lanes; every list has one mask.
enum class PackOperation : std::uint8_t {
  // These read more than values: a is a number with its own meaning.
  kLoad,         ///< I: variable a of the boxes
  kPoint,        ///< P: entry a of K
  kConstant,     ///< I: constant a
  kExact,        ///< P: constant a, whose bounds are equal
  kFetch,        ///< I: the interval that an earlier part keeps in slot a
  kKeep,         ///< keeps the interval b in slot a; no value
  kStore,        ///< stores the interval c as the outputs a to b; no value
  kThin_P,       ///< I
  kPointOf_I,    ///< P: for an interval that is a point
  kNegate_P,     ///< P
  kExactAdd_PP,  ///< P; so are all others named exact
  kExactSub_PP,
  kExactMul_PP,
  kExactMulAdd_PPP,  ///< a·b + c
  kNegate_I,         ///< I; so are all that follow
  kAdd_II,
  kAdd_IP,
  kAdd_PI,
  kAdd_PP,
  kSubtract_II,
  kSubtract_IP,
  kSubtract_PI,
  kSubtract_PP,
  kMultiply_II,
  kMultiply_IP,
  kMultiply_PI,
  kMultiply_PP,
  kMulAdd_III,  ///< a·b + c, rounded once
  kMulAdd_IPI,
  kMulAdd_PII,
  kMulAdd_PPI,
  kSqr_I,
  kPow_IN,  ///< a^b; b ≥ 2 is the exponent itself
  kAbs_I,
  kSin_I,
  kCos_I,
  kAtan_I,
  kSinCos_I,  ///< the sine; the next instruction is kCosine, the cosine of the same argument
  kCosine,    ///< a: the preceding instruction
  kChecked_IU,
  kDiv_IIU,
  kSqrt_IU,
  kTan_IU,
  kAsin_IU,
  kAcos_IU,
  kAtan2_IIU,
  kExp_IU,
  kLog_IU,
};

inline constexpr std::size_t kPackOperations = static_cast<std::size_t>(PackOperation::kLog_IU) + 1;

/// Returns how many of a, b and c are values, from a on. kKeep and kStore read one value elsewhere.
[[nodiscard]] int operand_count(PackOperation operation) noexcept;

/// The number of an instruction in its function; its result is the value of that number.
using ValueId = std::uint32_t;

struct PackInstruction {
  PackOperation operation;
  std::uint32_t a = 0, b = 0, c = 0;

  friend bool operator==(const PackInstruction&, const PackInstruction&) = default;
};

/// A straight list of instructions, cut into parts. Only its own part reads a value, after its
/// instruction. A value that a later part needs is kept in a slot.
struct PackFunction {
  std::vector<PackInstruction> code;
  std::vector<std::uint32_t> part_ends;  ///< one past the last instruction of each part
  std::vector<Interval> constants;
  std::uint32_t slots = 0;
  std::uint32_t outputs = 0;
};

/// Describes the fault of a list; empty if it can be run. It can be run if operands have the right
/// type and come from the same part and from before; numbers are within `variables`, `points` and
/// the list's own sizes; a slot is written before it is read, and not again by a part that reads
/// it; constants have bounds in order; every output is stored once.
[[nodiscard]] std::string find_fault(const PackFunction& function, std::uint32_t variables,
                                     std::uint32_t points);

/// A list of derivatives of a function of the expansion; see regulus_derivatives.
struct PackDerivatives {
  KernelFunction function = KernelFunction::kNominalFirst;
  std::vector<regulus_derivative> list;  ///< empty: there is no such function
};

/// See regulus_expansion.
struct PackExpansion {
  KernelFunction product = KernelFunction::kNominalProduct;
  std::array<PackDerivatives, 4> derivatives;  ///< first, second, row_first, row_second
  std::vector<int> row_of_variable;
  std::vector<int> ball_of_variable;  ///< empty: there are no balls
  std::vector<Interval> nominal;      ///< or empty
};

/// All data of a kernel except its machine code; see regulus_kernel.
struct PackKernel {
  std::uint32_t variables = 0, motion_variables = 0;
  std::uint32_t rows = 0, columns = 0;
  std::uint32_t constraints = 0, pose_parameters = 0;
  std::array<PackFunction, kKernelFunctions.size()> functions;  ///< without outputs: none
  bool has_expansion = false;
  PackExpansion expansion;
  std::string identity;
};

/// Describes the fault of a kernel; empty if a search can use it. Then find_fault reports nothing
/// about its functions, each has the outputs that regulus_kernel states for the kernel's sizes, and
/// the lists of the expansion name variables and entries that exist.
[[nodiscard]] std::string find_fault(const PackKernel& kernel);

}  // namespace regulus::detail::machine
