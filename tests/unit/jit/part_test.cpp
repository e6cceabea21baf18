// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/part.hpp"

#include <gtest/gtest.h>

#include <set>

namespace regulus::detail {
namespace {

using machine::PackFunction;
using Op = machine::PackOperation;

/// Makes two parts that both compute 2·x + 3 and one that computes 3·x + 2. Each has other numbers
/// for its values, and all use constants of the whole list.
PackFunction example() {
  PackFunction f;
  f.constants = {Interval(3), Interval(7), Interval(2)};
  const auto add = [&f](std::uint32_t factor, std::uint32_t term) {
    const auto first = static_cast<std::uint32_t>(f.code.size());
    f.code.push_back({Op::kLoad, 0});
    f.code.push_back({Op::kConstant, factor});
    f.code.push_back({Op::kConstant, term});
    f.code.push_back({Op::kMulAdd_III, first, first + 1, first + 2});
    f.code.push_back({Op::kStore, 0, 0, first + 3});
    f.part_ends.push_back(first + 5);
  };
  add(2, 0);
  add(2, 0);
  add(0, 2);
  f.outputs = 1;
  return f;
}

TEST(PartBytes, AreEqualForPartsThatComputeTheSame) {
  const PackFunction f = example();
  EXPECT_EQ(part_bytes(f, 0), part_bytes(f, 1));
  EXPECT_NE(part_bytes(f, 0), part_bytes(f, 2));
  PackFunction other = f;
  other.constants = {Interval(2), Interval(3)};
  for (auto& i : other.code)
    if (i.operation == Op::kConstant) i.a = i.a == 2 ? 0 : 1;
  EXPECT_EQ(part_bytes(f, 0), part_bytes(other, 0));
}

TEST(PartBytes, TellApartWhateverIsReadWrittenOrComputed) {
  std::set<std::string> all;
  const auto add = [&all](auto change) {
    PackFunction f = example();
    change(f);
    all.insert(part_bytes(f, 0));
  };
  add([](PackFunction&) {});
  add([](PackFunction& f) { f.code[0].a = 1; });
  add([](PackFunction& f) { f.code[0].operation = Op::kFetch; });
  add([](PackFunction& f) { f.code[3].operation = Op::kAdd_II; });
  add([](PackFunction& f) { f.code[3].b = 2; });
  add([](PackFunction& f) { f.code[4].b = 1; });
  add([](PackFunction& f) { f.code[4] = {Op::kKeep, 0, 3}; });
  add([](PackFunction& f) { f.code[4] = {Op::kKeep, 1, 3}; });
  add([](PackFunction& f) { f.constants[2] = Interval(5); });
  add([](PackFunction& f) { f.constants[0] = f.constants[2]; });
  add([](PackFunction& f) { f.constants[0] = Interval(0.0); });
  add([](PackFunction& f) { f.constants[0] = Interval(-0.0); });
  add([](PackFunction& f) { f.part_ends[0] = 4; });
  EXPECT_EQ(all.size(), 13U);
}

TEST(PartBytes, AreReadAsTheyWereWritten) {
  const PackFunction f = example();
  const PartProgram part = read_part(part_bytes(f, 2));
  ASSERT_EQ(part.code.size(), 5U);
  EXPECT_EQ(part.code[3], (machine::PackInstruction{Op::kMulAdd_III, 0, 1, 2}));
  ASSERT_EQ(part.constants.size(), 2U);
  EXPECT_EQ(part.constants[0].lo, 3);
  EXPECT_EQ(part.constants[1].hi, 2);
}

TEST(PartName, DependsOnTheBytesTheInstructionSetAndTheCompiler) {
  const std::set<std::string> names{part_name("a", "b", "c"), part_name("x", "b", "c"),
                                    part_name("a", "x", "c"), part_name("a", "b", "x"),
                                    part_name("ab", "", "c")};
  EXPECT_EQ(names.size(), 5U);
  EXPECT_EQ(names.begin()->size(), 64U);
}

}  // namespace
}  // namespace regulus::detail
