// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes are a model or an InputError.
#include "codegen/model/file/model_file.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "codegen/support/errors.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    static_cast<void>(regulus::detail::parse_model(text, "fuzzed"));
  } catch (const regulus::InputError&) {
  }
  return 0;
}
