// SPDX-License-Identifier: GPL-3.0-or-later
// A user's own regularity test, from a shared object.
#pragma once

#include <memory>
#include <string>

#include "runtime/problem/filter.hpp"

namespace regulus::inline engine {

/// A filter that has been loaded; it stays so until this is destroyed.
class FilterFile {
 public:
  /// Runs what the file runs when it is loaded. Throws FileError when it is no file on a disk or is
  /// too large, InputError when it is no whole shared object for this processor, has no
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

}  // namespace regulus::inline engine
