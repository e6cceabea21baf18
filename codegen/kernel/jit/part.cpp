// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/part.hpp"

#include <bit>
#include <cstring>
#include <map>
#include <utility>

#include "codegen/kernel/jit/cache/key_parts.hpp"
#include "runtime/kernel/abi.hpp"

namespace regulus::detail {
namespace {

using machine::PackInstruction;
using Op = machine::PackOperation;

/// Increase it if the interface between a part's code and its caller changes.
constexpr int kPartVersion = 1;

class Cutter {
 public:
  Cutter(const machine::PackFunction& function, std::uint32_t begin)
      : function_(function), begin_(begin) {}

  void add(const PackInstruction& i) {
    PackInstruction own{i.operation};
    switch (i.operation) {
      case Op::kConstant:
      case Op::kExact:
        own.a = constant(i.a);
        break;
      case Op::kLoad:
      case Op::kPoint:
      case Op::kFetch:
        own.a = i.a;
        break;
      case Op::kKeep:
        own.a = i.a;
        own.b = i.b - begin_;
        break;
      case Op::kStore:
        own.a = i.a;
        own.b = i.b;
        own.c = i.c - begin_;
        break;
      case Op::kPow_IN:
        own.a = i.a - begin_;
        own.b = i.b;
        break;
      default: {
        const int count = machine::operand_count(i.operation);
        if (count > 0) own.a = i.a - begin_;
        if (count > 1) own.b = i.b - begin_;
        if (count > 2) own.c = i.c - begin_;
      }
    }
    part_.code.push_back(own);
  }

  PartProgram take() { return std::move(part_); }

 private:
  /// Compares bits: −0 and 0 are different constants.
  std::uint32_t constant(std::uint32_t number) {
    const Interval& x = function_.constants[number];
    const std::pair bits(std::bit_cast<std::uint64_t>(x.lo), std::bit_cast<std::uint64_t>(x.hi));
    const auto [place, is_new] =
        numbers_.try_emplace(bits, static_cast<std::uint32_t>(part_.constants.size()));
    if (is_new) part_.constants.push_back(x);
    return place->second;
  }

  const machine::PackFunction& function_;
  std::uint32_t begin_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::uint32_t> numbers_;
  PartProgram part_;
};

template <class Item>
void append(std::string& bytes, const Item* items, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(items), count * sizeof(Item));
}

// No padding, so that the bytes in memory contain only the instruction.
struct Record {
  std::uint32_t operation, a, b, c;
};

}  // namespace

std::string part_bytes(const machine::PackFunction& function, std::size_t part) {
  const std::uint32_t begin = part == 0 ? 0 : function.part_ends[part - 1];
  Cutter cutter(function, begin);
  for (std::uint32_t at = begin; at < function.part_ends[part]; ++at) cutter.add(function.code[at]);
  const PartProgram cut = cutter.take();
  const auto count = static_cast<std::uint64_t>(cut.code.size());
  std::string bytes;
  append(bytes, &count, 1);
  for (const PackInstruction& i : cut.code) {
    const Record record{static_cast<std::uint32_t>(i.operation), i.a, i.b, i.c};
    append(bytes, &record, 1);
  }
  append(bytes, cut.constants.data(), cut.constants.size());
  return bytes;
}

PartProgram read_part(std::string_view bytes) {
  const auto take = [&bytes](auto& item) {
    std::memcpy(static_cast<void*>(&item), bytes.data(), sizeof item);
    bytes.remove_prefix(sizeof item);
  };
  PartProgram part;
  std::uint64_t count = 0;
  take(count);
  for (Record record{}; part.code.size() < count;) {
    take(record);
    part.code.push_back({static_cast<Op>(record.operation), record.a, record.b, record.c});
  }
  part.constants.resize(bytes.size() / sizeof(Interval));
  for (Interval& x : part.constants) take(x);
  return part;
}

std::string part_name(std::string_view bytes, std::string_view isa, std::string_view compiler) {
  KeyParts key;
  key.add("part");
  key.add(kPartVersion);
  key.add(REGULUS_KERNEL_ABI);
  key.add(compiler);
  key.add(isa);
  key.add(bytes);
  return key.key();
}

}  // namespace regulus::detail
