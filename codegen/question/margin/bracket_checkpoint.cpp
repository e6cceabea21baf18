// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/margin/bracket_checkpoint.hpp"

#include <algorithm>
#include <system_error>

#include "codegen/answer/report/report_text.hpp"
#include "codegen/model/file/read_file.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/files/atomic_file.hpp"

namespace regulus {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "regulus_bracket_checkpoint";
constexpr int kFormatVersion = 2;
constexpr const char* kSearchState = "search";
constexpr std::uint64_t kLargest = std::uint64_t{4} << 30;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw InputError::statement(path, 0, "the bracket cannot continue from this file: " + why,
                              "name another file, or delete this one to start again");
}

/// Returns the content of a checkpoint of the question; of another file throws InputError.
Json read_content(const std::string& path, const std::string& text, const Json& question) {
  const Json content = Json::parse(text, nullptr, false);
  if (!content.is_object() || !content.contains(kFormat) || !content.contains("question") ||
      !content.contains("brackets") || !content["brackets"].is_object())
    refuse(path, "it is not a checkpoint of a bracket, or it is damaged");
  if (content[kFormat] != kFormatVersion) refuse(path, "another version of Regulus wrote it");
  if (content["question"] != question) refuse(path, "it is about another question");
  return content;
}

/// True if the same search always ends for this reason, whatever the time.
bool is_repeatable(Reason reason) {
  switch (reason) {
    case Reason::kWidth:
    case Reason::kUncertainty:
    case Reason::kUndefined:
    case Reason::kBoxBudget:
    case Reason::kSeemsSingular:
    case Reason::kStalled:
      return true;
    default:
      return false;
  }
}

bool is_repeatable(const Result& result) {
  if (result.occupancy == Occupancy::kEmpty) return false;
  if (result.verdict == Verdict::kNoSingularity) return true;
  return result.verdict == Verdict::kPossibleProblem && is_repeatable(result.reason) &&
         std::ranges::all_of(result.blocking_box, [](const Interval& i) { return is_bounded(i); });
}

Json written(const Result& result, std::uint64_t most_boxes) {
  Json entry{{"certified", result.verdict == Verdict::kNoSingularity},
             {"reason", int{static_cast<std::uint8_t>(result.reason)}},
             {"boxes", result.statistics.boxes},
             {"most_boxes", most_boxes}};
  for (const Interval& range : result.blocking_box) entry["box"].push_back({range.lo, range.hi});
  return entry;
}

/// Throws Json::exception, or gives a result that is not repeatable, for a damaged entry.
Result read_result(const Json& entry) {
  Result result;
  const bool is_certified = entry.at("certified").get<bool>();
  result.verdict = is_certified ? Verdict::kNoSingularity : Verdict::kPossibleProblem;
  result.reason = is_certified ? Reason::kAllBoxesCertified
                               : static_cast<Reason>(entry.at("reason").get<std::uint8_t>());
  result.statistics.boxes = entry.at("boxes").get<std::uint64_t>();
  if (!entry.contains("box")) return result;
  for (const Json& range : entry["box"]) {
    const double lo = range.at(0).get<double>(), hi = range.at(1).get<double>();
    if (!(lo <= hi)) return {};
    result.blocking_box.emplace_back(lo, hi);
  }
  return result;
}

}  // namespace

/// The searches of one bracket in the file.
class BracketCheckpoint::Searches final : public EarlierSearches {
 public:
  Searches(BracketCheckpoint& file, std::string bracket)
      : file_(file), bracket_(std::move(bracket)) {}

  [[nodiscard]] std::optional<Result> find(const MarginValue& value,
                                           std::uint64_t most_boxes) const override {
    try {
      const Json& entry = file_.content_.at("brackets").at(bracket_).at(value.text);
      if (entry.at("most_boxes").get<std::uint64_t>() != most_boxes) return std::nullopt;
      Result result = read_result(entry);
      return is_repeatable(result) ? std::optional(std::move(result)) : std::nullopt;
    } catch (const Json::exception&) {
      return std::nullopt;
    }
  }

  void keep(const MarginValue& value, std::uint64_t most_boxes, const Result& result) override {
    if (!is_repeatable(result)) return;
    Json& bracket = file_.content_["brackets"][bracket_];
    if (!bracket.is_object()) bracket = Json::object();
    bracket[value.text] = written(result, most_boxes);
    file_.save();
  }

  [[noreturn]] void refuse(const MarginValue& value) const override {
    regulus::refuse(file_.path_, "the search at " + value.text + " does not end as it says");
  }

 private:
  BracketCheckpoint& file_;
  std::string bracket_;
};

BracketCheckpoint::BracketCheckpoint(std::string path, const Json& asked) : path_(std::move(path)) {
  const Json question = Json::parse(report_text(asked));  // as the file has it
  try {
    lock_.emplace(path_);
  } catch (const std::runtime_error& error) {
    throw FileError(std::string("the checkpoint ") + error.what());
  }
  const auto text = read_file_if_any(path_, kLargest, Readable::kFile);
  content_ =
      text ? read_content(path_, *text, question)
           : Json{{kFormat, kFormatVersion}, {"question", question}, {"brackets", Json::object()}};
  if (text) return;
  try {
    write();
  } catch (const std::system_error& error) {
    throw FileError("the checkpoint " + path_ + " cannot " + error.what());
  }
}

std::unique_ptr<EarlierSearches> BracketCheckpoint::searches_of(const MarginQuestion& bracket,
                                                                const std::string& label,
                                                                const std::string& reference) {
  const std::string high = bracket.high ? bracket.high->text : "";
  return std::make_unique<Searches>(
      *this, label + " from " + reference + ", " + bracket.low.text + ":" + high);
}

Json BracketCheckpoint::search_state() const {
  return content_.contains(kSearchState) ? content_[kSearchState] : Json();
}

void BracketCheckpoint::keep_search_state(Json state) {
  content_[kSearchState] = std::move(state);
  save();
}

void BracketCheckpoint::refuse(const std::string& why) const { regulus::refuse(path_, why); }

void BracketCheckpoint::write() const {
  AtomicFile file(path_);
  file.write(report_text(content_, 2) + "\n");
  file.put_in_place_durably();
}

void BracketCheckpoint::save() try {
  write();
  failure_.clear();
} catch (const std::exception& error) {
  failure_ = error.what();
}

std::string BracketCheckpoint::line() const {
  return failure_.empty() ? "" : "checkpoint " + path_ + " cannot " + failure_ + '\n';
}

}  // namespace regulus
