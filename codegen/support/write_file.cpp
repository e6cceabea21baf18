// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/write_file.hpp"

#include <system_error>

#include "codegen/support/errors.hpp"
#include "runtime/files/atomic_file.hpp"

namespace regulus::detail {

void write_file(const std::string& path, const std::string& text) try {
  AtomicFile file(path);
  file.write(text);
  file.put_in_place_durably();
} catch (const std::system_error& error) {
  throw FileError(path + " cannot " + error.what());
}

}  // namespace regulus::detail
