// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/certificate/proof_status.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "runtime/proof/format.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSafe = ".safe";
constexpr const char* kSingular = ".singular";
/// Under what follows the word `proof` of the line above.
constexpr const char* kMargin = "           ";

std::string none(const std::string& obstacle) { return "proof      none: " + obstacle + '\n'; }

/// Returns an entry of `proof`: a file, or the reason why there is none.
Json proof_entry(const std::string& file, const std::string& reason) {
  if (file.empty()) return {{"file", nullptr}, {"reason", reason}};
  return {{"file", file}, {"reason", nullptr}};
}

std::string line_of(const EndProof& end, const std::string& name) {
  if (!end.file.empty()) return end.file + ": " + end.words + '\n';
  return "none for the " + name + " end: " + end.words + '\n';
}

}  // namespace

void put_in_place(std::shared_ptr<ProofFile> proof, const ProofPlacing& placing) {
  const std::string path = proof->path();
  proof->set_shard_size(placing.shard_size);
  hold_or_put(placing.held, path,
              [proof = std::move(proof)] { with_file_errors([&] { proof->put_in_place(); }); });
}

void write_witness(const std::string& path, const std::string& head, const std::string& witness,
                   const ProofPlacing& placing) {
  const auto file = with_file_errors([&] { return std::make_shared<ProofFile>(path); });
  with_file_errors([&] { file->complete_with(head, witness); });
  put_in_place(file, placing);
}

void ProofStatus::set_written(std::string note) {
  is_written_ = true;
  obstacle_.clear();
  note_ = std::move(note);
}

std::string ProofStatus::line() const {
  if (!is_wanted()) return "";
  if (!is_written_) return none(obstacle_);
  return "proof      " + path_ + '\n' + (note_.empty() ? "" : kMargin + note_ + '\n');
}

void ProofStatus::tell(Facts& facts) const {
  if (!is_wanted()) return;
  facts.add("certificate", is_written_ ? Json(path_) : Json(nullptr));
  if (!is_written_) facts.add("certificate_obstacle", obstacle_);
  if (is_written_ && !note_.empty()) facts.add("certificate_note", note_);
  facts.add("proof", Json::array({proof_entry(is_written_ ? path_ : "", obstacle_)}));
}

EndProofs::EndProofs(std::string path, const ProofPlacing& placing, std::string no_safe,
                     std::string no_singular, const char* safe_name, const char* singular_name)
    : path_(std::move(path)),
      placing_(placing),
      safe_{{}, std::move(no_safe)},
      singular_{{}, std::move(no_singular)},
      safe_name_(safe_name),
      singular_name_(singular_name) {
  if (!are_wanted()) return;
  for (const std::string& file : {safe_file(), singular_file()})
    with_file_errors([&] { const ProofFile probe(file); });
}

std::vector<OutputFile> EndProofs::files(const std::string& path) {
  if (path.empty()) return {};
  return {{"--certificate", path + kSafe, true, format::kShardsEnding},
          {"--certificate", path + kSingular, true, format::kShardsEnding}};
}

void EndProofs::write_safe(const std::function<std::shared_ptr<ProofFile>()>& complete,
                           std::string words) {
  try {
    put_in_place(complete(), placing_);
    set_safe(std::move(words));
  } catch (const FileError& why) {
    lose_safe(why.what());
  }
}

void EndProofs::write_singular(const std::string& head, const std::string& witness,
                               std::string words) {
  try {
    write_witness(singular_file(), head, witness, placing_);
    set_singular(std::move(words));
  } catch (const FileError& why) {
    lose_singular(why.what());
  }
}

void EndProofs::note(bool is_safe, const ProofStatus& written, const std::string& value) {
  if (written.is_lost())
    is_safe ? lose_safe(written.obstacle()) : lose_singular(written.obstacle());
  else if (!written.is_written())
    is_safe ? set_no_safe(written.obstacle()) : set_no_singular(written.obstacle());
  else
    is_safe ? set_safe("safe at " + value) : set_singular("singular at " + value);
}

/// An earlier file of this end stays.
void EndProofs::lose(EndProof& end, std::string why) {
  if (end.file.empty()) end.words = why;
  end.lost = std::move(why);
}

void EndProofs::note_missing_files(const std::string& why) {
  std::error_code ignored;
  for (EndProof* end : {&safe_, &singular_})
    if (!end->file.empty() && !std::filesystem::exists(end->file, ignored)) *end = {{}, why, why};
}

std::vector<std::string> EndProofs::lost() const {
  std::vector<std::string> all;
  for (const EndProof* end : {&safe_, &singular_})
    if (!end->lost.empty()) all.push_back(end->lost);
  return all;
}

std::string EndProofs::safe_file() const { return path_ + kSafe; }

std::string EndProofs::singular_file() const { return path_ + kSingular; }

void EndProofs::set_no_safe(std::string why) {
  if (safe_.file.empty()) safe_.words = std::move(why);
}

void EndProofs::set_no_singular(std::string why) {
  if (singular_.file.empty()) singular_.words = std::move(why);
}

std::string EndProofs::lines() const {
  if (!are_wanted()) return "";
  const bool has_none = safe_.file.empty() && singular_.file.empty();
  if (has_none && safe_.words == singular_.words) return none(safe_.words);
  return "proof      " + line_of(safe_, safe_name_) + kMargin + line_of(singular_, singular_name_);
}

void EndProofs::tell_files(Facts& facts) const {
  if (!are_wanted()) return;
  Facts files(Readers::kPrograms), obstacles(Readers::kPrograms);
  for (const auto& [name, end] : {std::pair("safe", &safe_), std::pair("singular", &singular_)}) {
    files.add(name, end->file.empty() ? Json(nullptr) : Json(end->file));
    if (end->file.empty()) obstacles.add(name, end->words);
  }
  facts.tell_part("certificates", std::move(files));
  if (!obstacles.all().empty()) facts.tell_part("certificate_obstacles", std::move(obstacles));
}

void EndProofs::tell(Facts& facts) const {
  if (!are_wanted()) return;
  tell_files(facts);
  Json proofs = Json::array();
  add_to(proofs);
  facts.add("proof", std::move(proofs));
}

void EndProofs::add_to(Json& proofs, const std::string& component) const {
  if (!are_wanted()) return;
  for (const auto& [name, end] : {std::pair("safe", &safe_), std::pair("singular", &singular_)}) {
    Json entry = proof_entry(end->file, end->words);
    entry["end"] = name;
    if (!component.empty()) entry["component"] = component;
    proofs.push_back(std::move(entry));
  }
}

}  // namespace regulus::detail
