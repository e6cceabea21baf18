// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/llvm/part_builder.hpp"

#include <llvm/IR/Constants.h>
#include <llvm/IR/Instructions.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <stdexcept>

#include "codegen/kernel/jit/part_code.hpp"
#include "runtime/machine/step.hpp"

namespace regulus::detail::builder {
namespace {

using machine::Frame;
using machine::PackInstruction;
using machine::Slot;
using machine::Step;
using Op = machine::PackOperation;

/// The names of the operations in pack_operations.hpp, in the order of PackOperation. Null: the
/// operation has no straight form for any instruction set, or is not an operation of packs.
constexpr std::array<const char*, machine::kPackOperations> kNames = {
    "load",         "point",
    "constant_DD",  "P_D",
    nullptr,        nullptr,
    "store",        "thin_P",
    "point_of_I",   "negate_P",
    "exact_add_PP", "exact_sub_PP",
    "exact_mul_PP", "exact_mul_add_PPP",
    "negate_I",     "add_II",
    "add_IP",       "add_PI",
    "add_PP",       "subtract_II",
    "subtract_IP",  "subtract_PI",
    "subtract_PP",  "multiply_II",
    "multiply_IP",  "multiply_PI",
    "multiply_PP",  "mul_add_III",
    "mul_add_IPI",  "mul_add_PII",
    "mul_add_PPI",  "sqr_I",
    nullptr,        "abs_I",
    nullptr,        nullptr,
    nullptr,        nullptr,
    nullptr,        "checked_IU",
    "div_IIU",      "sqrt_IU",
    nullptr,        nullptr,
    nullptr,        nullptr,
    nullptr,        nullptr};

/// The most instructions of an operation that is expanded. A longer one is called as a step of the
/// vector machine: for AVX2 and the portable packs, expansion makes code that no cache of the
/// processor holds, which takes four times as long to run and twice as long to compile.
constexpr std::size_t kLongestExpansion = 56;

bool marks_undefined(Op operation) { return operation >= Op::kChecked_IU; }

class PartBuilder {
 public:
  PartBuilder(const PartProgram& part, Operations& packs, llvm::Module& module)
      : part_(part),
        packs_(packs),
        function_(declare(module)),
        entry_(llvm::BasicBlock::Create(module.getContext(), "", &function_)),
        code_(llvm::BasicBlock::Create(module.getContext(), "", &function_)),
        values_(part.code.size()) {
    undefined_.components.push_back({0, code_.getInt32(0)});
  }

  void run() {
    for (std::size_t at = 0; at < part_.code.size(); ++at) build(at);
    llvm::Value* undefined = packs_.component(code_, undefined_, 0, code_.getInt32Ty());
    code_.CreateRet(undefined);
    finish_entry();
  }

 private:
  enum Parameter : unsigned { kBoxes, kPoints, kSlots, kOut, kOperations };

  llvm::Function& declare(llvm::Module& module) {
    llvm::LLVMContext& context = module.getContext();
    const llvm::SmallVector<llvm::Type*, 5> parameters(5, llvm::PointerType::getUnqual(context));
    auto* function = llvm::Function::Create(
        llvm::FunctionType::get(llvm::Type::getInt32Ty(context), parameters, false),
        llvm::GlobalValue::ExternalLinkage, llvm::StringRef(kPartSymbol), module);
    llvm::AttrBuilder attributes(context, packs_.sample().getAttributes().getFnAttrs());
    attributes.removeAttribute(llvm::Attribute::Memory);
    attributes.removeAttribute(llvm::Attribute::AlwaysInline);
    function->addFnAttrs(attributes);
    function->setDSOLocal(true);
    return *function;
  }

  void build(std::size_t at) {
    const PackInstruction& i = part_.code[at];
    Object& result = values_[at];
    switch (i.operation) {
      case Op::kLoad:
        return expand(i.operation, {&result, row(kBoxes, 2 * i.a)});
      case Op::kPoint:
        return expand(i.operation, {&result, row(kPoints, i.a)});
      case Op::kConstant:
        return expand(i.operation,
                      {&result, number(part_.constants[i.a].lo), number(part_.constants[i.a].hi)});
      case Op::kExact:
        return expand(i.operation, {&result, number(part_.constants[i.a].lo)});
      case Op::kFetch:
        result = packs_.read(code_, slot(function_.getArg(kSlots), i.a));
        return;
      case Op::kKeep:
        return packs_.write(code_, values_[i.b], slot(function_.getArg(kSlots), i.a));
      case Op::kStore:
        for (std::uint32_t e = i.a; e <= i.b; ++e)
          expand(i.operation, {row(kOut, 2 * e), &values_[i.c]});
        return;
      case Op::kCosine:
        return;  // the sine's step gives its value
      default:
        return compute(i, at);
    }
  }

  void compute(const PackInstruction& i, std::size_t at) {
    const llvm::Function* straight = find(i.operation);
    if (!straight || straight->getInstructionCount() > kLongestExpansion) return call_step(i, at);
    llvm::SmallVector<Operand, 4> operands{&values_[at]};
    const std::uint32_t read[] = {i.a, i.b, i.c};
    for (int k = 0; k < machine::operand_count(i.operation); ++k)
      operands.push_back(&values_[read[k]]);
    if (marks_undefined(i.operation)) operands.push_back(&undefined_);
    expand(i.operation, operands);
  }

