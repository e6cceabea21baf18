// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/object_bundle.hpp"

#include <cstdint>
#include <cstring>

namespace regulus::codegen {
namespace {

// Before each object: the mark, which no ELF file begins with, and the object's length. Objects
// stay aligned to 8 bytes, as the structures in them are.
constexpr std::string_view kMark = "Regulus+";
constexpr std::size_t kHead = kMark.size() + sizeof(std::uint64_t);
constexpr std::size_t kAlignment = 8;

std::size_t padded(std::size_t size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

void append(std::string& bundle, std::string_view object) {
  const std::uint64_t size = object.size();
  char bytes[sizeof size];
  std::memcpy(bytes, &size, sizeof size);
  bundle.append(kMark).append(bytes, sizeof bytes).append(object);
  bundle.append(padded(object.size()) - object.size(), '\0');
}

}  // namespace

void add_to_bundle(std::string& bundle, std::string_view object) {
  if (bundle.empty()) {
    bundle = object;
    return;
  }
  if (!bundle.starts_with(kMark)) {
    const std::string first = std::move(bundle);
    bundle.clear();
    append(bundle, first);
  }
  append(bundle, object);
}

std::vector<std::string_view> objects_in(std::string_view bundle) {
  const std::string_view whole = bundle;
  std::vector<std::string_view> objects;
  while (bundle.size() >= kHead && bundle.starts_with(kMark)) {
    std::uint64_t size = 0;
    std::memcpy(&size, bundle.data() + kMark.size(), sizeof size);
    bundle.remove_prefix(kHead);
    if (size > bundle.size() || padded(size) > bundle.size()) return {whole};
    objects.push_back(bundle.substr(0, size));
    bundle.remove_prefix(padded(size));
  }
  if (objects.empty() || !bundle.empty()) return {whole};
  return objects;
}

}  // namespace regulus::codegen
