// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes are an object that is mapped, or a LoadError. What is mapped is not run.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "regulus/codegen/jit/object_loader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace regulus::codegen;
  const ExternalSymbol externals[] = {{"memcpy", reinterpret_cast<const void*>(&std::memcpy)}};
  try {
    static_cast<void>(load_object(std::as_bytes(std::span(data, size)), externals));
  } catch (const LoadError&) {
  }
  return 0;
}
