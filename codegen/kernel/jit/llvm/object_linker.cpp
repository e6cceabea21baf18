// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/jit/llvm/object_linker.hpp"

#include <llvm/ADT/STLExtras.h>
#include <llvm/BinaryFormat/ELF.h>
#include <llvm/BinaryFormat/Magic.h>
#include <llvm/ExecutionEngine/JITLink/JITLink.h>
#include <llvm/Object/ELFObjectFile.h>
#include <llvm/Support/MemoryBuffer.h>
#if __has_include(<llvm/ExecutionEngine/Orc/AbsoluteSymbols.h>)
#include <llvm/ExecutionEngine/Orc/AbsoluteSymbols.h>
#endif
#if __has_include(<llvm/ExecutionEngine/Orc/SelfExecutorProcessControl.h>)
#include <llvm/ExecutionEngine/Orc/SelfExecutorProcessControl.h>
#else
#include <llvm/ExecutionEngine/Orc/ExecutorProcessControl.h>
#endif

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace regulus::detail::plugin {
namespace {

using namespace llvm::orc;
using llvm::jitlink::LinkGraph;

template <class T>
T value_of(llvm::Expected<T> expected) {
  if (!expected) throw std::runtime_error(llvm::toString(expected.takeError()));
  return std::move(*expected);
}

/// Seals constants with addresses, which are writable for the linker alone.
class Constants : public ObjectLinkingLayer::Plugin {
 public:
  void modifyPassConfig(MaterializationResponsibility&, LinkGraph&,
                        llvm::jitlink::PassConfiguration& passes) override {
    passes.PrePrunePasses.emplace_back([](LinkGraph& graph) {
      for (auto& section : graph.sections())
        if (section.getName().starts_with(".data.rel.ro")) section.setMemProt(MemProt::Read);
      return llvm::Error::success();
    });
  }
  llvm::Error notifyFailed(MaterializationResponsibility&) override {
    return llvm::Error::success();
  }
  llvm::Error notifyRemovingResources(JITDylib&, ResourceKey) override {
    return llvm::Error::success();
  }
  void notifyTransferringResources(JITDylib&, ResourceKey, ResourceKey) override {}
};

bool runs_by_itself(const llvm::object::ELFSectionRef& section) {
  const llvm::StringRef name = value_of(section.getName());
  const unsigned type = section.getType();
  return type == llvm::ELF::SHT_INIT_ARRAY || type == llvm::ELF::SHT_FINI_ARRAY ||
         type == llvm::ELF::SHT_PREINIT_ARRAY || name.starts_with(".ctors") ||
         name.starts_with(".dtors") || name.starts_with(".init") || name.starts_with(".fini");
}

/// Refuses an object with more than code and data, and one that calls anything else.
llvm::StringMap<std::uint64_t> symbols_of(llvm::StringRef object,
                                          llvm::ArrayRef<regulus_external> externals) {
  if (llvm::identify_magic(object) != llvm::file_magic::elf_relocatable)
    throw std::runtime_error("object: not relocatable ELF");
  const auto file = value_of(llvm::object::ELF64LEObjectFile::create({object, "text"}));
  for (const llvm::object::ELFSectionRef section : file.sections())
    if (runs_by_itself(section))
      throw std::runtime_error("object: section '" + value_of(section.getName()).str() +
                               "' would have to run when loaded");
  llvm::StringMap<std::uint64_t> sizes;
  for (const llvm::object::ELFSymbolRef symbol : file.symbols()) {
    const std::string name = value_of(symbol.getName()).str();
    const std::uint32_t flags = value_of(symbol.getFlags());
    const bool is_external = llvm::any_of(
        externals, [&name](const regulus_external& external) { return name == external.name; });
    if ((flags & llvm::object::SymbolRef::SF_Undefined) != 0) {
      if (!name.empty() && !is_external)
        throw std::runtime_error("object: symbol '" + name + "' is not defined");
    } else if ((flags & llvm::object::SymbolRef::SF_Global) != 0) {
      sizes[name] = symbol.getSize();
    }
  }
  return sizes;
}

}  // namespace

LinkedObject::End::~End() { llvm::consumeError(session.endSession()); }

LinkedObject::LinkedObject(llvm::StringRef object, llvm::ArrayRef<regulus_external> externals)
    : session_(value_of(SelfExecutorProcessControl::Create())),
      layer_(session_),
      code_(session_.createBareJITDylib("text")) {
  session_.setErrorReporter(
      [this](llvm::Error error) { errors_ += "; " + llvm::toString(std::move(error)); });
  layer_.addPlugin(std::make_unique<Constants>());
  for (const auto& [name, size] : symbols_of(object, externals)) symbols_[name].size = size;
  define(externals);
  link(object);
}

void LinkedObject::define(llvm::ArrayRef<regulus_external> externals) {
  SymbolMap addresses;
  for (const regulus_external& external : externals)
    addresses[session_.intern(external.name)] = {ExecutorAddr::fromPtr(external.address),
                                                 llvm::JITSymbolFlags::Exported};
  llvm::cantFail(code_.define(absoluteSymbols(std::move(addresses))));
}

void LinkedObject::link(llvm::StringRef object) {
  const auto succeed = [this](llvm::Error error) {
    if (error) throw std::runtime_error("object: " + llvm::toString(std::move(error)) + errors_);
  };
  succeed(layer_.add(code_, llvm::MemoryBuffer::getMemBufferCopy(object, "text")));
  for (auto& symbol : symbols_) {
    auto found = session_.lookup({&code_}, symbol.getKey());
    succeed(found.takeError());
    symbol.second.address = found->getAddress().toPtr<void*>();
  }
}

void* LinkedObject::find(llvm::StringRef name, std::uint64_t size) const {
  const auto found = symbols_.find(name);
  return found != symbols_.end() && found->second.size >= size ? found->second.address : nullptr;
}

}  // namespace regulus::detail::plugin
