// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace regulus::detail {

/// The machine code of parts that this process has compiled or read, by name, for kernels that
/// differ only a little from earlier ones. Any number of threads may use one.
class PartStore {
 public:
  [[nodiscard]] std::optional<std::string> find(const std::string& name) const;

  /// Removes all earlier parts first if the store has become large.
  void add(const std::string& name, const std::string& code);

 private:
  mutable std::mutex mutex_;
  std::size_t size_ = 0;  ///< bytes
  std::map<std::string, std::string> code_of_;
};

}  // namespace regulus::detail
