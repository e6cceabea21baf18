// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/support/scratch_folder.hpp"

#include <stdlib.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "codegen/support/errors.hpp"

namespace regulus::inline support {

ScratchFolder::ScratchFolder() {
  std::error_code error;
  std::string name = (std::filesystem::temp_directory_path(error) / "regulus-XXXXXX").string();
  if (error || ::mkdtemp(name.data()) == nullptr)
    throw FileError("cannot make a folder for temporary files: " +
                    std::generic_category().message(errno));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace regulus::support
