// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/builder/kernel_builder.hpp"

#include <string>

#include "regulus/codegen/jit/builder/function_builder.hpp"
#include "regulus/codegen/jit/reader/token.hpp"
#include "regulus/kernel/abi.hpp"

namespace regulus::codegen::builder {
namespace {

using reader::FunctionText;
using reader::Initialiser;
using reader::KernelText;
using reader::OutsideSubset;
using reader::TableText;

class KernelBuilder {
 public:
  KernelBuilder(const reader::Symbols& symbols, const reader::Share& share, llvm::Module& module)
      : symbols_(symbols), share_(share), module_(module), operations_(module) {
    for (llvm::Function& function : module)
      if (!function.empty()) function.setLinkage(llvm::GlobalValue::InternalLinkage);
  }

  void run(const KernelText& text) {
    for (const FunctionText& function : text.functions) {
      llvm::Function& made = declare(function);
      if (is_here(function.name) && made.empty())
        FunctionBuilder(operations_, functions_, made, function).run();
    }
    if (share_.tables)
      for (const TableText& table : text.tables) add(table);
    for (const char* type : {"kernel", "expansion", "derivative"})
      module_.getNamedGlobal(type_name(type))->eraseFromParent();
    module_.getNamedGlobal("regulus_rounding")->eraseFromParent();
  }

 private:
  static std::string type_name(llvm::StringRef type) { return "regulus_" + type.str() + "_type"; }

  [[nodiscard]] bool is_here(std::string_view function) const {
    return share_.functions.contains(function);
  }

  /// Internal when no other object may want it.
  [[nodiscard]] llvm::GlobalValue::LinkageTypes linkage_of(const FunctionText& text) const {
    return share_.tables && is_here(text.name) && !text.exported
               ? llvm::GlobalValue::InternalLinkage
               : llvm::GlobalValue::ExternalLinkage;
  }

  /// With the target and the floating-point rules that the operations were compiled for. Functions
  /// that compute the same are one.
  llvm::Function& declare(const FunctionText& text) {
    const std::string& symbol = symbols_.at(text.name);
    llvm::Function* function = module_.getFunction(symbol);
    if (!function) function = &declare(symbol, text);
    if (is_here(text.name)) function->setDSOLocal(true);
    functions_[text.name] = function;
    return *function;
  }

  llvm::Function& declare(const std::string& symbol, const FunctionText& text) {
    llvm::LLVMContext& context = module_.getContext();
    llvm::Type* pointer = llvm::PointerType::getUnqual(context);
    llvm::SmallVector<llvm::Type*, 4> parameters(text.parameters.size(), pointer);
    auto* type = llvm::FunctionType::get(llvm::Type::getInt32Ty(context), parameters, false);
    auto* function = llvm::Function::Create(type, linkage_of(text), symbol, module_);
    llvm::AttrBuilder attributes(context, operations_.sample().getAttributes().getFnAttrs());
    attributes.removeAttribute(llvm::Attribute::Memory);
    attributes.removeAttribute(llvm::Attribute::AlwaysInline);
    attributes.addAttribute(llvm::Attribute::NoInline);
    function->addFnAttrs(attributes);
    return *function;
  }

  void add(const TableText& table) {
    llvm::Type* element = type_of(table.type);
    llvm::Constant* value =
        table.array ? array_of(table.value, element) : constant(table.value, element);
    const std::string name(table.name);
    auto* global = new llvm::GlobalVariable(
        module_, value->getType(), true,
        table.exported ? llvm::GlobalValue::ExternalLinkage : llvm::GlobalValue::InternalLinkage,
        value, table.exported ? name : "kernel." + name);
    global->setDSOLocal(true);
    if (!tables_.try_emplace(table.name, global).second)
      throw OutsideSubset("two tables of one name");
  }

