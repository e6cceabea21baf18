// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/cpp/compiled_kernels.hpp"

namespace regulus::detail::test {
namespace {

TEST_F(CompiledKernels, EncloseArbWhenOptimisedForSpeed) {
  build(100, 60, "-O3");
  compare(100);
  expect_enough(200000, 10000);
}

TEST_F(CompiledKernels, EncloseArbWithoutOptimisation) {
  build(200, 20, "-O0");
  compare(100);
  expect_enough(50000, 2000);
}

}  // namespace
}  // namespace regulus::detail::test
