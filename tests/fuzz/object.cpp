// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes are an object that is mapped, or the flat code of a part, or a LoadError. Mapped code
// is not run.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "codegen/jit/loader/object_loader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace regulus;
  const ExternalSymbol externals[] = {{"memcpy", reinterpret_cast<const void*>(&std::memcpy)}};
  const auto bytes = std::as_bytes(std::span(data, size));
  try {
    static_cast<void>(load_object(bytes, externals));
  } catch (const LoadError&) {
  }
  try {
    static_cast<void>(flat_code(bytes, "start", 64));
  } catch (const LoadError&) {
  }
  return 0;
}
