// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes are a robot, an InputError or a UsageError.
#include "codegen/model/import/import.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "codegen/support/errors.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    static_cast<void>(regulus::import_robot(text, "fuzzed", {}));
  } catch (const regulus::InputError&) {
  } catch (const regulus::UsageError&) {
  }
  return 0;
}
