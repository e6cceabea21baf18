// SPDX-License-Identifier: Apache-2.0
// Generated: edit the model, not this file.
// Command          regulus generate models/robot_1.toml T1 -o generated/robot_1_T1
// Model            robot 1
// Motion           T1
// Source           J.-P. Merlet, A formal-numerical approach for robust in-workspace singularity
//                  detection, IEEE Transactions on Robotics 23(3), 2007, Table III
// Identity         58a478441814040435ff3bd6eeae807fb63e1717f38974d84b2d08c6ae339380
#include "robot_1_T1.h"

#include <cstdio>
#include <optional>
#include <string>

#include "runtime/kernel/isa.hpp"
#include "runtime/kernel/self_test.hpp"

extern "C" {
#if defined(__x86_64__)
extern const regulus_kernel robot_1_T1_kernel_avx512;
unsigned robot_1_T1_self_test_avx512(const double*, const double*, double*, const void*);
extern const regulus_kernel robot_1_T1_kernel_avx2;
unsigned robot_1_T1_self_test_avx2(const double*, const double*, double*, const void*);
#endif
extern const regulus_kernel robot_1_T1_kernel_portable;
unsigned robot_1_T1_self_test_portable(const double*, const double*, double*, const void*);
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
    {regulus::Isa::kAvx512, &robot_1_T1_kernel_avx512, robot_1_T1_self_test_avx512},
    {regulus::Isa::kAvx2, &robot_1_T1_kernel_avx2, robot_1_T1_self_test_avx2},
#endif
    {regulus::Isa::kPortable, &robot_1_T1_kernel_portable, robot_1_T1_self_test_portable},
};

const Build& best_build() noexcept {
  const Build* build = kBuilds;
  while (build != kBuilds + sizeof kBuilds / sizeof *kBuilds - 1 && !regulus::supported(build->isa))
    ++build;
  return *build;
}

// Of every variable of the kernel, outward: motion parameters, then uncertain quantities.
const double kLowerBounds[] = {
    0.0,  // T
};
const double kUpperBounds[] = {
    1.0,  // T
};

}  // namespace

extern "C" {

const robot_1_T1_parameters robot_1_T1_lower = {
    0.0,  // T
};
const robot_1_T1_parameters robot_1_T1_upper = {
    1.0,  // T
};

const regulus_kernel* robot_1_T1_best_kernel(void) { return best_build().kernel; }

const char* robot_1_T1_isa(void) { return regulus::name(best_build().isa).data(); }

regulus_checker* robot_1_T1_checker_new(unsigned max_boxes, char* fault, size_t fault_size) {
  const Build& build = best_build();
  if (const auto failure = regulus::check_self_test(build.self_test, build.isa)) {
    if (fault != nullptr)
      std::snprintf(fault, fault_size, "the rounding self-test failed: %s", failure->c_str());
    return nullptr;
  }
  return regulus_checker_new(build.kernel, kLowerBounds, kUpperBounds, 0.0, max_boxes, fault,
                             fault_size);
}

regulus_check_verdict robot_1_T1_check(regulus_checker* checker,
    const robot_1_T1_parameters* lower, const robot_1_T1_parameters* upper,
    regulus_check_report* report) {
  const double from[] = {lower->T};
  const double to[] = {upper->T};
  return regulus_check(checker, from, to, report);
}

}  // extern "C"
