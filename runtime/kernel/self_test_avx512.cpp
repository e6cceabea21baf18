// SPDX-License-Identifier: Apache-2.0
#define regulus_self_test regulus_self_test_avx512
#include "runtime/kernel/self_test_program.hpp"
