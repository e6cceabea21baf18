// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "codegen/command/commands.hpp"
#include "codegen/cpp/write_files.hpp"
#include "codegen/import/import.hpp"
#include "codegen/model/read_file.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::inline command {

int run_import(const ImportCommand& command) {
  const std::string text = read_file(command.path, kLargestImport, Readable::kStream);
  const Imported imported = import_robot(text, command.path, command.options);
  if (!command.quiet) std::cerr << imported.report;
  if (command.output.empty())
    std::cout << imported.model << std::flush;
  else
    write_file(command.output, imported.model);
  return 0;
}

}  // namespace regulus::command
