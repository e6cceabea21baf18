// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/forge/genuine.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>

#include "codegen/support/exit_code.hpp"
#include "codegen/use/command/run_command_line.hpp"
#include "tests/attack/forge/bundle.hpp"

namespace regulus::detail::attack {
namespace {

namespace fs = std::filesystem;

constexpr double kSecondsOfVerifier = 20;
/// So many that a busy machine changes no outcome.
constexpr int kSecondsOfCommand = 120;

/// The command prints nothing while this lives.
class Silence {
 public:
  Silence() : output_(std::cout.rdbuf(text_.rdbuf())), errors_(std::cerr.rdbuf(text_.rdbuf())) {}
  ~Silence() {
    std::cout.rdbuf(output_);
    std::cerr.rdbuf(errors_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  std::ostringstream text_;
  std::streambuf *output_, *errors_;
};

int run(const std::vector<std::string>& words) {
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  const Silence silence;
  return report_errors([&] {
    return run_command_line(
        parse_command_line(static_cast<int>(arguments.size()), arguments.data()), "");
  });
}

}  // namespace

std::string model_of(const Base& base) {
  const std::string text = base.model;
  if (text.find('\n') != std::string::npos) return text;
  return read(fs::path(REGULUS_SOURCE_DIR) / "models" / (text + ".toml"));
}

Answer answer_about(const Base& base, const std::string& model, const std::string& folder) {
  const fs::path proofs = fs::path(folder) / "proofs";
  fs::remove_all(proofs);
  fs::create_directories(proofs);
  write(fs::path(folder) / "model.toml", model);
  if (*base.waypoints != '\0') write(fs::path(folder) / base.waypoints_name, base.waypoints);
  std::vector<std::string> words{"regulus", base.words.front(), folder + "/model.toml"};
  words.insert(words.end(), base.words.begin() + 1, base.words.end());
  words.insert(words.end(),
               {"--quiet", "--json", "--engine", "interpreted", "--time-limit",
                std::to_string(kSecondsOfCommand), "--certificate", (proofs / "c").string()});
  if (base.words.front() == std::string("locate"))
    words.insert(words.end(), {"--output", (proofs.parent_path() / "boxes").string()});
  const int code = run(words);
  if (code == kUsageError || code == kBadInput) return {true, std::nullopt};
  std::set<fs::path> written;
  for (const auto& file : fs::directory_iterator(proofs)) written.insert(file.path());
  if (written.empty()) return {};
  const std::string proof = written.begin()->string();
  if (base.shard_size != 0) cut_proof(proof, base.shard_size);
  return {false, read_proof(proof)};
}

verifier::Verification verify_about(const Base& base, const std::string& certificate,
                                    const std::string& model, const std::string& folder) {
  verifier::Options options;
  options.model_text = model;
  options.model_name = folder + "/model.toml";
  options.time_limit = kSecondsOfVerifier;
  for (std::size_t i = 0; i + 1 < base.words.size(); ++i) {
    if (base.words[i] == "--alpha") options.overridden.insert("alpha");
    if (base.words[i] == "--hold") options.overridden.insert("hold");
    if (base.words[i] != "--tolerance") continue;
    std::istringstream groups(base.words[i + 1].substr(0, base.words[i + 1].find('=')));
    for (std::string group; std::getline(groups, group, ',');)
      options.overridden.insert("tolerance " + group);
  }
  if (!is_in_shards(certificate)) {
    std::istringstream text(certificate);
    return verifier::verify(text, options);
  }
  options.path = folder + "/index";
  write_proof(certificate, options.path);
  std::ifstream index(options.path, std::ios::binary);
  return verifier::verify(index, options);
}

}  // namespace regulus::detail::attack
