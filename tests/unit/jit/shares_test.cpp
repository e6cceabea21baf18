// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/reader/shares.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "regulus/codegen/jit/compiled_parts.hpp"
#include "regulus/codegen/jit/jit.hpp"
#include "regulus/codegen/jit/reader/parser.hpp"
#include "regulus/kernel/buffers.hpp"
#include "regulus/kernel/call.hpp"
#include "support/temporary_directory.hpp"

namespace regulus::codegen {
namespace {

using reader::parse_kernel;
using reader::share_out;
using reader::share_out_unknown;
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

TEST(Shares, ForOtherKernelsKeepCallersApart) {
  const std::string text = kernel_of(300, 400);
  const auto kernel = parse_kernel(text);
  const auto symbols = reader::symbols_of(kernel);
  const auto all = share_out_unknown(kernel, symbols, {});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_THAT(all[0].functions, UnorderedElementsAre("matrix_1"));
  EXPECT_THAT(all[1].functions, UnorderedElementsAre("pose_1"));
  EXPECT_THAT(all[2].functions, UnorderedElementsAre("matrix", "pose"));
  EXPECT_TRUE(all[2].tables && !all[0].tables && !all[1].tables);
  const auto one = share_out_unknown(kernel, symbols, {symbols.at("pose_1")});
  ASSERT_EQ(one.size(), 2u);
  EXPECT_THAT(one[0].functions, UnorderedElementsAre("matrix_1"));
  EXPECT_THAT(one[1].functions, UnorderedElementsAre("matrix", "pose"));
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

/// How many functions of a kernel with parts of these lengths are compiled and how many known.
void expect_counts(CompiledParts& parts, const CompileOptions& options, int matrix_length,
                   int pose_length, std::size_t functions_compiled, std::size_t functions_known) {
  EmittedKernel emitted;
  emitted.symbol = "two_kernel";
  emitted.source = kernel_of(matrix_length, pose_length);
  CompileOptions with_parts = options;
  with_parts.parts = &parts;
  const CompiledKernel compiled = compile_kernel(emitted, with_parts);
  EXPECT_EQ(compiled.report().functions_compiled, functions_compiled);
  EXPECT_EQ(compiled.report().functions_known, functions_known);
  EXPECT_EQ(result_of(*compiled.kernel(), compiled.kernel()->matrix),
            matrix_length * (matrix_length + 1) / 2);
  EXPECT_EQ(result_of(*compiled.kernel(), compiled.kernel()->pose),
            pose_length * (pose_length + 1) / 2);
}

TEST(KnownFunctions, AreNotCompiledAgain) {
  CompiledParts parts;
  const CompileOptions options{best_isa(), false, {}};
  expect_counts(parts, options, 300, 400, 2, 0);
  expect_counts(parts, options, 300, 400, 0, 2);
  expect_counts(parts, options, 300, 401, 1, 1);
  expect_counts(parts, options, 401, 300, 0, 2);  // under another name
  expect_counts(parts, options, 20, 30, 2, 0);
  expect_counts(parts, options, 30, 20, 0, 2);
}

TEST(KnownFunctions, ThatComputeTheSameAreOne) {
  CompiledParts parts;
  expect_counts(parts, {best_isa(), false, {}}, 300, 300, 1, 0);
  EmittedKernel emitted;
  emitted.symbol = "two_kernel";
  emitted.source = kernel_of(300, 300);
  const CompiledKernel whole = compile_kernel(emitted, {best_isa(), false, {}});
  EXPECT_EQ(result_of(*whole.kernel(), whole.kernel()->pose), 300 * 301 / 2);
}

TEST(KnownFunctions, AreOfOneInstructionSet) {
  CompiledParts parts;
  for (const Isa isa : kAllIsas)
    if (supported(isa)) expect_counts(parts, {isa, false, {}}, 30, 40, 2, 0);
}

TEST(KnownFunctions, ComeFromTheCacheToo) {
  const test::TemporaryDirectory directory;
  const CompileOptions options{best_isa(), true, directory.path() / "cache"};
  CompiledParts first, second;
  expect_counts(first, options, 300, 400, 2, 0);
  expect_counts(first, options, 300, 401, 1, 1);
  expect_counts(second, options, 300, 401, 0, 0);  // the whole kernel is in the cache
  expect_counts(second, options, 300, 402, 1, 1);
}

}  // namespace
}  // namespace regulus::codegen
