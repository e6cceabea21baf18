// SPDX-License-Identifier: GPL-3.0-or-later
// A user's own regularity test, from a shared object.
#pragma once

#include <memory>
#include <string>

#include "runtime/problem/filter.hpp"

namespace regulus::detail {

/// A loaded filter; the destructor unloads it.
class FilterFile {
 public:
  /// Loads the file, which runs its initialisers. Throws FileError if it is not a file on a disk or
  /// is too large, InputError if it is not a complete shared object for this processor, has no
  /// `regulus_filter`, or one of another ABI.
  explicit FilterFile(const std::string& path);

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] std::string name() const { return filter_->name; }
  [[nodiscard]] const std::string& sha256() const noexcept { return sha256_; }
  [[nodiscard]] const regulus_filter_interface& interface() const noexcept { return *filter_; }

 private:
  struct Close {
    void operator()(void* library) const noexcept;
  };

  std::string path_;
  std::string sha256_;
  std::unique_ptr<void, Close> library_;
  const regulus_filter_interface* filter_ = nullptr;
};

}  // namespace regulus::detail
