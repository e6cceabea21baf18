// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes, read to the end, are the text of a warm start or are refused.
#include "codegen/question/engine/warm_start.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace regulus;
  using namespace regulus::detail;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto problem = read_warm_start(text);
  if (!problem) return 0;
  if (to_text(*problem) != text) std::abort();
  static_cast<void>(fits(*problem, regulus::detail::machine::PackKernel{}, {}));
  return 0;
}
