// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace regulus::codegen {

/// The functions of kernels that this process has compiled, for kernels that differ a little from
/// them. Not for two threads at a time.
class CompiledParts {
 public:
  /// How many functions a kernel took.
  struct Count {
    std::size_t compiled = 0, known = 0;
  };

  /// Forgets what was compiled otherwise than `how`, or anything when it has become much.
  void prepare(const std::string& how);

  /// The symbols of the functions, see reader::symbols_of. Valid until the next call of another
  /// member.
  [[nodiscard]] std::vector<std::string_view> symbols() const;

  /// A kernel's objects, the last of which no other kernel can use: in front of them come the known
  /// ones that they need. The new ones are known from now on.
  ///
  /// Throws    LoadError for bytes that are no bundle of objects.
  [[nodiscard]] std::string complete(std::string_view fresh, Count& count);

  /// The objects of a kernel that was compiled before.
  void add(std::string_view bundle);

 private:
  using Object = std::shared_ptr<const std::string>;

  void add_object(std::string_view object);

  std::string how_;
  std::size_t size_ = 0;  ///< bytes
  std::map<std::string, Object, std::less<>> object_of_;
};

}  // namespace regulus::codegen
