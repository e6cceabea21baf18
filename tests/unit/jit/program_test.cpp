// SPDX-License-Identifier: GPL-3.0-or-later
// Pack programs as kernels in memory: tests what is compiled, what is found in the cache, and what
// a damaged cache costs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <thread>
#include <vector>

#include "codegen/kernel/jit/jit.hpp"
#include "codegen/kernel/jit/part.hpp"
#include "codegen/kernel/jit/part_code.hpp"
#include "codegen/kernel/pack/select.hpp"
#include "runtime/kernel/buffers.hpp"
#include "runtime/kernel/call.hpp"
#include "tests/support/cache_entries.hpp"
#include "tests/support/process_maps.hpp"
#include "tests/support/sample_modules.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail {
namespace {

using testing::HasSubstr;

machine::PackKernel program(int length = 200) { return select(test::long_module(length)); }

class ProgramTest : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::filesystem::path> entries() const {
    return test::cache_entries(path_);
  }

  test::TemporaryDirectory directory_;
  std::filesystem::path path_ = directory_.path() / "cache";
  CompileOptions options_{best_isa(), true, path_};
};

TEST_F(ProgramTest, FillsTheTableOfTheAbi) {
  const machine::PackKernel list = program();
  const CompiledKernel compiled = compile_kernel(list, options_);
  const regulus_kernel& k = *compiled.kernel();
  EXPECT_EQ(k.abi, static_cast<unsigned>(REGULUS_KERNEL_ABI));
  EXPECT_EQ(k.rounding, required_rounding(best_isa()));
  EXPECT_EQ(k.variables, list.variables);
  EXPECT_EQ(k.identity, list.identity);
  for (std::size_t row = 0; row < kKernelFunctions.size(); ++row) {
    const auto field = kKernelFunctions[row].field;
    EXPECT_EQ(field && k.*field, field && list.functions[row].outputs > 0);
  }
}

TEST_F(ProgramTest, IsFoundWithoutTheCompilerOnceItWasCompiled) {
  EXPECT_FALSE(find_cached_kernel(program(), options_));
  const CompiledKernel first = compile_kernel(program(), options_);
  EXPECT_EQ(first.cache(), "miss");
  EXPECT_EQ(first.cache_note(), "");
  EXPECT_GT(first.report().parts.compiled, 1U);
  EXPECT_GT(first.report().front_end_seconds, 0);
  const auto second = find_cached_kernel(program(), options_);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->cache(), "hit");
  EXPECT_EQ(second->report().parts.compiled, 0U);
  EXPECT_NE(first.kernel(), second->kernel());
}

TEST_F(ProgramTest, TakesThePartsOfAnotherOneFromTheCache) {
  const std::size_t whole = compile_kernel(program(300), options_).report().parts.compiled;
  const PartCount longer = compile_kernel(program(364), options_).report().parts;
  EXPECT_GT(longer.known, 0U);
  EXPECT_LT(longer.compiled, whole);
}

TEST_F(ProgramTest, TakesThePartsOfAnotherOneFromMemory) {
  PartStore parts;
  options_.use_cache = false;
  options_.parts = &parts;
  (void)compile_kernel(program(), options_);
  const auto again = find_cached_kernel(program(), options_);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->cache(), "off");
  EXPECT_FALSE(std::filesystem::exists(path_));
  options_.isa = Isa::kPortable;
  EXPECT_EQ(find_cached_kernel(program(), options_).has_value(), best_isa() == Isa::kPortable);
}

TEST_F(ProgramTest, CompilesAgainThePartsWhoseEntriesAreDamaged) {
  (void)compile_kernel(program(), options_);
  const auto files = entries();  // one for all parts together, and one for each part
  const auto largest = std::ranges::max_element(
      files, {}, [](const auto& file) { return std::filesystem::file_size(file); });
  std::ofstream(*largest, std::ios::trunc) << "damaged";
  const CompiledKernel of_parts = compile_kernel(program(), options_);
  EXPECT_EQ(of_parts.cache(), "hit");
  EXPECT_THAT(of_parts.cache_note(), HasSubstr("is damaged"));
  EXPECT_EQ(compile_kernel(program(), options_).cache_note(), "");

  std::filesystem::remove(*largest);
  int spoilt = 0;
  for (const auto& file : files) {
    if (file == *largest || spoilt == 2) continue;
    if (spoilt++ == 0)
      std::ofstream(file, std::ios::trunc) << "damaged";
    else
      std::filesystem::remove(file);
  }
  const CompiledKernel again = compile_kernel(program(), options_);
  EXPECT_EQ(again.cache(), "miss");
  EXPECT_EQ(again.report().parts.compiled, 2U);
  EXPECT_THAT(again.cache_note(), HasSubstr("is damaged"));
  const CompiledKernel third = compile_kernel(program(), options_);
  EXPECT_EQ(third.cache(), "hit");
  EXPECT_EQ(third.cache_note(), "");
}

TEST_F(ProgramTest, NeedsNoCacheThatIsSafe) {
  std::filesystem::create_directory(path_);
  std::filesystem::permissions(path_, std::filesystem::perms::all);
  const CompiledKernel compiled = compile_kernel(program(), options_);
  EXPECT_EQ(compiled.cache(), "off");
  EXPECT_THAT(compiled.cache_note(), HasSubstr("is writable by other users"));
  EXPECT_TRUE(std::filesystem::is_empty(path_));
}

TEST_F(ProgramTest, IsRefusedWithAFault) {
  machine::PackKernel faulty = program();
  faulty.variables = 0;
  EXPECT_THROW((void)compile_kernel(faulty, options_), std::invalid_argument);
  EXPECT_THROW((void)find_cached_kernel(faulty, options_), std::invalid_argument);
}

TEST_F(ProgramTest, IsCompiledByAnyNumberOfThreadsAtOnce) {
  PartStore parts;
  options_.parts = &parts;
  std::vector<std::thread> threads;
  std::array<std::string, 4> notes;
  for (std::size_t i = 0; i < notes.size(); ++i)
    threads.emplace_back([&, i] {
      const auto kernel = compile_kernel(program(static_cast<int>(150 + 20 * (i % 2))), options_);
      notes[i] = kernel.kernel() ? kernel.cache_note() : "no kernel";
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::string& note : notes) EXPECT_EQ(note, "");
}

TEST_F(ProgramTest, LivesAsLongAsOneCopyAndIsNeverWritable) {
  const void* code = nullptr;
  {
    const LoadedParts parts({std::string(100, '\x90'), std::string(3, '\xC3')});
    code = reinterpret_cast<const void*>(parts.function(1));
    EXPECT_EQ(test::range_of(code).value().rights, "r-xp");
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(code) % kCodeAlignment, 0U);
  }
  const auto range = test::range_of(code);
  EXPECT_TRUE(!range || range->rights != "r-xp");
}

}  // namespace
}  // namespace regulus::detail
