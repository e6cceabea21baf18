// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/machine/pack_file.hpp"

#include <gtest/gtest.h>

#include "codegen/kernel/pack/select.hpp"
#include "tests/support/sample_modules.hpp"

namespace regulus::detail {
namespace {

using machine::PackKernel;
using machine::read_pack_kernel;
using machine::to_bytes;

TEST(PackFile, IsReadAsItWasWritten) {
  for (const Module& module :
       {test::planar_module(), test::everything_module(), test::long_module(150)}) {
    PackKernel program = select(module, 24);
    if (machine::PackFunction& matrix = program.functions[0]; matrix.outputs == 0) {
      using Op = machine::PackOperation;
      matrix.code = {{Op::kLoad, 0}, {Op::kStore, 0, 0, 0}};
      matrix.part_ends = {2};
      matrix.outputs = 1;
    }
    ASSERT_EQ(find_fault(program), "") << module.model;
    const std::string bytes = to_bytes(program);
    const auto read = read_pack_kernel(bytes);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->identity, program.identity);
    EXPECT_EQ(read->functions[0].code, program.functions[0].code);
    EXPECT_EQ(to_bytes(*read), bytes);
  }
}

TEST(PackFile, IsNotReadWithBytesMissingOrAdded) {
  const std::string bytes = to_bytes(select(test::planar_module()));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(read_pack_kernel(std::string_view(bytes).substr(0, size))) << size;
  EXPECT_FALSE(read_pack_kernel(bytes + '\0'));
}

TEST(PackFile, IsASoundProgramOrNoneWithAnyByteChanged) {
  const std::string sound = to_bytes(select(test::planar_module()));
  for (std::size_t place = 0; place < sound.size(); ++place)
    for (const char value : {'\0', '\1', '\x7f', '\x80', '\xff'}) {
      std::string bytes = sound;
      bytes[place] = value;
      const auto read = read_pack_kernel(bytes);
      if (!read) continue;
      for (const machine::PackFunction& function : read->functions)
        EXPECT_EQ(find_fault(function, read->variables, read->rows * read->columns), "");
    }
}

}  // namespace
}  // namespace regulus::detail
