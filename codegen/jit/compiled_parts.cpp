// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/compiled_parts.hpp"

#include <elf.h>

#include <algorithm>
#include <set>
#include <span>

#include "regulus/codegen/jit/elf_object.hpp"
#include "regulus/codegen/jit/object_bundle.hpp"

namespace regulus::codegen {
namespace {

/// Objects are kept whole: after many edits most of what is in them is of no use.
constexpr std::size_t kMostBytes = std::size_t{64} << 20;
constexpr std::string_view kPrefix = "kernel.";

/// The functions of kernels that an object defines for others, and those that it takes from them.
struct Functions {
  std::vector<std::string_view> defined, wanted;
};

Functions functions_of(std::string_view object) {
  Functions functions;
  for (const ElfSymbol& symbol : read_elf_object(std::as_bytes(std::span(object))).symbols) {
    if (symbol.binding == STB_LOCAL || !symbol.name.starts_with(kPrefix)) continue;
    (symbol.section == SHN_UNDEF ? functions.wanted : functions.defined).push_back(symbol.name);
  }
  return functions;
}

}  // namespace

void CompiledParts::prepare(const std::string& how) {
  if (how == how_ && size_ < kMostBytes) return;
  how_ = how;
  size_ = 0;
  object_of_.clear();
}

std::vector<std::string_view> CompiledParts::symbols() const {
  std::vector<std::string_view> result;
  for (const auto& [symbol, object] : object_of_) result.emplace_back(symbol);
  return result;
}

std::string CompiledParts::complete(std::string_view fresh, Count& count) {
  const std::vector<std::string_view> objects = objects_in(fresh);
  std::set<std::string_view> wanted;
  for (const std::string_view object : objects)
    for (const std::string_view function : functions_of(object).wanted) wanted.insert(function);
  std::vector<Object> needed;
  count = {};
  for (const std::string_view function : wanted) {
    const auto known = object_of_.find(function);
    if (known == object_of_.end()) continue;
    if (std::ranges::find(needed, known->second) == needed.end()) needed.push_back(known->second);
    ++count.known;
  }
  count.compiled = wanted.size() - count.known;
  std::string bundle;
  for (const Object& object : needed) add_to_bundle(bundle, *object);
  for (const std::string_view object : objects) add_to_bundle(bundle, object);
  add(fresh);
  return bundle;
}

/// What an object wants is not certain to be there for the next kernel.
void CompiledParts::add(std::string_view bundle) {
  for (const std::string_view object : objects_in(bundle))
    if (functions_of(object).wanted.empty()) add_object(object);
}

void CompiledParts::add_object(std::string_view object) {
  const auto kept = std::make_shared<const std::string>(object);
  bool is_new = false;
  for (const std::string_view function : functions_of(object).defined)
    is_new = object_of_.try_emplace(std::string(function), kept).second || is_new;
  if (is_new) size_ += kept->size();
}

}  // namespace regulus::codegen
