// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/operation_text.hpp"

namespace regulus::detail {

using Pack = machine::PackOperation;

BinaryText sign_of(Pack operation) noexcept {
  switch (operation) {
    case Pack::kAdd_II:
    case Pack::kAdd_IP:
    case Pack::kAdd_PI:
    case Pack::kAdd_PP:
      return sum;
    case Pack::kSubtract_II:
    case Pack::kSubtract_IP:
    case Pack::kSubtract_PI:
    case Pack::kSubtract_PP:
      return difference;
    case Pack::kMultiply_II:
    case Pack::kMultiply_IP:
    case Pack::kMultiply_PI:
    case Pack::kMultiply_PP:
      return product;
    default:
      return nullptr;
  }
}

std::string_view function_name(Pack operation) noexcept {
  switch (operation) {
    case Pack::kThin_P:
      return "thin";
    case Pack::kPointOf_I:
      return "point_of";
    case Pack::kExactAdd_PP:
      return "exact_add";
    case Pack::kExactSub_PP:
      return "exact_sub";
    case Pack::kExactMul_PP:
      return "exact_mul";
    case Pack::kExactMulAdd_PPP:
      return "exact_mul_add";
    case Pack::kMulAdd_III:
    case Pack::kMulAdd_IPI:
    case Pack::kMulAdd_PII:
    case Pack::kMulAdd_PPI:
      return "mul_add";
    case Pack::kSqr_I:
      return "sqr";
    case Pack::kPow_IN:
      return "pow";
    case Pack::kAbs_I:
      return "abs";
    case Pack::kSin_I:
      return "sin";
    case Pack::kCos_I:
      return "cos";
    case Pack::kAtan_I:
      return "atan";
    case Pack::kSinCos_I:
      return "sincos";
    case Pack::kChecked_IU:
      return "checked";
    case Pack::kDiv_IIU:
      return "div";
    case Pack::kSqrt_IU:
      return "sqrt";
    case Pack::kTan_IU:
      return "tan";
    case Pack::kAsin_IU:
      return "asin";
    case Pack::kAcos_IU:
      return "acos";
    case Pack::kAtan2_IIU:
      return "atan2";
    case Pack::kExp_IU:
      return "exp";
    case Pack::kLog_IU:
      return "log";
    default:
      return {};
  }
}

bool marks_undefined(Pack operation) noexcept { return operation >= Pack::kChecked_IU; }

bool is_exact(Pack operation) noexcept {
  switch (operation) {
    case Pack::kPoint:
    case Pack::kExact:
    case Pack::kPointOf_I:
    case Pack::kNegate_P:
    case Pack::kExactAdd_PP:
    case Pack::kExactSub_PP:
    case Pack::kExactMul_PP:
    case Pack::kExactMulAdd_PPP:
      return true;
    default:
      return false;
  }
}

bool is_literal(Pack operation) noexcept { return operation == Pack::kExact; }

bool is_sign_or_product(Pack operation) noexcept {
  return (Pack::kExactAdd_PP <= operation && operation <= Pack::kSqr_I) ||
         operation == Pack::kNegate_P;
}

}  // namespace regulus::detail
