// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/commands.hpp"

namespace regulus::detail {

int run_generate(const GenerateCommand& command, const std::string& typed) {
  generate_files(command, read_request(command.model), typed);
  return 0;
}

}  // namespace regulus::detail
