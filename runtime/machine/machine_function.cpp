// SPDX-License-Identifier: Apache-2.0
#include "runtime/machine/machine_function.hpp"

#include <algorithm>
#include <cstring>
#include <map>

#include "runtime/machine/frame_slots.hpp"

namespace regulus::detail::machine {
namespace {

using Op = PackOperation;

constexpr std::uint32_t kNoSlot = static_cast<std::uint32_t>(-1);

/// Values that are the same in all parts have the same slot in all parts.
class Layout {
 public:
  Layout(const PackFunction& function, const StepTable& table)
      : function_(function),
        table_(table),
        slot_of_(function.code.size(), kNoSlot),
        last_reader_(function.code.size(), 0) {}

  void run() {
    place_constants();
    place_inputs();
    kept_ = next_;
    next_ += function_.slots;
    most_ = next_;
    find_last_readers();
    std::uint32_t begin = 0;
    for (const std::uint32_t end : function_.part_ends) {
      lay_out_part(begin, end);
      begin = end;
    }
  }

  std::vector<Step> steps;
  std::vector<Slot> constants;
  [[nodiscard]] std::size_t slots() const noexcept { return most_; }

 private:
  [[nodiscard]] const PackInstruction& at(ValueId value) const { return function_.code[value]; }

  void place_constants() {
    std::map<std::uint32_t, std::uint32_t> interval_slots, exact_slots;
    for (ValueId value = 0; value < function_.code.size(); ++value) {
      const PackInstruction& i = at(value);
      if (i.operation != Op::kConstant && i.operation != Op::kExact) continue;
      const bool exact = i.operation == Op::kExact;
      const auto [place, is_new] = (exact ? exact_slots : interval_slots).try_emplace(i.a, next_);
      slot_of_[value] = place->second;
      if (!is_new) continue;
      const Interval& bounds = function_.constants[i.a];
      Slot& slot = constants.emplace_back();
      exact ? table_.fill_exact(slot, bounds.lo) : table_.fill(slot, bounds.lo, bounds.hi);
      ++next_;
    }
  }

  /// Variables and entries of K are read once, before everything else.
  void place_inputs() {
    std::map<std::uint32_t, std::uint32_t> variable_slots, point_slots;
    for (ValueId value = 0; value < function_.code.size(); ++value) {
      const PackInstruction& i = at(value);
      if (i.operation != Op::kLoad && i.operation != Op::kPoint) continue;
      auto& known = i.operation == Op::kLoad ? variable_slots : point_slots;
      const auto [place, is_new] = known.try_emplace(i.a, next_);
      slot_of_[value] = place->second;
      if (!is_new) continue;
      steps.push_back({code_of(i.operation), next_, i.a, 0, 0});
      ++next_;
    }
  }

  /// Calls `use` with each value that the instruction reads.
  template <class Use>
  static void for_each_operand(const PackInstruction& i, Use use) {
    if (i.operation == Op::kKeep) return use(i.b);
    if (i.operation == Op::kStore) return use(i.c);
    const std::uint32_t operands[] = {i.a, i.b, i.c};
    for (int k = 0; k < operand_count(i.operation); ++k) use(operands[k]);
  }

  void find_last_readers() {
    for (ValueId reader = 0; reader < function_.code.size(); ++reader)
      for_each_operand(at(reader), [&](ValueId value) { last_reader_[value] = reader; });
  }

  void lay_out_part(std::uint32_t begin, std::uint32_t end) {
    next_ = kept_ + function_.slots;
    free_.clear();
    for (ValueId value = begin; value < end; ++value) {
      lay_out(value);
      for_each_operand(at(value), [&](ValueId operand) { release(operand, value); });
      if (has_own_slot(value) && last_reader_[value] <= value) free_.push_back(slot_of_[value]);
    }
  }

  void lay_out(ValueId value) {
    const PackInstruction& i = at(value);
    switch (i.operation) {
      case Op::kLoad:
      case Op::kPoint:
      case Op::kConstant:
      case Op::kExact:
      case Op::kCosine:  // its slot is taken together with the sine's
        return;
      case Op::kFetch:
        slot_of_[value] = kept_ + i.a;
        return;
      case Op::kKeep:
        return add({table_.copy, kept_ + i.a, 0, slot_of_[i.b], 0});
      case Op::kStore:
        return add({code_of(i.operation), 0, i.a, i.b, slot_of_[i.c]});
      case Op::kPow_IN:
        return add({code_of(i.operation), take(value), slot_of_[i.a], i.b, 0});
      case Op::kSinCos_I: {
        const std::uint32_t sine = take(value);
        return add({code_of(i.operation), sine, slot_of_[i.a], 0, take(value + 1)});
      }
      default:
        break;
    }
    const int operands = operand_count(i.operation);
    add({code_of(i.operation), take(value), slot_of_[i.a], operands > 1 ? slot_of_[i.b] : 0,
         operands > 2 ? slot_of_[i.c] : 0});
  }

  void add(const Step& step) { steps.push_back(step); }
  [[nodiscard]] StepFunction code_of(Op operation) const {
    return table_.run[static_cast<std::size_t>(operation)];
  }

  /// A result never takes the slot of its own operands: they are released after it.
  std::uint32_t take(ValueId value) {
    if (free_.empty()) {
      free_.push_back(next_++);
      most_ = std::max(most_, next_);
    }
    slot_of_[value] = free_.back();
    free_.pop_back();
    return slot_of_[value];
  }
  [[nodiscard]] bool has_own_slot(ValueId value) const {
    return slot_of_[value] != kNoSlot && slot_of_[value] >= kept_ + function_.slots;
  }
  void release(ValueId operand, ValueId reader) {
    if (last_reader_[operand] != reader || !has_own_slot(operand)) return;
    free_.push_back(slot_of_[operand]);
    last_reader_[operand] = kNoSlot;  // only once, even if an instruction reads it twice
  }

  const PackFunction& function_;
  const StepTable& table_;
  std::vector<std::uint32_t> slot_of_;
  std::vector<ValueId> last_reader_;
  std::vector<std::uint32_t> free_;
  std::uint32_t next_ = 0, kept_ = 0, most_ = 0;
};

}  // namespace

MachineFunction::MachineFunction(const PackFunction& function, const StepTable& table) {
  Layout layout(function, table);
  layout.run();
  steps_ = std::move(layout.steps);
  constants_ = std::move(layout.constants);
  slots_ = layout.slots();
}

unsigned MachineFunction::run(const double* boxes, const double* points,
                              double* out) const noexcept {
  return with_slots(slots_, [&](Slot* values) {
    if (!constants_.empty())
      std::memcpy(values, constants_.data(), constants_.size() * sizeof(Slot));
    Frame frame{boxes, points, out, values, 0};
    for (const Step& step : steps_) step.run(frame, step);
    return frame.undefined;
  });
}

}  // namespace regulus::detail::machine
