// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/cpp/compiled_kernels.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

TEST_F(CompiledKernels, EncloseArbOrReportTheLaneAsUndefined) {
  const int modules = trials(4, 16);
  build(1, modules, "-O1");
  compare(100);
  expect_enough(modules * 2500, modules * 250);
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
}  // namespace regulus::detail::test
