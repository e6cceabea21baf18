// SPDX-License-Identifier: Apache-2.0
#include "runtime/kernel/call.hpp"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "runtime/kernel/rounding_scope.hpp"

namespace regulus::detail {
namespace {

// Pairs of lanes: every 64-bit processor compares two doubles in one instruction.
using Pair = double __attribute__((vector_size(16), may_alias));
using PairMask = long long __attribute__((vector_size(16)));
constexpr std::size_t kPairs = kLanes / 2;

const Pair* row(const double* rows, std::size_t index) {
  return reinterpret_cast<const Pair*>(rows + kLanes * index);
}

/// Collects the lanes in which some `good` mask had a 0.
class LaneCheck {
 public:
  void require(std::size_t pair, PairMask good) noexcept { good_[pair] &= good; }
  [[nodiscard]] LaneMask failed() const noexcept {
    LaneMask lanes = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      if (good_[lane / 2][lane % 2] == 0) lanes |= 1u << lane;
    return lanes;
  }

 private:
  PairMask good_[kPairs] = {{-1, -1}, {-1, -1}, {-1, -1}, {-1, -1}};
};

/// Returns the power of two at or below each x ≥ 0; 0 for 0.
Pair power_of_two_below(Pair x) {
  constexpr long long kExponent = 0x7ff0000000000000;
  return reinterpret_cast<Pair>(reinterpret_cast<PairMask>(x) & kExponent);
}

Pair magnitude(Pair x) {
  constexpr long long kWithoutSign = 0x7fffffffffffffff;
  return reinterpret_cast<Pair>(reinterpret_cast<PairMask>(x) & kWithoutSign);
}

/// Let 2^L be the power of two below the greatest entry. The finest grid that the contract allows
/// is 2^(L+1−REGULUS_POINT_BITS). Adding and subtracting 1.5·2^52 times that keeps a multiple of it
/// and changes any other number, in any rounding mode.
void require_grid(LaneCheck& check, const double* entries, unsigned length, std::size_t pair) {
  constexpr double kAnchor = 1.5 * static_cast<double>(1ULL << (53 - REGULUS_POINT_BITS));
  constexpr Pair least = {0x1p-800, 0x1p-800};
  static_assert(REGULUS_LEAST_POINT_EXPONENT == -800);
  Pair greatest = {0.0, 0.0};
  for (std::size_t p = 0; p < length; ++p) {
    const Pair size = magnitude(row(entries, p)[pair]);
    greatest = size > greatest ? size : greatest;
  }
  const Pair anchor = power_of_two_below(greatest) * kAnchor;
  check.require(pair, (greatest >= least) | (greatest == Pair{0.0, 0.0}));
  for (std::size_t p = 0; p < length; ++p) {
    const Pair entry = row(entries, p)[pair];
    check.require(pair, (entry + anchor) - anchor == entry);
  }
}

[[noreturn]] void refuse(const std::string& reason) {
  throw std::invalid_argument("kernel refused: " + reason);
}

}  // namespace

// Every comparison is false for a NaN, so a NaN is outside.
LaneMask lanes_outside_contract(const double* boxes, unsigned variables) noexcept {
  constexpr Pair limit = {kMaxBoxMagnitude, kMaxBoxMagnitude};
  LaneCheck check;
  for (std::size_t v = 0; v < variables; ++v) {
    const Pair* const lo = row(boxes, 2 * v);
    const Pair* const hi = row(boxes, 2 * v + 1);
    for (std::size_t pair = 0; pair < kPairs; ++pair)
      check.require(pair, (lo[pair] >= -limit) & (hi[pair] <= limit) & (lo[pair] <= hi[pair]));
  }
  return check.failed();
}

LaneMask point_lanes_outside_contract(const double* points, unsigned rows,
                                      unsigned length) noexcept {
  constexpr Pair limit = {kMaxPointMagnitude, kMaxPointMagnitude};
  LaneCheck check;
  for (std::size_t p = 0; p < std::size_t{rows} * length; ++p) {
    const Pair* const values = row(points, p);
    for (std::size_t pair = 0; pair < kPairs; ++pair)
      check.require(pair, (values[pair] >= -limit) & (values[pair] <= limit));
  }
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t pair = 0; pair < kPairs; ++pair)
      require_grid(check, points + kLanes * length * i, length, pair);
  return check.failed();
}

