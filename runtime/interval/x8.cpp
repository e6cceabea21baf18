// SPDX-License-Identifier: Apache-2.0
#include "runtime/interval/x8.hpp"

#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/interval/x8_backend.hpp"

namespace regulus::detail {

const X8Backend& x8_backend(Isa isa) noexcept {
#if defined(__x86_64__)
  if (isa == Isa::kAvx512) return kX8Avx512;
  if (isa == Isa::kAvx2) return kX8Avx2;
#endif
  static_cast<void>(isa);
  return kX8Portable;
}

namespace {

/// The evaluators are in other files and called through a pointer, as the scope requires.
unsigned call(X8Backend::Function X8Backend::*function, const double* in, double* out) noexcept {
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  return (x8_backend(best_isa()).*function)(in, out);
}

}  // namespace
}  // namespace regulus::detail

using regulus::detail::X8Backend;

unsigned regulus_x8_sin(const double* in, double* out) {
  return regulus::detail::call(&X8Backend::sin, in, out);
}
unsigned regulus_x8_cos(const double* in, double* out) {
  return regulus::detail::call(&X8Backend::cos, in, out);
}
unsigned regulus_x8_sincos(const double* in, double* out) {
  return regulus::detail::call(&X8Backend::sincos, in, out);
}
unsigned regulus_x8_tan(const double* in, double* out) {
  return regulus::detail::call(&X8Backend::tan, in, out);
}
unsigned regulus_x8_asin(const double* in, double* out) {
  return regulus::detail::call(&X8Backend::asin, in, out);
}
unsigned regulus_x8_acos(const double* in, double* out) {
  return regulus::detail::call(&X8Backend::acos, in, out);
}
unsigned regulus_x8_atan(const double* in, double* out) {
  return regulus::detail::call(&X8Backend::atan, in, out);
}
unsigned regulus_x8_atan2(const double* in, double* out) {
  return regulus::detail::call(&X8Backend::atan2, in, out);
}
unsigned regulus_x8_exp(const double* in, double* out) {
  return regulus::detail::call(&X8Backend::exp, in, out);
}
unsigned regulus_x8_log(const double* in, double* out) {
  return regulus::detail::call(&X8Backend::log, in, out);
}

regulus_x8_function_table regulus_x8_functions() {
  static constexpr regulus_x8_function kFunctions[] = {
      {"regulus_x8_sin", regulus_x8_sin},       {"regulus_x8_cos", regulus_x8_cos},
      {"regulus_x8_sincos", regulus_x8_sincos}, {"regulus_x8_tan", regulus_x8_tan},
      {"regulus_x8_asin", regulus_x8_asin},     {"regulus_x8_acos", regulus_x8_acos},
      {"regulus_x8_atan", regulus_x8_atan},     {"regulus_x8_atan2", regulus_x8_atan2},
      {"regulus_x8_exp", regulus_x8_exp},       {"regulus_x8_log", regulus_x8_log}};
  return {kFunctions, sizeof kFunctions / sizeof kFunctions[0]};
}
