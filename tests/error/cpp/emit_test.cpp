// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/emit.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/sample_modules.hpp"

namespace regulus::detail {
namespace {

TEST(Emit, RefusesAPrefixThatIsNoIdentifier) {
  for (const char* prefix : {"", "1robot", "a b", "x;", "a\"", "ä"}) {
    EmitOptions options;
    options.prefix = prefix;
    EXPECT_THROW((void)emit(test::planar_module(), options), std::invalid_argument) << prefix;
  }
}

TEST(Emit, RefusesThePrefixThatWouldHideTheType) {
  EmitOptions options;
  options.prefix = "regulus";
  EXPECT_THROW((void)emit(test::planar_module(), options), std::invalid_argument);
}

TEST(Emit, RefusesPartsWithoutOperations) {
  EmitOptions options;
  options.operations_per_part = 0;
  EXPECT_THROW((void)emit(test::planar_module(), options), std::invalid_argument);
}

TEST(Emit, RefusesAMalformedModule) {
  Module module = test::planar_module();
  module.functions[0].program.nodes[0].index = 99;
  EXPECT_THROW((void)emit(module), std::invalid_argument);
}

}  // namespace
}  // namespace regulus::detail
