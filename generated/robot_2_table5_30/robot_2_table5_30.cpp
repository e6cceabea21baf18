// SPDX-License-Identifier: Apache-2.0
// Generated: edit the model, not this file.
// Command          regulus generate models/robot_2.toml table5_30 -o generated/robot_2_table5_30
// Model            robot 2
// Motion           table5_30
// Source           J.-P. Merlet, A formal-numerical approach for robust in-workspace singularity
//                  detection, IEEE Transactions on Robotics 23(3), 2007, Table III
// Identity         5913990e10fa4cdf9681a8d8ef88cecd6c637479ebced5bd8f12d592cc5dc50b
#include "robot_2_table5_30.h"

#include <cstdio>
#include <optional>
#include <string>

#include "runtime/kernel/isa.hpp"
#include "runtime/kernel/self_test.hpp"

extern "C" {
#if defined(__x86_64__)
extern const regulus_kernel robot_2_table5_30_kernel_avx512;
unsigned robot_2_table5_30_self_test_avx512(const double*, const double*, double*, const void*);
extern const regulus_kernel robot_2_table5_30_kernel_avx2;
unsigned robot_2_table5_30_self_test_avx2(const double*, const double*, double*, const void*);
#endif
extern const regulus_kernel robot_2_table5_30_kernel_portable;
unsigned robot_2_table5_30_self_test_portable(const double*, const double*, double*, const void*);
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
    {regulus::Isa::kAvx512, &robot_2_table5_30_kernel_avx512, robot_2_table5_30_self_test_avx512},
    {regulus::Isa::kAvx2, &robot_2_table5_30_kernel_avx2, robot_2_table5_30_self_test_avx2},
#endif
    {regulus::Isa::kPortable, &robot_2_table5_30_kernel_portable, robot_2_table5_30_self_test_portable},
};

const Build& best_build() noexcept {
  const Build* build = kBuilds;
  while (build != kBuilds + sizeof kBuilds / sizeof *kBuilds - 1 && !regulus::supported(build->isa))
    ++build;
  return *build;
}

// Of every variable of the kernel, outward: motion parameters, then uncertain quantities.
const double kLowerBounds[] = {
    -200.0,  // x
    -200.0,  // y
    2800.0,  // z
    -0x1.0c152382d7366p-1,  // psi
    -0x1.0c152382d7366p-1,  // theta
    -0x1.0c152382d7366p-1,  // phi
};
const double kUpperBounds[] = {
    200.0,  // x
    200.0,  // y
    3200.0,  // z
    0x1.0c152382d7366p-1,  // psi
    0x1.0c152382d7366p-1,  // theta
    0x1.0c152382d7366p-1,  // phi
};

}  // namespace

extern "C" {

const robot_2_table5_30_parameters robot_2_table5_30_lower = {
    -200.0,  // x
    -200.0,  // y
    2800.0,  // z
    -0x1.0c152382d7366p-1,  // psi
    -0x1.0c152382d7366p-1,  // theta
    -0x1.0c152382d7366p-1,  // phi
};
const robot_2_table5_30_parameters robot_2_table5_30_upper = {
    200.0,  // x
    200.0,  // y
    3200.0,  // z
    0x1.0c152382d7366p-1,  // psi
    0x1.0c152382d7366p-1,  // theta
    0x1.0c152382d7366p-1,  // phi
};

const regulus_kernel* robot_2_table5_30_best_kernel(void) { return best_build().kernel; }

const char* robot_2_table5_30_isa(void) { return regulus::name(best_build().isa).data(); }

regulus_checker* robot_2_table5_30_checker_new(unsigned max_boxes, char* fault, size_t fault_size) {
  const Build& build = best_build();
  if (const auto failure = regulus::check_self_test(build.self_test, build.isa)) {
    if (fault != nullptr)
      std::snprintf(fault, fault_size, "the rounding self-test failed: %s", failure->c_str());
    return nullptr;
  }
  return regulus_checker_new(build.kernel, kLowerBounds, kUpperBounds, 0.0, max_boxes, fault,
                             fault_size);
}

regulus_check_verdict robot_2_table5_30_check(regulus_checker* checker,
    const robot_2_table5_30_parameters* lower, const robot_2_table5_30_parameters* upper,
    regulus_check_report* report) {
  const double from[] = {lower->x, lower->y, lower->z, lower->psi, lower->theta, lower->phi};
  const double to[] = {upper->x, upper->y, upper->z, upper->psi, upper->theta, upper->phi};
  return regulus_check(checker, from, to, report);
}

}  // extern "C"
