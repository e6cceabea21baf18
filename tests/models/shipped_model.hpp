// SPDX-License-Identifier: GPL-3.0-or-later
// A model of models/: its matrix in numbers, and the answers of the command.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "codegen/model/file/model_file.hpp"
#include "tests/support/command.hpp"
#include "tests/support/evaluate.hpp"

namespace regulus::detail::test {

using Point = test::Point;
using Row = std::vector<double>;
using Rows = std::vector<Row>;

class ShippedModel {
 public:
  explicit ShippedModel(const std::string& name)
      : path_(REGULUS_SOURCE_DIR "/models/" + name + ".toml"), model_(load_model(path_)) {}

  /// Returns J⁻¹ at a pose, with row scales and with the nominal geometry.
  [[nodiscard]] Rows matrix(Point pose) const {
    for (const GeometryParameter& g : model_.geometry) pose[g.name] = test::evaluate(g.value, {});
    Rows rows;
    for (unsigned i = 0; i < model_.matrix.rows(); ++i) {
      const double scale = model_.row_scale.empty() ? 1 : test::evaluate(model_.row_scale[i], pose);
      rows.emplace_back();
      for (unsigned j = 0; j < model_.matrix.cols(); ++j)
        rows.back().push_back(scale * test::evaluate(model_.matrix(i, j), pose));
    }
    return rows;
  }

  /// Returns the report of `regulus COMMAND MODEL WORDS… --json`.
  [[nodiscard]] nlohmann::json report(const std::string& command,
                                      std::vector<std::string> words) const {
    words.insert(words.begin(), {REGULUS_BINARY_DIR "/bin/regulus", command, path_, "--json"});
    return nlohmann::json::parse(run_command(words).output);
  }
  [[nodiscard]] nlohmann::json check(std::vector<std::string> words) const {
    return report("check", std::move(words));
  }
  [[nodiscard]] std::string verdict(std::vector<std::string> words) const {
    return check(std::move(words))["verdict"];
  }

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] const Model& model() const noexcept { return model_; }

 private:
  std::string path_;
  Model model_;
};

/// Returns the pose of a report's witness, by parameter.
inline Point witness_of(const nlohmann::json& report) {
  Point pose;
  for (const auto& [name, range] : report["witness"]["near"]["pose"].items())
    pose[name] = range[0].get<double>();
  return pose;
}

}  // namespace regulus::detail::test
