// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/installed_models.hpp"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/executable_folder.hpp"

namespace regulus::detail {

namespace fs = std::filesystem;

fs::path model_folder() {
  if (const char* named = std::getenv("REGULUS_MODELS"); named != nullptr && *named != '\0')
    return named;
  std::error_code error;
  const fs::path beside = folder_of_executable() / "../share/regulus/models";
  const fs::path folder = fs::weakly_canonical(beside, error);
  return error ? beside : folder;
}

std::vector<InstalledModel> installed_models() {
  std::vector<InstalledModel> models;
  std::error_code error;
  fs::directory_iterator file(model_folder(), error);
  for (const fs::directory_iterator end; !error && file != end; file.increment(error))
    if (file->path().extension() == ".toml" && is_name(file->path().stem().string()))
      models.push_back({file->path().stem().string(), file->path()});
  std::ranges::sort(models, {}, &InstalledModel::name);
  return models;
}

std::string find_model(const std::string& typed) {
  std::error_code error;
  if (!is_name(typed) || fs::exists(fs::status(typed, error))) return typed;
  std::vector<std::string> names;
  for (const InstalledModel& model : installed_models()) {
    if (model.name == typed) return model.path.string();
    names.push_back(model.name);
  }
  throw FileError("there is no file " + in_quotes(typed) +
                  ", and no installed model of that name; " +
                  suggestion(typed, names, "regulus list names the installed models"));
}

}  // namespace regulus::detail
