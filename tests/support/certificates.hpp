// SPDX-License-Identifier: GPL-3.0-or-later
// Makes certificates as the command makes them, and examines their text.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "codegen/answer/certificate/certificate_file.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "runtime/verifier/verify.hpp"
#include "tests/support/certificate_texts.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {

struct Certified {
  Result result;
  std::string text;  ///< empty if the verdict claims nothing
};

inline Certified certify(PreparedSearch& preparation, const SearchOptions& search,
                         Settings settings) {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "certificate").string();
  CertificateFile file(path, preparation);
  Certified certified;
  certified.result = run_search(preparation, search, std::move(settings), file.observer());
  file.finish(certified.result);
  if (file.status().is_written()) certified.text = file_contents(path);
  return certified;
}

inline Certified certify(const ModelOptions& model, const SearchOptions& search = {}) {
  PreparedSearch preparation = prepare(model, search);
  return certify(preparation, search, settings_from(search));
}

/// `tolerance`: of base and platform; "" for exact geometry.
inline ModelOptions robot(const std::string& name, const std::string& motion,
                          const std::string& tolerance = "") {
  ModelOptions model;
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

}  // namespace regulus::detail::test
