// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/margin/bracket_checkpoint.hpp"

#include <algorithm>

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kBrackets = "brackets";

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
             {"reason", unsigned{static_cast<std::uint8_t>(result.reason)}},
             {"boxes", result.statistics.boxes},
             {"most_boxes", most_boxes}};
  for (const Interval& range : result.blocking_box) entry["box"].push_back({range.lo, range.hi});
  return entry;
}

/// Throws Json::exception for anything but a number such as 12.
std::uint64_t whole_number(const Json& value) {
  return value.get_ref<const Json::number_unsigned_t&>();
}

/// Throws Json::exception, or gives a result that is not repeatable, for a damaged entry.
Result read_result(const Json& entry) {
  Result result;
  const bool is_certified = entry.at("certified").get<bool>();
  result.verdict = is_certified ? Verdict::kNoSingularity : Verdict::kPossibleProblem;
  result.reason =
      is_certified
          ? Reason::kAllBoxesCertified
          : static_cast<Reason>(static_cast<std::uint8_t>(whole_number(entry.at("reason"))));
  result.statistics.boxes = whole_number(entry.at("boxes"));
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
  Searches(JsonCheckpoint& file, std::string bracket) : file_(file), bracket_(std::move(bracket)) {}

  [[nodiscard]] std::optional<Result> find(const MarginValue& value,
                                           std::uint64_t most_boxes) const override {
    try {
      const Json& entry = file_.known().at(kBrackets).at(bracket_).at(value.text);
      if (whole_number(entry.at("most_boxes")) != most_boxes) return std::nullopt;
      Result result = read_result(entry);
      if (result.statistics.boxes > most_boxes) return std::nullopt;
      return is_repeatable(result) ? std::optional(std::move(result)) : std::nullopt;
    } catch (const Json::exception&) {
      return std::nullopt;
    }
  }

  void keep(const MarginValue& value, std::uint64_t most_boxes, const Result& result) override {
    if (!is_repeatable(result)) return;
    Json& bracket = file_.known()[kBrackets][bracket_];
    if (!bracket.is_object()) bracket = Json::object();
    bracket[value.text] = written(result, most_boxes);
    file_.save();
  }

  [[noreturn]] void refuse(const MarginValue& value) const override {
    file_.refuse("the search at " + value.text + " does not end as it says");
  }

 private:
  JsonCheckpoint& file_;
  std::string bracket_;
};

BracketCheckpoint::BracketCheckpoint(std::string path, const Json& question)
    : file_(std::move(path), question, "the bracket") {
  Json& brackets = file_.known()[kBrackets];
  if (brackets.is_null()) brackets = Json::object();
  if (!brackets.is_object()) file_.refuse("it is not a checkpoint of a bracket, or it is damaged");
}

std::unique_ptr<EarlierSearches> BracketCheckpoint::searches_of(const MarginQuestion& bracket,
                                                                const std::string& label,
                                                                const std::string& reference) {
  const std::string high = bracket.high ? bracket.high->text : "";
  return std::make_unique<Searches>(
      file_, label + " from " + reference + ", " + bracket.low.text + ":" + high);
}

}  // namespace regulus::detail
