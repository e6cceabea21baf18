// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/json_checkpoint.hpp"

#include <unistd.h>

#include <system_error>

#include "codegen/answer/report/report_text.hpp"
#include "codegen/model/file/read_file.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/files/atomic_file.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kCheckpointFormat = "regulus_checkpoint";
constexpr int kCheckpointVersion = 3;
constexpr const char* kTree = "tree";
constexpr std::uint64_t kLargest = std::uint64_t{4} << 30;

/// Returns nullopt if there is no such file.
std::optional<std::string> read_text(const std::string& path) {
  try {
    return read_file_if_any(path, kLargest, Readable::kFile);
  } catch (const FileError& error) {
    throw FileError(std::string("the checkpoint ") + error.what());
  }
}

}  // namespace

JsonCheckpoint::JsonCheckpoint(std::string path, const Json& asked, std::string subject)
    : path_(std::move(path)), subject_(std::move(subject)) {
  const Json question = Json::parse(report_text(asked));  // as the file has it
  try {
    lock_.emplace(path_);
  } catch (const std::runtime_error& error) {
    throw FileError(std::string("the checkpoint ") + error.what());
  }
  const auto text = read_text(path_);
  content_ = text ? read(*text, question)
                  : Json{{kCheckpointFormat, kCheckpointVersion},
                         {"question", question},
                         {"known", Json::object()}};
  had_tree_ = known().contains(kTree);
  if (text) return;
  try {
    write();
  } catch (const std::system_error& error) {
    throw FileError("the checkpoint " + path_ + " cannot " + error.what());
  }
}

void JsonCheckpoint::refuse(const std::string& why) const {
  throw InputError::statement(path_, 0, subject_ + " cannot continue from this file: " + why,
                              "name another file, or delete this one to start again");
}

Json JsonCheckpoint::read(const std::string& text, const Json& question) const {
  const Json content = Json::parse(text, nullptr, false);
  const bool is_checkpoint = content.is_object() && content.contains(kCheckpointFormat) &&
                             content.contains("question") && content.contains("known") &&
                             content["known"].is_object();
  if (!is_checkpoint) refuse("it is not a checkpoint of such a question, or it is damaged");
  if (content[kCheckpointFormat] != kCheckpointVersion)
    refuse("another version of Regulus wrote it");
  // The order of keys is not part of it.
  if (nlohmann::json(content["question"]) != nlohmann::json(question))
    refuse("it is about another question");
  return content;
}

std::optional<SavedTree> JsonCheckpoint::tree(const std::string& place) const try {
  if (!known().contains(place)) return std::nullopt;
  const Json& saved = known().at(place);
  return SavedTree{saved.at("steps").get<std::string>(), saved.at("open").get<std::string>(),
                   saved.at("shown").get<std::vector<BoxId>>(),
                   saved.at("own").get<std::vector<std::uint64_t>>()};
} catch (const Json::exception& error) {
  refuse_tree(SavedTreeError(error.what()));
}

void JsonCheckpoint::keep(const SavedTree& tree, const std::string& place) {
  Json& saved = known()[place];
  saved["steps"] = tree.steps;
  saved["open"] = tree.open;
  saved["shown"] = tree.shown;
  saved["own"] = tree.own;
  is_written_ = false;
  if (!pace_) return save();
  if (pace_->is_due()) pace_->pass([this] { save(); });
}

void JsonCheckpoint::flush() {
  if (!is_written_) save();
}

void JsonCheckpoint::refuse_tree(const SavedTreeError& error) const {
  refuse(std::string("its search is damaged: ") + error.what());
}

void JsonCheckpoint::write() const {
  AtomicFile file(path_);
  file.write(report_text(content_, 2) + "\n");
  file.put_in_place_durably();
}

void JsonCheckpoint::save() try {
  write();
  failure_.clear();
  is_written_ = true;
} catch (const std::exception& error) {
  failure_ = error.what();
}

void JsonCheckpoint::remove() noexcept { ::unlink(path_.c_str()); }

std::string JsonCheckpoint::line() const {
  return failure_.empty() ? "" : "checkpoint " + path_ + " cannot " + failure_ + '\n';
}

}  // namespace regulus::detail
