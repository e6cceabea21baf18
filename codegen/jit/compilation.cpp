// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/jit/compilation.hpp"

#include "regulus/codegen/model/sha256.hpp"
#include "regulus/kernel/abi.hpp"

namespace regulus::codegen {
namespace {

/// To be raised when the loader begins to need something of its objects that older ones lack.
constexpr int kLoaderVersion = 1;

class Parts {
 public:
  void add(std::string_view part) {
    bytes_.append(std::to_string(part.size())).append(":").append(part);
  }
  void add(const NamedText& file) {
    add(file.name);
    add(file.text);
  }
  void begin_list(std::size_t size) { add(std::to_string(size)); }
  [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace

std::string object_key(const Compilation& compilation, std::string_view compiler) {
  Parts parts;
  parts.add(std::to_string(kLoaderVersion));
  parts.add(std::to_string(static_cast<int>(REGULUS_KERNEL_ABI)));
  parts.add(compiler);
  parts.add(compilation.isa);
  parts.add(compilation.passes);
  parts.begin_list(compilation.flags.size());
  for (const std::string& flag : compilation.flags) parts.add(flag);
  parts.begin_list(compilation.headers.size());
  for (const NamedText& header : compilation.headers) parts.add(header);
  parts.add(compilation.source);
  return sha256(parts.bytes());
}

}  // namespace regulus::codegen
