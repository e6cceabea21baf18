// SPDX-License-Identifier: Apache-2.0
// Generated: edit the model, not this file.
// Command          regulus generate models/robot_1.toml wide_15 -o generated/robot_1_wide_15
// Model            robot 1
// Motion           wide_15
// Source           J.-P. Merlet, A formal-numerical approach for robust in-workspace singularity
//                  detection, IEEE Transactions on Robotics 23(3), 2007, Table III
// Identity         de081fe8ecfe9551ff46dc94799456056dbf955ce31217c440bb91dc08d8fce7
#include "robot_1_wide_15.h"

#include <cstdio>
#include <optional>
#include <string>

#include "runtime/kernel/isa.hpp"
#include "runtime/kernel/self_test.hpp"

extern "C" {
#if defined(__x86_64__)
extern const regulus_kernel robot_1_wide_15_kernel_avx512;
unsigned robot_1_wide_15_self_test_avx512(const double*, const double*, double*, const void*);
extern const regulus_kernel robot_1_wide_15_kernel_avx2;
unsigned robot_1_wide_15_self_test_avx2(const double*, const double*, double*, const void*);
#endif
extern const regulus_kernel robot_1_wide_15_kernel_portable;
unsigned robot_1_wide_15_self_test_portable(const double*, const double*, double*, const void*);
}

namespace {

/// A kernel as it was compiled for one instruction set, and what the same compilation made of
/// operations whose results are known.
struct Build {
  regulus::Isa isa;
  const regulus_kernel* kernel;
  regulus_function self_test;
};

// Fastest first; every processor has the last.
const Build kBuilds[] = {
#if defined(__x86_64__)
    {regulus::Isa::kAvx512, &robot_1_wide_15_kernel_avx512, robot_1_wide_15_self_test_avx512},
    {regulus::Isa::kAvx2, &robot_1_wide_15_kernel_avx2, robot_1_wide_15_self_test_avx2},
#endif
    {regulus::Isa::kPortable, &robot_1_wide_15_kernel_portable, robot_1_wide_15_self_test_portable},
};

const Build& best_build() noexcept {
  const Build* build = kBuilds;
  while (build != kBuilds + sizeof kBuilds / sizeof *kBuilds - 1 && !regulus::supported(build->isa))
    ++build;
  return *build;
}

// Of every variable of the kernel, outward: motion parameters, then uncertain quantities.
const double kLowerBounds[] = {
    -15.0,  // x
    -15.0,  // y
    45.0,  // z
    -0x1.0c152382d7366p-2,  // psi
    -0x1.0c152382d7366p-2,  // theta
    -0x1.0c152382d7366p-2,  // phi
};
const double kUpperBounds[] = {
    15.0,  // x
    15.0,  // y
    50.0,  // z
    0x1.0c152382d7366p-2,  // psi
    0x1.0c152382d7366p-2,  // theta
    0x1.0c152382d7366p-2,  // phi
};

}  // namespace

extern "C" {

const robot_1_wide_15_parameters robot_1_wide_15_lower = {
    -15.0,  // x
    -15.0,  // y
    45.0,  // z
    -0x1.0c152382d7366p-2,  // psi
    -0x1.0c152382d7366p-2,  // theta
    -0x1.0c152382d7366p-2,  // phi
};
const robot_1_wide_15_parameters robot_1_wide_15_upper = {
    15.0,  // x
    15.0,  // y
    50.0,  // z
    0x1.0c152382d7366p-2,  // psi
    0x1.0c152382d7366p-2,  // theta
    0x1.0c152382d7366p-2,  // phi
};

const regulus_kernel* robot_1_wide_15_best_kernel(void) { return best_build().kernel; }

const char* robot_1_wide_15_isa(void) { return regulus::name(best_build().isa).data(); }

regulus_checker* robot_1_wide_15_checker_new(unsigned max_boxes, char* fault, size_t fault_size) {
  const Build& build = best_build();
  if (const auto failure = regulus::check_self_test(build.self_test, build.isa)) {
    if (fault != nullptr)
      std::snprintf(fault, fault_size, "the rounding self-test failed: %s", failure->c_str());
    return nullptr;
  }
  return regulus_checker_new(build.kernel, kLowerBounds, kUpperBounds, 0.0, max_boxes, fault,
                             fault_size);
}

regulus_check_verdict robot_1_wide_15_check(regulus_checker* checker,
    const robot_1_wide_15_parameters* lower, const robot_1_wide_15_parameters* upper,
    regulus_check_report* report) {
  const double from[] = {lower->x, lower->y, lower->z, lower->psi, lower->theta, lower->phi};
  const double to[] = {upper->x, upper->y, upper->z, upper->psi, upper->theta, upper->phi};
  return regulus_check(checker, from, to, report);
}

}  // extern "C"
