// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "runtime/machine/machine_kernel.hpp"
#include "runtime/machine/pack_file.hpp"

namespace regulus::detail::machine {
namespace {

using Op = PackOperation;

PackFunction& function(PackKernel& k, KernelFunction f) {
  return k.functions[static_cast<std::size_t>(f)];
}

/// Stores x and y in so many outputs; the first output is x plus a constant.
PackFunction values(std::uint32_t outputs) {
  PackFunction f;
  f.code = {{Op::kLoad, 0}, {Op::kConstant, 0}, {Op::kAdd_II, 0, 1}, {Op::kStore, 0, 0, 2}};
  if (outputs > 1) f.code.push_back({Op::kStore, 1, outputs - 1, 0});
  f.part_ends = {static_cast<std::uint32_t>(f.code.size())};
  f.constants = {{-0.0, std::numeric_limits<double>::denorm_min()}};
  f.outputs = outputs;
  return f;
}

/// Makes a 2×2 matrix of x and y, where y touches row 1 only.
PackKernel sample() {
  PackKernel k;
  k.variables = 2;
  k.motion_variables = 1;
  k.rows = k.columns = 2;
  k.constraints = 3;
  k.pose_parameters = 1;
  k.identity = "0123456789abcdef";
  function(k, KernelFunction::kMatrix) = values(4);
  function(k, KernelFunction::kLeftProduct) = values(4);
  function(k, KernelFunction::kConstraint) = values(3);
  function(k, KernelFunction::kPose) = values(1);
  function(k, KernelFunction::kNominalFirst) = values(1);
  function(k, KernelFunction::kExpansionSecond) = values(2);
  k.has_expansion = true;
  k.expansion.product = KernelFunction::kLeftProduct;
  k.expansion.derivatives.fill({KernelFunction::kNominalFirst, {}});
  k.expansion.derivatives[0] = {KernelFunction::kNominalFirst, {{0, 1, 0, REGULUS_FIRST_ORDER}}};
  k.expansion.derivatives[1] = {KernelFunction::kExpansionSecond, {{0, 1, 0, 0}, {1, 1, 0, 1}}};
  k.expansion.row_of_variable = {-1, 1};
  k.expansion.ball_of_variable = {-1, 0};
  k.expansion.nominal = {{0, 0}, {-1, 0x1.8p-3}};
  return k;
}

TEST(PackFileOfAKernel, IsReadBackAsItWas) {
  const PackKernel before = sample();
  ASSERT_EQ(find_fault(before), "");
  const std::string text = to_bytes(before);
  const auto after = read_pack_kernel(text);
  ASSERT_TRUE(after);
  EXPECT_EQ(to_bytes(*after), text);
  EXPECT_EQ(after->identity, before.identity);
  EXPECT_EQ(after->functions[0].code, before.functions[0].code);
  EXPECT_EQ(after->functions[0].part_ends, before.functions[0].part_ends);
  EXPECT_TRUE(std::signbit(after->functions[0].constants[0].lo));
  EXPECT_EQ(after->functions[0].constants[0].hi, std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(after->expansion.derivatives[1].list[1].second, 1U);
  EXPECT_EQ(after->expansion.row_of_variable, before.expansion.row_of_variable);
  EXPECT_EQ(after->expansion.nominal[1], before.expansion.nominal[1]);
  EXPECT_NO_THROW(MachineKernel(*after, Isa::kPortable));
}

TEST(PackFileOfAKernel, IsNotReadFromAnythingElse) {
  const std::string text = to_bytes(sample());
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_FALSE(read_pack_kernel(text.substr(0, size))) << size;
  EXPECT_FALSE(read_pack_kernel(text + ' '));
  EXPECT_FALSE(read_pack_kernel(text + " 0"));
  EXPECT_FALSE(read_pack_kernel(' ' + text));
}

/// Adding 256 to the number of a function does not give another spelling of it.
TEST(PackFileOfAKernel, HasOneWayToWriteAFunction) {
  PackKernel k = sample();
  k.identity.clear();
  k.has_expansion = false;
  k.expansion = {};
  k.expansion.derivatives.fill({KernelFunction::kNominalFirst, {}});
  const std::string text = to_bytes(k);
  // The end has the product, four functions with empty lists, three empty lists, no identity.
  const std::size_t product = text.size() - 13;
  ASSERT_EQ(text[product], static_cast<char>(k.expansion.product));
  ASSERT_TRUE(read_pack_kernel(text));
  std::string longer = text;
  longer[product] |= '\x80';
  longer.insert(product + 1, 1, '\x02');
  EXPECT_FALSE(read_pack_kernel(longer));
  longer[product] = static_cast<char>(kKernelFunctions.size());
  longer.erase(product + 1, 1);
  EXPECT_FALSE(read_pack_kernel(longer));
}

/// Changes every byte: the result is another program without a fault, or it is refused.
TEST(PackFileOfAKernel, GivesNoProgramWithAFault) {
  const std::string text = to_bytes(sample());
  int read = 0;
  for (std::size_t at = 0; at < text.size(); ++at)
    for (const char c : {'\0', '\1', '\2', '\7', '\x7f', '\x80', '\xff'}) {
      std::string damaged = text;
      damaged[at] = c;
      if (const auto program = read_pack_kernel(damaged)) {
        ++read;
        EXPECT_EQ(find_fault(*program), "");
        EXPECT_EQ(to_bytes(*program), damaged);
      }
    }
  EXPECT_GT(read, 100) << "among them the program itself";
}

TEST(PackKernelFault, IsFoundInWhatASearchWouldTrust) {
  const std::function<void(PackKernel&)> damages[] = {
      [](PackKernel& k) { k.columns = 0; },
      [](PackKernel& k) { k.rows = 1; },
      [](PackKernel& k) { k.rows = 3; },
      [](PackKernel& k) { k.motion_variables = 3; },
      [](PackKernel& k) { k.variables = 1U << 20; },
      [](PackKernel& k) { k.constraints = 2; },
      [](PackKernel& k) { k.pose_parameters = 2; },
      [](PackKernel& k) { function(k, KernelFunction::kMatrix) = {}; },
      [](PackKernel& k) { function(k, KernelFunction::kMatrix) = values(5); },
      [](PackKernel& k) { function(k, KernelFunction::kRowScale) = values(2); },
      [](PackKernel& k) { function(k, KernelFunction::kMatrix).slots = 1U << 30; },
      [](PackKernel& k) { function(k, KernelFunction::kMatrix).code[0].a = 2; },
      [](PackKernel& k) { k.expansion.product = KernelFunction::kNominalProduct; },
      [](PackKernel& k) {
        k.expansion.derivatives[0].list.pop_back(),
            function(k, KernelFunction::kExpansionSecond) = {};
      },
      [](PackKernel& k) { k.expansion.derivatives[0].list[0].row = 2; },
      [](PackKernel& k) { k.expansion.derivatives[0].list[0].column = 2; },
      [](PackKernel& k) { k.expansion.derivatives[0].list[0].first = 2; },
      [](PackKernel& k) { k.expansion.derivatives[0].list[0].second = 1; },
      [](PackKernel& k) { k.expansion.derivatives[1].list[1].second = 2; },
      [](PackKernel& k) { k.expansion.derivatives[1].list[1].second = REGULUS_FIRST_ORDER; },
      [](PackKernel& k) { k.expansion.row_of_variable[1] = 2; },
      [](PackKernel& k) { k.expansion.row_of_variable.pop_back(); },
      [](PackKernel& k) { k.expansion.ball_of_variable[0] = -2; },
      [](PackKernel& k) { k.expansion.nominal.pop_back(); },
  };
  for (std::size_t i = 0; i < std::size(damages); ++i) {
    PackKernel k = sample();
    damages[i](k);
    EXPECT_NE(find_fault(k), "") << "damage " << i;
  }
}

}  // namespace
}  // namespace regulus::detail::machine
