// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/builder/operations.hpp"

#include <llvm/ADT/DenseMap.h>
#include <llvm/Analysis/InstructionSimplify.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/IntrinsicInst.h>

#include <algorithm>

#include "regulus/codegen/jit/reader/token.hpp"

namespace regulus::codegen::builder {
namespace {

using reader::OutsideSubset;

constexpr std::uint64_t kIntervalBytes = 128;  // eight lanes of two doubles, whatever the packs
constexpr std::uint64_t kAlignment = 64;

/// Whether all that the operation does is to compute components from components.
bool is_straight(const llvm::Function& operation) {
  if (operation.size() != 1) return false;
  const auto& block = operation.getEntryBlock();
  return std::none_of(block.begin(), block.end(), [](const llvm::Instruction& i) {
    const auto* call = llvm::dyn_cast<llvm::CallBase>(&i);
    const bool real_call =
        call && (!call->getCalledFunction() || !call->getCalledFunction()->isIntrinsic());
    return real_call || llvm::isa<llvm::AllocaInst, llvm::MemIntrinsic>(i);
  });
}

llvm::Align alignment_of(llvm::Type* type, const llvm::DataLayout& layout) {
  return llvm::Align(std::min<std::uint64_t>(kAlignment, layout.getTypeStoreSize(type)));
}

/// Where a pointer inside an operation points: an argument of it and an offset.
struct Target {
  const llvm::Argument* argument = nullptr;
  std::uint64_t offset = 0;
};

Target target_of(llvm::Value* pointer, const llvm::DataLayout& layout) {
  std::int64_t offset = 0;
  const auto* base = llvm::GetPointerBaseWithConstantOffset(pointer, offset, layout);
  return {llvm::dyn_cast<llvm::Argument>(base), static_cast<std::uint64_t>(offset)};
}

void set_component(Object& object, std::uint64_t offset, llvm::Value* value) {
  const auto found =
      std::find_if(object.components.begin(), object.components.end(),
                   [&](const Component& component) { return component.offset == offset; });
  if (found != object.components.end())
    found->value = value;
  else
    object.components.push_back({offset, value});
}

}  // namespace

Operations::Operations(llvm::Module& module)
    : module_(module), load_(module.getFunction("regulus_load")) {
  if (!load_ || load_->empty()) throw OutsideSubset("the operations of the packs are missing");
  for (llvm::Instruction& i : load_->getEntryBlock())
    if (auto* store = llvm::dyn_cast<llvm::StoreInst>(&i))
      layout_.push_back({target_of(store->getPointerOperand(), module.getDataLayout()).offset,
                         store->getValueOperand()->getType()});
  std::uint64_t bytes = 0;
  for (const Part& part : layout_) bytes += module.getDataLayout().getTypeStoreSize(part.type);
  if (bytes != kIntervalBytes) throw OutsideSubset("the packs keep intervals in another way");
}

void Operations::apply(llvm::IRBuilder<>& code, const std::string& name,
                       llvm::ArrayRef<Operand> operands) {
  llvm::Function* operation = module_.getFunction("regulus_" + name);
  if (!operation || operation->empty() || operation->arg_size() != operands.size())
    throw OutsideSubset("the packs have no operation " + name);
  if (is_straight(*operation))
    expand(code, *operation, operands);
  else
    call(code, *operation, operands);
}

/// A copy of the operation's instructions in which each access to an object is the object's
/// component. Instructions are copied with their rounding, never rewritten; the simplifier folds
/// what is constant by the rules that hold in any rounding mode.
void Operations::expand(llvm::IRBuilder<>& code, llvm::Function& operation,
                        llvm::ArrayRef<Operand> operands) {
  const llvm::DataLayout& layout = module_.getDataLayout();
  llvm::DenseMap<const llvm::Value*, llvm::Value*> copies;
  const auto object_at = [&](const Target& target) -> Object* {
    if (!target.argument) return nullptr;
    const auto* object = std::get_if<Object*>(&operands[target.argument->getArgNo()]);
    return object ? *object : nullptr;
  };
  const auto copy_of = [&](llvm::Value* value) {
    const auto found = copies.find(value);
    return found == copies.end() ? value : found->second;
  };
  for (llvm::Argument& argument : operation.args())
    if (const auto* value = std::get_if<llvm::Value*>(&operands[argument.getArgNo()]))
      copies[&argument] = *value;

  for (llvm::Instruction& i : operation.getEntryBlock()) {
    if (i.isTerminator()) return;
    if (llvm::Value* pointer = llvm::getLoadStorePointerOperand(&i)) {
      const Target target = target_of(pointer, layout);
      if (Object* object = object_at(target)) {
        if (auto* store = llvm::dyn_cast<llvm::StoreInst>(&i))
          set_component(*object, target.offset, copy_of(store->getValueOperand()));
        else
          copies[&i] = component(code, *object, target.offset, i.getType());
        continue;
      }
    }
    if (llvm::isa<llvm::GetElementPtrInst>(i) && object_at(target_of(&i, layout))) continue;
    if (llvm::isa<llvm::NoAliasScopeDeclInst>(i)) continue;
    llvm::Instruction* copy = i.clone();
    // What it says of aliasing held for the one place in the operation.
    copy->dropUnknownNonDebugMetadata();
    for (llvm::Use& use : copy->operands()) use.set(copy_of(use.get()));
    code.Insert(copy);
    copies[&i] = copy;
    if (llvm::Value* simpler = llvm::simplifyInstruction(copy, {layout, copy})) {
      copies[&i] = simpler;
      copy->eraseFromParent();
    }
  }
}

void Operations::call(llvm::IRBuilder<>& code, llvm::Function& operation,
                      llvm::ArrayRef<Operand> operands) {
  llvm::SmallVector<llvm::Value*, 4> arguments;
  for (const Operand& operand : operands)
    arguments.push_back(std::holds_alternative<Object*>(operand)
                            ? address(code, *std::get<Object*>(operand))
                            : std::get<llvm::Value*>(operand));
  code.CreateCall(&operation, arguments);
  for (const Operand& operand : operands)
    if (auto* const* object = std::get_if<Object*>(&operand); object && (*object)->changes) {
      Object& mask = **object;
      mask.components.clear();
      set_component(mask, 0, component(code, mask, 0, code.getInt32Ty()));
    }
}

llvm::Value* Operations::reserve(llvm::IRBuilder<>& code, std::uint64_t intervals) {
  llvm::BasicBlock& first = code.GetInsertBlock()->getParent()->getEntryBlock();
  llvm::IRBuilder<> front(&first, first.begin());
  auto* memory =
      front.CreateAlloca(llvm::ArrayType::get(front.getInt8Ty(), intervals * kIntervalBytes));
  memory->setAlignment(llvm::Align(kAlignment));
  return memory;
}

llvm::Value* Operations::at(llvm::IRBuilder<>& code, llvm::Value* address, std::uint64_t offset) {
  return offset == 0 ? address : code.CreateConstInBoundsGEP1_64(code.getInt8Ty(), address, offset);
}

llvm::Value* Operations::component(llvm::IRBuilder<>& code, Object& object, std::uint64_t offset,
                                   llvm::Type* type) {
  for (const Component& component : object.components)
    if (component.offset == offset) {
      if (!component.value->getType()->canLosslesslyBitCastTo(type))
        throw OutsideSubset("an operation that takes its operand apart");
      return code.CreateBitCast(component.value, type);
    }
  if (!object.address) throw OutsideSubset("a value that is used before it has one");
  llvm::Value* value = code.CreateAlignedLoad(type, at(code, object.address, offset),
                                              alignment_of(type, module_.getDataLayout()));
  set_component(object, offset, value);
  return value;
}

Object Operations::read(llvm::IRBuilder<>& code, llvm::Value* address) {
  Object object;
  object.address = address;
  for (const Part& part : layout_) (void)component(code, object, part.offset, part.type);
  object.address = nullptr;
  return object;
}

void Operations::write(llvm::IRBuilder<>& code, Object& value, llvm::Value* address) {
  for (const Part& part : layout_)
    code.CreateAlignedStore(component(code, value, part.offset, part.type),
                            at(code, address, part.offset),
                            alignment_of(part.type, module_.getDataLayout()));
}

llvm::Value* Operations::address(llvm::IRBuilder<>& code, Object& object) {
  const bool written = object.address && !object.changes;
  if (!object.address) object.address = reserve(code, 1);
  if (!written)
    for (const Component& component : object.components)
      code.CreateAlignedStore(component.value, at(code, object.address, component.offset),
                              alignment_of(component.value->getType(), module_.getDataLayout()));
  return object.address;
}

}  // namespace regulus::codegen::builder
