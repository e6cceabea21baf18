// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/reader/shares.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "regulus/codegen/jit/jit.hpp"
#include "regulus/codegen/jit/reader/parser.hpp"
#include "regulus/kernel/buffers.hpp"
#include "regulus/kernel/call.hpp"
#include "support/temporary_directory.hpp"

namespace regulus::codegen {
namespace {

using reader::parse_kernel;
using reader::share_out;
using testing::UnorderedElementsAre;

/// A part, and the function that calls it: x + 1 + 2 + …, `length` times, into every output.
std::string family(const std::string& name, int length) {
  std::string text = "unsigned " + name +
                     "_1(const double* boxes, const double*, double* out, I*) {\n"
                     "  unsigned undefined = 0;\n  const I t_0 = load(boxes, 0);\n";
  for (int i = 1; i <= length; ++i)
    text += "  const I t_" + std::to_string(i) + " = t_" + std::to_string(i - 1) + " + P(" +
            std::to_string(i) + ".0);\n";
  return text + "  store(out, 0, t_" + std::to_string(length) +
         ");\n  return undefined;\n}\nunsigned " + name +
         "(const double* boxes, const double* points, double* out, const void*) {\n"
         "  I shared[1];\n  unsigned undefined = 0;\n  undefined |= " +
         name + "_1(boxes, points, out, shared);\n  return undefined;\n}\n";
}

std::string kernel_of(int matrix_length, int pose_length) {
  return "#include \"regulus/kernel/abi.hpp\"\n#include \"regulus/kernel/pack.hpp\"\nnamespace {\n"
         "using namespace regulus::pack;\n" +
         family("matrix", matrix_length) + family("pose", pose_length) +
         "}\nextern \"C\" {\nextern const regulus_kernel two_kernel;\n"
         "const regulus_kernel two_kernel = {REGULUS_KERNEL_ABI, kRounding, 1, 1, 1, 1, 0, 1,\n"
         "    matrix, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, pose};\n}\n";
}

TEST(Shares, OfAShortKernelAreOne) {
  const std::string text = kernel_of(1000, 20);
  const auto shares = share_out(parse_kernel(text));
  ASSERT_EQ(shares.size(), 1u);
  EXPECT_TRUE(shares[0].tables);
  EXPECT_THAT(shares[0].functions, UnorderedElementsAre("matrix", "matrix_1", "pose", "pose_1"));
}

TEST(Shares, KeepAFunctionWithItsPartsAndTheTablesLast) {
  const std::string text = kernel_of(300, 400);
  const auto shares = share_out(parse_kernel(text));
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_FALSE(shares[0].tables);
  EXPECT_TRUE(shares[1].tables);
  EXPECT_THAT(shares[0].functions, UnorderedElementsAre("matrix", "matrix_1"));
  EXPECT_THAT(shares[1].functions, UnorderedElementsAre("pose", "pose_1"));
}

double result_of(const regulus_kernel& kernel, regulus_function function) {
  BoxBatch boxes(1);
  OutputBatch out(1);
  EXPECT_EQ(Kernel(kernel).call(function, boxes.data(), nullptr, out.data()), 0u);
  EXPECT_EQ(out.get(0, 3).lo, out.get(0, 3).hi);
  return out.get(0, 3).lo;
}

TEST(Shares, AreLinkedToOneKernelFreshAndFromTheCache) {
  const test::TemporaryDirectory directory;
  EmittedKernel emitted;
  emitted.symbol = "two_kernel";
  emitted.source = kernel_of(300, 400);
  for (const char* cache : {"miss", "hit"}) {
    const CompiledKernel compiled =
        compile_kernel(emitted, {best_isa(), true, directory.path() / "cache"});
    EXPECT_EQ(compiled.cache(), cache);
    EXPECT_EQ(compiled.report().not_read, "");
    EXPECT_EQ(result_of(*compiled.kernel(), compiled.kernel()->matrix), 300 * 301 / 2);
    EXPECT_EQ(result_of(*compiled.kernel(), compiled.kernel()->pose), 400 * 401 / 2);
  }
}

}  // namespace
}  // namespace regulus::codegen
