// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the seeds of the fuzzers of binary formats: write_corpus FOLDER.
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <string>

#include "codegen/kernel/jit/cache/cache_entry.hpp"
#include "runtime/machine/pack_file.hpp"

namespace {

using namespace regulus::detail::machine;
using Op = PackOperation;

/// Values 0 and 1 are x and y, 2 an entry of K, 3 and 4 constants.
constexpr PackInstruction kToIntervals[] = {{Op::kThin_P, 2},
                                            {Op::kNegate_I, 0},
                                            {Op::kAdd_II, 0, 1},
                                            {Op::kAdd_IP, 0, 2},
                                            {Op::kAdd_PI, 2, 1},
                                            {Op::kAdd_PP, 2, 4},
                                            {Op::kSubtract_II, 0, 1},
                                            {Op::kSubtract_IP, 0, 2},
                                            {Op::kSubtract_PI, 2, 1},
                                            {Op::kSubtract_PP, 2, 4},
                                            {Op::kMultiply_II, 0, 1},
                                            {Op::kMultiply_IP, 0, 2},
                                            {Op::kMultiply_PI, 2, 1},
                                            {Op::kMultiply_PP, 2, 4},
                                            {Op::kMulAdd_III, 0, 1, 3},
                                            {Op::kMulAdd_IPI, 0, 2, 3},
                                            {Op::kMulAdd_PII, 2, 1, 3},
                                            {Op::kMulAdd_PPI, 2, 4, 3},
                                            {Op::kSqr_I, 0},
                                            {Op::kPow_IN, 0, 3},
                                            {Op::kAbs_I, 1},
                                            {Op::kSin_I, 0},
                                            {Op::kCos_I, 1},
                                            {Op::kAtan_I, 0},
                                            {Op::kChecked_IU, 0},
                                            {Op::kDiv_IIU, 0, 1},
                                            {Op::kSqrt_IU, 1},
                                            {Op::kTan_IU, 0},
                                            {Op::kAsin_IU, 0},
                                            {Op::kAcos_IU, 0},
                                            {Op::kAtan2_IIU, 0, 1},
                                            {Op::kExp_IU, 0},
                                            {Op::kLog_IU, 1}};
constexpr PackInstruction kToPoints[] = {{Op::kPointOf_I, 3},      {Op::kNegate_P, 2},
                                         {Op::kExactAdd_PP, 2, 4}, {Op::kExactSub_PP, 2, 4},
                                         {Op::kExactMul_PP, 2, 4}, {Op::kExactMulAdd_PPP, 2, 4, 4}};

/// Every operation of packs, on x, y and an entry of K: a column of as many entries as there are
/// operations with an interval for a result.
PackFunction every_operation() {
  PackFunction f;
  f.code = {{Op::kLoad, 0}, {Op::kLoad, 1}, {Op::kPoint, 0}, {Op::kConstant, 0}, {Op::kExact, 1}};
  f.constants = {{0x1.5p-1, 0x1.6p-1}, {3.0, 3.0}};
  f.slots = 1;
  const auto add = [&f](PackInstruction i) { f.code.push_back(i); };
  const auto store = [&](std::uint32_t value) {
    add({Op::kStore, f.outputs, f.outputs, value}), ++f.outputs;
  };
  const auto last = [&f] { return static_cast<std::uint32_t>(f.code.size() - 1); };
  for (const PackInstruction i : kToIntervals) {
    add(i);
    store(last());
  }
  for (const PackInstruction i : kToPoints) {
    add(i);
    add({Op::kThin_P, last()});
    store(last());
  }
  add({Op::kSinCos_I, 0});
  add({Op::kCosine, last()});
  store(last());
  add({Op::kKeep, 0, 0});
  f.part_ends = {last() + 1};
  add({Op::kFetch, 0});
  store(last());
  f.part_ends.push_back(last() + 1);
  return f;
}

/// Stores x in so many outputs.
PackFunction values(std::uint32_t outputs) {
  PackFunction f;
  f.code = {{Op::kLoad, 0}, {Op::kStore, 0, outputs - 1, 0}};
  f.part_ends = {2};
  f.outputs = outputs;
  return f;
}

PackKernel pack_kernel() {
  PackKernel k;
  k.variables = 2;
  k.motion_variables = k.columns = 1;
  k.functions[0] = every_operation();
  k.rows = k.functions[0].outputs;
  k.identity = "0123456789abcdef";
  const auto function = [&k](regulus::detail::KernelFunction f) -> PackFunction& {
    return k.functions[static_cast<std::size_t>(f)];
  };
  using enum regulus::detail::KernelFunction;
  function(kLeftProduct) = values(1);
  function(kNominalFirst) = values(1);
  function(kExpansionSecond) = values(2);
  k.has_expansion = true;
  k.expansion.product = kLeftProduct;
  k.expansion.derivatives.fill({kNominalFirst, {}});
  k.expansion.derivatives[0] = {kNominalFirst, {{0, 0, 0, REGULUS_FIRST_ORDER}}};
  k.expansion.derivatives[1] = {kExpansionSecond, {{0, 0, 0, 0}, {0, 0, 0, 1}}};
  k.expansion.row_of_variable = {-1, 1};
  k.expansion.ball_of_variable = {-1, 0};
  k.expansion.nominal = {{0, 0}, {-1, 0x1.8p-3}};
  return k;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 64;
  const std::string folder = argv[1];
  const std::string bytes = "an object";
  const auto header = regulus::detail::make_cache_entry_header(std::string(64, 'a'), bytes);
  const PackKernel kernel = pack_kernel();
  if (const std::string fault = find_fault(kernel); !fault.empty()) {
    std::cerr << fault << '\n';
    return 1;
  }
  std::ofstream(folder + "/pack_file/sound", std::ios::binary) << to_bytes(kernel);
  std::ofstream(folder + "/cache_entry/sound", std::ios::binary)
      << std::string(reinterpret_cast<const char*>(&header), sizeof header) << bytes;
}
