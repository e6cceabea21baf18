// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates made as the command makes them, and looked at as texts.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "regulus/certificate/verifier/verify.hpp"
#include "regulus/codegen/driver/certificate_file.hpp"
#include "regulus/codegen/driver/certificate_question.hpp"
#include "regulus/codegen/driver/search_run.hpp"
#include "regulus/codegen/driver/settings.hpp"
#include "support/certificate_texts.hpp"
#include "support/temporary_directory.hpp"

namespace regulus::test {

struct Certified {
  Result result;
  std::string text;  ///< empty where the verdict claims nothing
};

inline std::string contents(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

inline Certified certify(codegen::Preparation& preparation, const codegen::SearchOptions& search,
                         Settings settings) {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "certificate").string();
  codegen::CertificateFile file(path, preparation);
  codegen::OutputOptions quiet;
  quiet.quiet = true;
  Certified certified;
  certified.result =
      codegen::run_search(preparation, search, quiet, std::move(settings), file.observer());
  file.finish(certified.result);
  if (file.written()) certified.text = contents(path);
  return certified;
}

inline Certified certify(const codegen::ModelOptions& model,
                         const codegen::SearchOptions& search = {}) {
  codegen::Preparation preparation = codegen::prepare(model, search);
  return certify(preparation, search, codegen::settings_from(search));
}

/// `tolerance`: of base and platform; "" for exact geometry.
inline codegen::ModelOptions robot(const std::string& name, const std::string& motion,
                                   const std::string& tolerance = "") {
  codegen::ModelOptions model;
  model.path = REGULUS_SOURCE_DIR "/models/" + name + ".toml";
  model.motion = motion;
  if (!tolerance.empty()) model.tolerances = {"base,platform=" + tolerance};
  return model;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

}  // namespace regulus::test
