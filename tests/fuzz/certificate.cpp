// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes are verified, rejected or too much work. The work is limited to little, because this
// tests the reading and not the proving.
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "runtime/verifier/verify.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream file(std::string(reinterpret_cast<const char*>(data), size));
  regulus::verifier::Options little;
  little.max_boxes = 64;
  little.max_boxes_per_leaf = 16;
  little.max_bits = 128;
  static_cast<void>(regulus::verifier::verify(file, little));
  return 0;
}
