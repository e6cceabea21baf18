// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/cpp/compiled_kernels.hpp"

namespace regulus::test {
namespace {

TEST_F(CompiledKernels, EncloseArbOrReportTheLaneAsUndefined) {
  build(1, 16, "-O1");
  compare(100);
  expect_enough(40000, 4000);
}

TEST(CompiledText, IsAcceptedWithoutWarnings) {
  const TemporaryDirectory directory;
  for (const Module& module :
       {planar_module(), everything_module(), long_module(150), hostile_module()}) {
    EmitOptions options;
    options.operations_per_part = 24;
    const EmittedKernel kernel = emit(module, options);
    for (const std::string& compiler : installed_compilers())
      for (const Isa isa : kAllIsas)
        if (supported(isa)) {
          EXPECT_TRUE(compiles_without_warnings(compiler, kernel.source, isa, directory.path()))
              << compiler << "\n"
              << kernel.source;
        }
  }
}

}  // namespace
}  // namespace regulus::test
