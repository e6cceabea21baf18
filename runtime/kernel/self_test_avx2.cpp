// SPDX-License-Identifier: Apache-2.0
#define REGULUS_SELF_TEST regulus_self_test_avx2
#include "regulus/kernel/self_test_program.hpp"
