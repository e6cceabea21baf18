// SPDX-License-Identifier: GPL-3.0-or-later
// The models that are installed with the program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace regulus::detail {

struct InstalledModel {
  std::string name;  ///< of the file, without its ending
  std::filesystem::path path;
};

/// Returns the folder of the installed models: REGULUS_MODELS if it is set, otherwise
/// share/regulus/models beside the folder of the program. A build folder has the same.
[[nodiscard]] std::filesystem::path model_folder();

/// Returns the models of that folder in the order of their names; none if there is no folder.
[[nodiscard]] std::vector<InstalledModel> installed_models();

/// Returns the file that `typed` means: the file of that path if there is one, otherwise the
/// installed model of that name. Anything but a name is returned as it is. Throws FileError for a
/// name that means neither.
[[nodiscard]] std::string find_model(const std::string& typed);

}  // namespace regulus::detail
