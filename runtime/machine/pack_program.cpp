// SPDX-License-Identifier: Apache-2.0
#include "runtime/machine/pack_program.hpp"

#include <string_view>

namespace regulus::detail::machine {
namespace {

using Op = PackOperation;

/// The types of an operation's operands and of its result, as letters: I, P, or - for none.
struct Signature {
  std::string_view operands;
  char result;
};

constexpr std::array<Signature, kPackOperations> kSignatures = {{
    {"", 'I'},                                               // kLoad
    {"", 'P'},                                               // kPoint
    {"", 'I'},                                               // kConstant
    {"", 'P'},                                               // kExact
    {"", 'I'},                                               // kFetch
    {"", '-'},                                               // kKeep
    {"", '-'},                                               // kStore
    {"P", 'I'},                                              // kThin_P
    {"I", 'P'},                                              // kPointOf_I
    {"P", 'P'},                                              // kNegate_P
    {"PP", 'P'},                                             // kExactAdd_PP
    {"PP", 'P'},                                             // kExactSub_PP
    {"PP", 'P'},                                             // kExactMul_PP
    {"PPP", 'P'},                                            // kExactMulAdd_PPP
    {"I", 'I'},                                              // kNegate_I
    {"II", 'I'},  {"IP", 'I'},  {"PI", 'I'},  {"PP", 'I'},   // kAdd
    {"II", 'I'},  {"IP", 'I'},  {"PI", 'I'},  {"PP", 'I'},   // kSubtract
    {"II", 'I'},  {"IP", 'I'},  {"PI", 'I'},  {"PP", 'I'},   // kMultiply
    {"III", 'I'}, {"IPI", 'I'}, {"PII", 'I'}, {"PPI", 'I'},  // kMulAdd
    {"I", 'I'},                                              // kSqr_I
    {"I", 'I'},                                              // kPow_IN
    {"I", 'I'},                                              // kAbs_I
    {"I", 'I'},   {"I", 'I'},   {"I", 'I'},                  // kSin_I kCos_I kAtan_I
    {"I", 'I'},                                              // kSinCos_I
    {"I", 'I'},                                              // kCosine
    {"I", 'I'},                                              // kChecked_IU
    {"II", 'I'},                                             // kDiv_IIU
    {"I", 'I'},   {"I", 'I'},   {"I", 'I'},   {"I", 'I'},    // kSqrt kTan kAsin kAcos
    {"II", 'I'},                                             // kAtan2_IIU
    {"I", 'I'},   {"I", 'I'},                                // kExp_IU kLog_IU
}};

const Signature& signature(Op operation) noexcept {
  return kSignatures[static_cast<std::size_t>(operation)];
}

/// Goes through a list once, in order.
class FaultFinder {
 public:
  FaultFinder(const PackFunction& function, std::uint32_t variables, std::uint32_t points)
      : function_(function), variables_(variables), points_(points) {}

  std::string run() {
    for (const Interval& constant : function_.constants)
      if (!(constant.lo <= constant.hi)) return "a constant has no bounds in order";
    std::uint32_t begin = 0;
    for (const std::uint32_t end : function_.part_ends) {
      if (end < begin || end > function_.code.size())
        return "a part does not end within the list, after the one before";
      fetched_.assign(function_.slots, false);
      for (std::uint32_t at = begin; at < end; ++at)
        if (std::string fault = fault_of(begin, at); !fault.empty())
          return "instruction " + std::to_string(at) + " " + fault;
      begin = end;
    }
    if (begin != function_.code.size()) return "instructions belong to no part";
    for (const bool stored : stored_)
      if (!stored) return "an output is not stored";
    return {};
  }

 private:
  std::string fault_of(std::uint32_t begin, std::uint32_t at) {
    const PackInstruction& i = function_.code[at];
    if (static_cast<std::size_t>(i.operation) >= kPackOperations) return "is no operation";
    const std::uint32_t operands[] = {i.a, i.b, i.c};
    const std::string_view kinds = signature(i.operation).operands;
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (!is_value(operands[k], kinds[k], begin, at)) return "reads no value of that kind";
    switch (i.operation) {
      case Op::kLoad:
        return i.a < variables_ ? "" : "loads no variable";
      case Op::kPoint:
        return i.a < points_ ? "" : "reads no entry of K";
      case Op::kConstant:
        return is_constant(i.a) ? "" : "reads no constant";
      case Op::kExact:
        return is_constant(i.a) && function_.constants[i.a].lo == function_.constants[i.a].hi
                   ? ""
                   : "reads no exact constant";
      case Op::kFetch:
        if (i.a >= function_.slots || !kept_[i.a]) return "fetches what was not kept";
        fetched_[i.a] = true;
        return {};
      case Op::kKeep:
        if (i.a >= function_.slots || !is_value(i.b, 'I', begin, at)) return "keeps no interval";
        if (fetched_[i.a]) return "keeps an interval in a slot that its part still reads";
        kept_[i.a] = true;
        return {};
      case Op::kStore:
        return fault_of_store(i, begin, at);
      case Op::kPow_IN:
        return i.b >= 2 ? "" : "has an exponent below 2";
      case Op::kSinCos_I:
        return at + 1 < function_.code.size() &&
                       function_.code[at + 1] == PackInstruction{Op::kCosine, at}
                   ? ""
                   : "has no cosine beside it";
      case Op::kCosine:
        return i.a + 1 == at && function_.code[i.a].operation == Op::kSinCos_I
                   ? ""
                   : "is the cosine of no pair";
      default:
        return {};
    }
  }

  std::string fault_of_store(const PackInstruction& i, std::uint32_t begin, std::uint32_t at) {
    if (i.a > i.b || i.b >= function_.outputs || !is_value(i.c, 'I', begin, at))
      return "stores no output";
    for (std::uint32_t e = i.a; e <= i.b; ++e) {
      if (stored_[e]) return "stores an output again";
      stored_[e] = true;
    }
    return {};
  }

  [[nodiscard]] bool is_constant(std::uint32_t number) const {
    return number < function_.constants.size();
  }
  [[nodiscard]] bool is_value(ValueId value, char kind, std::uint32_t begin,
                              std::uint32_t at) const {
    return begin <= value && value < at &&
           signature(function_.code[value].operation).result == kind;
  }

  const PackFunction& function_;
  std::uint32_t variables_, points_;
  std::vector<bool> fetched_;  ///< by the present part
  std::vector<bool> kept_ = std::vector<bool>(function_.slots);
  std::vector<bool> stored_ = std::vector<bool>(function_.outputs);
};

}  // namespace

int operand_count(PackOperation operation) noexcept {
  return static_cast<int>(signature(operation).operands.size());
}

std::string find_fault(const PackFunction& function, std::uint32_t variables,
                       std::uint32_t points) {
  return FaultFinder(function, variables, points).run();
}

}  // namespace regulus::detail::machine
