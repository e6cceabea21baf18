// SPDX-License-Identifier: GPL-3.0-or-later
// A certificate and, behind a line "====", a model file: any bytes are compared, refused or too much work.
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "runtime/verifier/verify.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size), between = "\n====\n";
  const std::size_t at = text.find(between);
  if (at == std::string::npos) return 0;
  std::istringstream certificate(text.substr(0, at + 1));
  regulus::verifier::Options little;
  little.max_boxes = 64;
  little.max_boxes_per_leaf = 16;
  little.max_bits = 128;
  little.model_text = text.substr(at + between.size());
  little.model_name = "fuzzed.toml";
  static_cast<void>(regulus::verifier::verify(certificate, little));
  return 0;
}
