// SPDX-License-Identifier: GPL-3.0-or-later
// What the key of a cache entry is the hash of.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "codegen/support/sha256.hpp"

namespace regulus::inline jit {

/// Parts one after the other, each preceded by its length, so that no two lists of parts read the
/// same.
class KeyParts {
 public:
  void add(std::string_view part) {
    bytes_.append(std::to_string(part.size())).append(":").append(part);
  }
  void add(long long number) { add(std::to_string(number)); }
  void begin_list(std::size_t size) { add(std::to_string(size)); }
  void add(const std::vector<std::string>& list) {
    begin_list(list.size());
    for (const std::string& part : list) add(part);
  }

  /// 64 hexadecimal digits.
  [[nodiscard]] std::string key() const { return sha256(bytes_); }

 private:
  std::string bytes_;
};

}  // namespace regulus::inline jit
