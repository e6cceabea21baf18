// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/import_output.hpp"

#include <filesystem>
#include <optional>

#include "codegen/kernel/cpp/write_files.hpp"
#include "codegen/model/file/read_file.hpp"
#include "codegen/model/import/import.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/write_file.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kSeal = "# SHA-256 of the lines above: ";

std::string sealed(const std::string& model) { return model + kSeal + sha256(model) + '\n'; }

bool is_as_written(const std::string& text) {
  const std::size_t seal = text.rfind(kSeal);
  return seal != std::string::npos && text == sealed(text.substr(0, seal));
}

void require_own(const std::string& path, const char* remedy) {
  if (!std::filesystem::is_regular_file(path)) return;
  // A longer file is none that import wrote.
  const std::string text = read_start(path, 4 * kLargestImport, Readable::kFile);
  if (!is_as_written(text))
    throw FileError("-o: " + path + " was not written by regulus import, or was edited since; " +
                    remedy);
}

}  // namespace

void write_imported(const std::string& path, const std::string& model) {
  require_own(path, "move it, or name another file");
  if (std::filesystem::is_regular_file(path))
    require_own(path + ".old", "the earlier model would replace it: move it");
  set_earlier_outputs_aside({}, {{"-o", path}});
  write_file(path, sealed(model));
}

}  // namespace regulus::detail