CheckedKernel::CheckedKernel(const regulus_kernel& kernel) : kernel_(&kernel) {
  if (kernel.abi != REGULUS_KERNEL_ABI)
    refuse("made for ABI " + std::to_string(kernel.abi) + ", this runtime has ABI " +
           std::to_string(REGULUS_KERNEL_ABI));
  if (kernel.rounding != REGULUS_ROUND_NEAREST && kernel.rounding != REGULUS_ROUND_UPWARD)
    refuse("unknown rounding " + std::to_string(kernel.rounding));
  if (kernel.columns == 0 || kernel.rows < kernel.columns)
    refuse(std::to_string(kernel.rows) + " rows and " + std::to_string(kernel.columns) +
           " columns");
  if (kernel.motion_variables > kernel.variables)
    refuse(std::to_string(kernel.motion_variables) + " motion parameters among " +
           std::to_string(kernel.variables) + " variables");
  if (kernel.matrix == nullptr) refuse("it has no function for the matrix");
}

LaneMask CheckedKernel::call(regulus_function function, const double* boxes, const double* points,
                             double* out) const noexcept {
  if (function == nullptr) return kAllLanes;
  LaneMask outside = lanes_outside_contract(boxes, kernel_->variables);
  if (points != nullptr)
    outside |= point_lanes_outside_contract(points, kernel_->columns, kernel_->rows);
  const LaneMask undefined = call_within_contract(function, boxes, points, out);
  if (outside != 0) forget(function, outside, out);
  return outside | undefined;
}

LaneMask CheckedKernel::call_within_contract(regulus_function function, const double* boxes,
                                             const double* points, double* out) const noexcept {
  LaneMask undefined;
  {
    const RoundingScope scope(kernel_->rounding);
    undefined = function(boxes, points, out, kernel_->context);
  }
  if (undefined != 0) forget(function, undefined, out);
  return undefined;
}

std::size_t CheckedKernel::count_outputs(regulus_function function) const noexcept {
  const regulus_kernel& k = *kernel_;
  const std::size_t mn = std::size_t{k.rows} * k.columns;
  const std::size_t nn = std::size_t{k.columns} * k.columns;
  const std::size_t mm = std::size_t{k.rows} * k.rows;
  std::size_t least = SIZE_MAX;
  const auto note = [&](regulus_function candidate, std::size_t outputs) {
    if (candidate == function && outputs < least) least = outputs;
  };
  note(k.matrix, mn);
  note(k.matrix_derivatives, k.variables * mn);
  note(k.left_product, nn);
  note(k.left_derivatives, k.variables * nn);
  note(k.right_product, mm);
  note(k.row_scale, 1);
  note(k.constraint, k.constraints);
  note(k.pose, k.pose_parameters);
  note(k.determinant, 1);
  note(k.determinant_derivatives, k.variables);
  if (const regulus_expansion* x = k.expansion) {
    note(x->product, nn);
    for (const regulus_derivatives* list : {&x->first, &x->second, &x->row_first, &x->row_second})
      note(list->function, list->count);
  }
  return least == SIZE_MAX ? 0 : least;
}

void CheckedKernel::forget(regulus_function function, LaneMask lanes, double* out) const noexcept {
  const std::size_t outputs = count_outputs(function);
  for (std::size_t e = 0; e < outputs; ++e)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (!has_lane(lanes, lane)) continue;
      out[2 * e * kLanes + lane] = kUndefinedLower;
      out[(2 * e + 1) * kLanes + lane] = kUndefinedUpper;
    }
}

}  // namespace regulus::detail
