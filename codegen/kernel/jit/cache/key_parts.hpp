// SPDX-License-Identifier: GPL-3.0-or-later
// The input of the hash that is the key of a cache entry.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/files/sha256.hpp"

namespace regulus::detail {

/// Concatenates parts, each preceded by its length, so that different lists of parts give different
/// bytes.
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

  /// Returns 64 hexadecimal digits.
  [[nodiscard]] std::string key() const { return sha256(bytes_); }

 private:
  std::string bytes_;
};

}  // namespace regulus::detail
