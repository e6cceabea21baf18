// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace regulus::detail {

/// Complete files that wait under temporary names for the end of a run. A run that is killed leaves
/// none of them, and none of an end that a later search would have moved.
class HeldFiles {
 public:
  using Step = std::function<void()>;

  /// `put_in_place` owns the file. It replaces an earlier one of the same name, which is removed.
  void hold(const std::string& path, Step put_in_place) { files_[path] = std::move(put_in_place); }

  /// Takes a file of a part of the run; nothing if it has none of this name.
  void take(HeldFiles& part, const std::string& path) {
    if (auto file = part.files_.extract(path)) files_[path] = std::move(file.mapped());
  }

  /// Throws    what the first step that fails throws, after the others.
  void put_in_place() {
    std::exception_ptr failure;
    for (const auto& [path, step] : files_) {
      try {
        step();
      } catch (...) {
        if (!failure) failure = std::current_exception();
      }
    }
    files_.clear();
    if (failure) std::rethrow_exception(failure);
  }

 private:
  std::map<std::string, Step> files_;
};

/// Holds a file, or puts it in place at once if there is no run to wait for.
inline void hold_or_put(HeldFiles* held, const std::string& path, HeldFiles::Step put_in_place) {
  if (held != nullptr)
    held->hold(path, std::move(put_in_place));
  else
    put_in_place();
}

}  // namespace regulus::detail
