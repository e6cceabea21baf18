// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/shell/text_editor.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "codegen/support/errors.hpp"
#include "codegen/support/scratch_folder.hpp"
#include "codegen/support/subprocess.hpp"
#include "codegen/support/write_file.hpp"

namespace regulus::detail {
namespace {

/// A file only for its owner, with the extension that editors know for model files.
class DraftFile {
 public:
  explicit DraftFile(const std::string& text) { write_file(path_, text); }

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] std::string text() const {
    std::ifstream stream(path_, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) throw FileError("cannot read " + path_);
    return text;
  }

 private:
  const ScratchFolder folder_;
  const std::string path_ = folder_.path() / "model.toml";
};

std::string editor() {
  for (const char* variable : {"VISUAL", "EDITOR"})
    if (const char* named = std::getenv(variable); named && *named) return named;
  return "vi";
}

/// The variables may contain options, so a shell splits them.
int run_editor(const std::string& path) {
  return Subprocess({"/bin/sh", "-c", editor() + " \"$1\"", "sh", path}).wait();
}

}  // namespace

std::string edited(const std::string& text) {
  const DraftFile draft(text);
  if (run_editor(draft.path()) != 0)
    throw FileError(
        "the editor failed, so the model is unchanged; set EDITOR to use another editor");
  return draft.text();
}

}  // namespace regulus::detail
