// SPDX-License-Identifier: Apache-2.0
// A kernel as data: for each of its functions a straight list of the operations that packs have
// (runtime/kernel/pack.hpp). C++ text, machine code and the vector machine are made from this list
// and decide nothing, so that they give the same bounds to the bit.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/interval/interval.hpp"
#include "runtime/kernel/abi.hpp"
#include "runtime/kernel/kernel_functions.hpp"

namespace regulus::machine {

/// One operation of packs. The letters say of what: I an interval, P exact doubles, N a count, U
/// the mask of undefined lanes, which every list has one of.
enum class PackOperation : std::uint8_t {
  // What an instruction reads besides values: a is a number of its own.
  kLoad,         ///< I: variable a of the boxes
  kPoint,        ///< P: entry a of K
  kConstant,     ///< I: constant a
  kExact,        ///< P: constant a, whose bounds are equal
  kFetch,        ///< I: what an earlier part keeps in slot a
  kKeep,         ///< keeps the interval b in slot a; no value
  kStore,        ///< stores the interval c as the outputs a to b; no value
  kThin_P,       ///< I
  kPointOf_I,    ///< P: of an interval that is a point
  kNegate_P,     ///< P
  kExactAdd_PP,  ///< P, as all that say exact
  kExactSub_PP,
  kExactMul_PP,
  kExactMulAdd_PPP,  ///< a·b + c
  kNegate_I,         ///< I, as all that follow
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
  kPow_IN,  ///< a^b, b ≥ 2 the number itself
  kAbs_I,
  kSin_I,
  kCos_I,
  kAtan_I,
  kSinCos_I,  ///< the sine; the next instruction is kCosine, the cosine of the same argument
  kCosine,    ///< a: the instruction before
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

/// How many of a, b and c are values, counted from a. kKeep and kStore read one value elsewhere.
[[nodiscard]] int operand_count(PackOperation operation) noexcept;

/// The number of an instruction in its function; its result is the value of that number.
using ValueId = std::uint32_t;

struct PackInstruction {
  PackOperation operation;
  std::uint32_t a = 0, b = 0, c = 0;

  friend bool operator==(const PackInstruction&, const PackInstruction&) = default;
};

/// A straight list of instructions, cut into parts. A value is read by its own part alone, after
/// its instruction; what a later part needs is kept in a slot.
struct PackFunction {
  std::vector<PackInstruction> code;
  std::vector<std::uint32_t> part_ends;  ///< one past the last instruction of each part
  std::vector<Interval> constants;
  std::uint32_t slots = 0;
  std::uint32_t outputs = 0;
};

/// What is wrong with a list, in words; empty for one that can be run: operands of the right kind
/// from the same part and from before, numbers within `variables`, `points` and the list's own
/// sizes, a slot written before it is read and not again by a part that reads it, constants with
/// bounds in order, every output stored once.
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

/// All of a kernel but for its machine code; see regulus_kernel.
struct PackKernel {
  std::uint32_t variables = 0, motion_variables = 0;
  std::uint32_t rows = 0, columns = 0;
  std::uint32_t constraints = 0, pose_parameters = 0;
  std::array<PackFunction, kKernelFunctions.size()> functions;  ///< without outputs: none
  bool has_expansion = false;
  PackExpansion expansion;
  std::string identity;
};

/// What is wrong with a kernel, in words; empty for one that a search can be given: find_fault has
/// nothing to say about its functions, each has the outputs that regulus_kernel states for the
/// kernel's sizes, and the lists of the expansion name variables and entries that exist.
[[nodiscard]] std::string find_fault(const PackKernel& kernel);

}  // namespace regulus::machine
