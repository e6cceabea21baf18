// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/scratch_folder.hpp"

#include <system_error>

#include "codegen/support/errors.hpp"

namespace regulus::detail {

ScratchFolder::ScratchFolder() try {
  folder_.emplace(std::filesystem::temp_directory_path() / "regulus", 0700);
} catch (const std::system_error& error) {
  throw FileError("cannot make a folder for temporary files: " + error.code().message());
}

}  // namespace regulus::detail
