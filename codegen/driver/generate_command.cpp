// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/commands.hpp"

namespace regulus::codegen {

int run_generate(const GenerateCommand& command, const std::string& typed) {
  generate_files(command, read_request(command.model), typed);
  return 0;
}

}  // namespace regulus::codegen