  llvm::Type* type_of(std::string_view name) {
    if (name == "int") return llvm::Type::getInt32Ty(module_.getContext());
    if (name == "double") return llvm::Type::getDoubleTy(module_.getContext());
    if (const auto* known = module_.getNamedGlobal(std::string(name) + "_type"))
      return known->getValueType();
    throw OutsideSubset("a table of a type that no kernel has: " + std::string(name));
  }

  llvm::Constant* array_of(const Initialiser& value, llvm::Type* element) {
    if (value.kind != Initialiser::Kind::kList) throw OutsideSubset("an array without elements");
    llvm::SmallVector<llvm::Constant*, 64> elements;
    for (const Initialiser& entry : value.list) elements.push_back(constant(entry, element));
    return llvm::ConstantArray::get(llvm::ArrayType::get(element, elements.size()), elements);
  }

  /// A value of exactly that type: C++ would convert, and kernels need no conversion.
  llvm::Constant* constant(const Initialiser& value, llvm::Type* type) {
    using Kind = Initialiser::Kind;
    if (auto* structure = llvm::dyn_cast<llvm::StructType>(type);
        structure && value.kind == Kind::kList &&
        value.list.size() <= structure->getNumElements()) {
      llvm::SmallVector<llvm::Constant*, 32> fields;
      for (unsigned i = 0; i < structure->getNumElements(); ++i)
        fields.push_back(i < value.list.size()
                             ? constant(value.list[i], structure->getElementType(i))
                             : llvm::Constant::getNullValue(structure->getElementType(i)));
      return llvm::ConstantStruct::get(structure, fields);
    }
    if (type->isDoubleTy() && value.kind == Kind::kDouble)
      return llvm::ConstantFP::get(type, value.number);
    if (type->isIntegerTy(32) && (value.kind == Kind::kInteger || value.kind == Kind::kName))
      return llvm::ConstantInt::getSigned(type, integer(value));
    if (type->isPointerTy()) return address(value, type);
    throw OutsideSubset("a table with another value than its type says");
  }

  std::int64_t integer(const Initialiser& value) {
    if (value.kind == Initialiser::Kind::kInteger) return value.integer;
    if (value.text == "REGULUS_KERNEL_ABI") return REGULUS_KERNEL_ABI;
    if (value.text == "REGULUS_FIRST_ORDER") return REGULUS_FIRST_ORDER;
    if (value.text != "kRounding") throw OutsideSubset("a number of an unknown name");
    const llvm::Constant* rounding = module_.getNamedGlobal("regulus_rounding")->getInitializer();
    return llvm::cast<llvm::ConstantInt>(rounding)->getSExtValue();
  }

  llvm::Constant* address(const Initialiser& value, llvm::Type* type) {
    if (value.kind == Initialiser::Kind::kString) {
      llvm::Constant* text = llvm::ConstantDataArray::getString(
          module_.getContext(), llvm::StringRef(value.text.data(), value.text.size()));
      auto* global = new llvm::GlobalVariable(module_, text->getType(), true,
                                              llvm::GlobalValue::PrivateLinkage, text);
      global->setUnnamedAddr(llvm::GlobalValue::UnnamedAddr::Global);
      return global;
    }
    if (value.kind == Initialiser::Kind::kName) {
      if (value.text == "nullptr")
        return llvm::ConstantPointerNull::get(llvm::cast<llvm::PointerType>(type));
      if (const auto found = functions_.find(value.text); found != functions_.end())
        return found->second;
      if (const auto found = tables_.find(value.text); found != tables_.end()) return found->second;
    }
    throw OutsideSubset("a table that points to nothing known");
  }

  const reader::Symbols& symbols_;
  const reader::Share& share_;
  llvm::Module& module_;
  Operations operations_;
  FunctionTable functions_;
  llvm::StringMap<llvm::GlobalVariable*> tables_;
};

}  // namespace

void build_kernel(const KernelText& text, const reader::Symbols& symbols,
                  const reader::Share& share, llvm::Module& module) {
  KernelBuilder(symbols, share, module).run(text);
}

}  // namespace regulus::codegen::builder