  llvm::Function* find(Op operation) {
    const char* name = kNames[static_cast<std::size_t>(operation)];
    return name ? packs_.find_straight(name) : nullptr;
  }

  void expand(Op operation, llvm::ArrayRef<Operand> operands) {
    llvm::Function* straight = find(operation);
    if (!straight || straight->arg_size() != operands.size())
      throw std::runtime_error("the packs have no operation " +
                               std::to_string(static_cast<int>(operation)));
    packs_.expand(code_, *straight, operands);
  }

  /// run(frame, step), as the vector machine does.
  void call_step(const PackInstruction& i, std::size_t at) {
    Step step{nullptr, 0, place(values_[i.a]), i.b, i.c};
    const int operands = machine::operand_count(i.operation);
    if (operands > 1) step.b = place(values_[i.b]);
    if (operands > 2) step.c = place(values_[i.c]);
    step.r = take(values_[at]);
    if (i.operation == Op::kSinCos_I) step.c = take(values_[at + 1]);

    llvm::Value* mask = field(offsetof(Frame, undefined));
    packs_.write_components(code_, undefined_, mask);
    llvm::Type* pointer = code_.getPtrTy();
    llvm::Value* run = code_.CreateLoad(
        pointer, code_.CreateConstInBoundsGEP1_64(pointer, function_.getArg(kOperations),
                                                  static_cast<std::uint64_t>(i.operation)));
    code_.CreateCall(llvm::FunctionType::get(code_.getVoidTy(), {pointer, pointer}, false), run,
                     {frame(), constant(step)});
    undefined_ = {};
    undefined_.address = mask;
    (void)packs_.component(code_, undefined_, 0, code_.getInt32Ty());
  }

  /// Returns the number of the frame's slot of a value; writes the value there if necessary.
  std::uint32_t place(Object& value) {
    if (const auto found = slot_of_.find(&value); found != slot_of_.end()) return found->second;
    const std::uint32_t number = take(value);
    packs_.write_components(code_, value, value.address);
    return number;
  }
  std::uint32_t take(Object& value) {
    const auto number = static_cast<std::uint32_t>(slot_of_.size());
    slot_of_[&value] = number;
    value.address = slot(frame_slots(), number);
    return number;
  }

  llvm::Value* frame() {
    if (!frame_) frame_ = reserve(sizeof(Frame), alignof(Frame));
    return frame_;
  }
  llvm::Value* frame_slots() {
    if (!slots_) slots_ = reserve(sizeof(Slot), alignof(Slot));  // one slot for now
    return slots_;
  }
  llvm::AllocaInst* reserve(std::uint64_t size, std::uint64_t alignment) {
    llvm::IRBuilder<> front(entry_);
    auto* memory = front.CreateAlloca(front.getInt8Ty(), front.getInt64(size));
    memory->setAlignment(llvm::Align(alignment));
    return memory;
  }

  /// Gives the frame its slots; their number is known now.
  void finish_entry() {
    llvm::IRBuilder<> front(entry_);
    if (slots_) slots_->setOperand(0, front.getInt64(slot_of_.size() * sizeof(Slot)));
    if (frame_)
      front.CreateStore(slots_, front.CreateConstInBoundsGEP1_64(front.getInt8Ty(), frame_,
                                                                 offsetof(Frame, slots)));
    front.CreateBr(code_.GetInsertBlock());
  }

  llvm::Value* field(std::uint64_t offset) {
    return code_.CreateConstInBoundsGEP1_64(code_.getInt8Ty(), frame(), offset);
  }
  llvm::Value* slot(llvm::Value* slots, std::uint64_t number) {
    return code_.CreateConstInBoundsGEP1_64(code_.getInt8Ty(), slots, number * sizeof(Slot));
  }
  llvm::Value* row(Parameter array, std::uint64_t number) {
    return code_.CreateConstInBoundsGEP1_64(code_.getDoubleTy(), function_.getArg(array),
                                            REGULUS_LANES * number);
  }
  llvm::Value* number(double value) { return llvm::ConstantFP::get(code_.getDoubleTy(), value); }

  llvm::Constant* constant(const Step& step) {
    std::array<std::uint8_t, sizeof(Step)> bytes{};
    std::memcpy(bytes.data(), &step, sizeof step);
    llvm::Constant* data = llvm::ConstantDataArray::get(code_.getContext(), bytes);
    auto* global = new llvm::GlobalVariable(*function_.getParent(), data->getType(), true,
                                            llvm::GlobalValue::PrivateLinkage, data);
    global->setAlignment(llvm::Align(alignof(Step)));
    return global;
  }

  const PartProgram& part_;
  Operations& packs_;
  llvm::Function& function_;
  llvm::BasicBlock* entry_;
  llvm::IRBuilder<> code_;
  std::vector<Object> values_;  ///< of each instruction; they do not move
  Object undefined_;
  llvm::AllocaInst* frame_ = nullptr;
  llvm::AllocaInst* slots_ = nullptr;
  llvm::DenseMap<const Object*, std::uint32_t> slot_of_;
};

}  // namespace

void build_part(const PartProgram& part, Operations& packs, llvm::Module& module) {
  PartBuilder(part, packs, module).run();
}

}  // namespace regulus::detail::builder
