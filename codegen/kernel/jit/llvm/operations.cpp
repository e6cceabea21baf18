// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/llvm/operations.hpp"

#include <llvm/ADT/DenseMap.h>
#include <llvm/Analysis/InstructionSimplify.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/IntrinsicInst.h>

#include <algorithm>
#include <stdexcept>

#include "runtime/machine/step.hpp"

namespace regulus::detail::builder {
namespace {

constexpr std::uint64_t kAlignment = 64;

bool refers_to_a_global(const llvm::Instruction& i) {
  const auto* call = llvm::dyn_cast<llvm::CallBase>(&i);
  return std::any_of(i.op_begin(), i.op_end(), [&](const llvm::Use& use) {
    return llvm::isa<llvm::GlobalValue>(use) && !(call && call->isCallee(&use));
  });
}

/// True if the operation only computes components from components.
bool is_straight(const llvm::Function& operation) {
  if (operation.size() != 1) return false;
  const auto& block = operation.getEntryBlock();
  return std::none_of(block.begin(), block.end(), [](const llvm::Instruction& i) {
    const auto* call = llvm::dyn_cast<llvm::CallBase>(&i);
    const bool real_call =
        call && (!call->getCalledFunction() || !call->getCalledFunction()->isIntrinsic());
    return real_call || refers_to_a_global(i) || llvm::isa<llvm::AllocaInst, llvm::MemIntrinsic>(i);
  });
}

/// Makes a copied call of an intrinsic function refer to the function in its new module.
void move_callee(llvm::Instruction& copy, llvm::Module& module) {
  auto* call = llvm::dyn_cast<llvm::CallBase>(&copy);
  if (!call) return;
  const llvm::Function* callee = call->getCalledFunction();
  call->setCalledFunction(module.getOrInsertFunction(callee->getName(), callee->getFunctionType(),
                                                     callee->getAttributes()));
}

llvm::Align alignment_of(llvm::Type* type, const llvm::DataLayout& layout) {
  return llvm::Align(std::min<std::uint64_t>(kAlignment, layout.getTypeStoreSize(type)));
}

/// The target of a pointer inside an operation: an argument of the operation and an offset.
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

Operations::Operations(llvm::Module& packs) : packs_(packs), load_(find_straight("load")) {
  if (!load_) throw std::runtime_error("the operations of the packs are missing");
  const llvm::DataLayout& layout = packs.getDataLayout();
  std::uint64_t bytes = 0;
  for (llvm::Instruction& i : load_->getEntryBlock())
    if (auto* store = llvm::dyn_cast<llvm::StoreInst>(&i)) {
      layout_.push_back({target_of(store->getPointerOperand(), layout).offset,
                         store->getValueOperand()->getType()});
      bytes += layout.getTypeStoreSize(layout_.back().type);
    }
  if (bytes != sizeof(machine::Slot))
    throw std::runtime_error("the packs keep intervals in another way");
}

llvm::Function* Operations::find_straight(const char* name) {
  const auto [place, is_new] = straight_.try_emplace(name, nullptr);
  if (!is_new) return place->second;
  llvm::Function* operation = packs_.getFunction(("regulus_" + llvm::StringRef(name)).str());
  if (!operation) return nullptr;
  if (llvm::Error error = operation->materialize())
    throw std::runtime_error(llvm::toString(std::move(error)));
  if (is_straight(*operation)) place->second = operation;
  return place->second;
}

/// A copy of the operation's instructions in which each access to an object is the object's
/// component. Instructions are copied with their rounding, never rewritten; the simplifier folds
/// constants by rules that hold in any rounding mode.
void Operations::expand(llvm::IRBuilder<>& code, llvm::Function& operation,
                        llvm::ArrayRef<Operand> operands) {
  llvm::Module& module = *code.GetInsertBlock()->getModule();
  const llvm::DataLayout& layout = module.getDataLayout();
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
    // Its aliasing metadata is valid only at its original place.
    copy->dropUnknownNonDebugMetadata();
    for (llvm::Use& use : copy->operands()) use.set(copy_of(use.get()));
    move_callee(*copy, module);
    code.Insert(copy);
    copies[&i] = copy;
    if (llvm::Value* simpler = llvm::simplifyInstruction(copy, {layout, copy})) {
      copies[&i] = simpler;
      copy->eraseFromParent();
    }
  }
}

llvm::Value* Operations::at(llvm::IRBuilder<>& code, llvm::Value* address, std::uint64_t offset) {
  return offset == 0 ? address : code.CreateConstInBoundsGEP1_64(code.getInt8Ty(), address, offset);
}

llvm::Value* Operations::component(llvm::IRBuilder<>& code, Object& object, std::uint64_t offset,
                                   llvm::Type* type) {
  for (const Component& component : object.components)
    if (component.offset == offset) {
      if (!component.value->getType()->canLosslesslyBitCastTo(type))
        throw std::runtime_error("an operation that takes its operand apart");
      return code.CreateBitCast(component.value, type);
    }
  if (!object.address) throw std::runtime_error("a value that is used before it has one");
  llvm::Value* value = code.CreateAlignedLoad(type, at(code, object.address, offset),
                                              alignment_of(type, packs_.getDataLayout()));
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

void Operations::write(llvm::IRBuilder<>& code, Object& interval, llvm::Value* address) {
  for (const Part& part : layout_) (void)component(code, interval, part.offset, part.type);
  write_components(code, interval, address);
}

void Operations::write_components(llvm::IRBuilder<>& code, const Object& object,
                                  llvm::Value* address) {
  for (const Component& component : object.components)
    code.CreateAlignedStore(component.value, at(code, address, component.offset),
                            alignment_of(component.value->getType(), packs_.getDataLayout()));
}

}  // namespace regulus::detail::builder
