// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/bound/bound_checkpoint.hpp"

#include <charconv>
#include <cmath>

#include "codegen/bound/quantity_report.hpp"
#include "codegen/model/read_file.hpp"
#include "codegen/report/question_report.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/files/atomic_file.hpp"

namespace regulus::inline bounding {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "regulus_bracket_checkpoint";
constexpr int kFormatVersion = 1;
constexpr std::uint64_t kLargest = 64 << 20;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw InputError::statement(path, 0, "the brackets cannot continue from this file: " + why,
                              "name another file, or delete this one to start again");
}

/// Returns the content of a checkpoint of the question; of another file throws InputError.
Json read_content(const std::string& path, const std::string& text, const Json& question) {
  const Json content = Json::parse(text, nullptr, false);
  if (!content.is_object() || !content.contains(kFormat) || !content.contains("question") ||
      !content.contains("components") || !content["components"].is_object())
    refuse(path, "it is not a checkpoint of brackets, or it is damaged");
  if (content[kFormat] != kFormatVersion) refuse(path, "another version of Regulus wrote it");
  if (content["question"] != question) refuse(path, "it is about another question");
  return content;
}

/// Returns the end that a component has under a key, if it is a decimal.
std::optional<MarginValue> end_of(const Json& component, const char* key) {
  if (!component.contains(key) || !component[key].is_string()) return std::nullopt;
  const std::string text = component[key];
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return decimal_value(value);
}

}  // namespace

BoundCheckpoint::BoundCheckpoint(std::string path, const Json& question) : path_(std::move(path)) {
  try {
    lock_.emplace(path_);
  } catch (const std::runtime_error& error) {
    throw FileError(std::string("the checkpoint ") + error.what());
  }
  const auto text = read_file_if_any(path_, kLargest, Readable::kFile);
  content_ =
      text
          ? read_content(path_, *text, question)
          : Json{{kFormat, kFormatVersion}, {"question", question}, {"components", Json::object()}};
  if (!text) save();
}

void BoundCheckpoint::narrow(MarginQuestion& bracket, const std::string& label,
                             const std::string& reference) const {
  const Json& components = content_["components"];
  if (!components.contains(label)) return;
  const Json& component = components[label];
  if (!component.is_object() || component.value("reference", "") != reference) return;
  const auto is_inside = [&](const MarginValue& value) {
    return value.approx > bracket.low.approx &&
           (!bracket.high || value.approx < bracket.high->approx);
  };
  const auto low = end_of(component, "certified"), high = end_of(component, "refuted");
  if (low && high && !(low->approx < high->approx)) return;
  const bool moves_low = low && is_inside(*low), moves_high = high && is_inside(*high);
  if (moves_low) bracket.low = *low;
  if (moves_high) bracket.high = *high;
}

void BoundCheckpoint::note(const std::string& label, const std::string& reference,
                           const MarginStep& step) {
  const Verdict verdict = step.result.verdict;
  if (verdict == Verdict::kPossibleProblem) return;
  Json& component = content_["components"][label];
  if (!component.is_object() || component.value("reference", "") != reference)
    component = Json{{"reference", reference}};
  const char* key = verdict == Verdict::kNoSingularity ? "certified" : "refuted";
  const std::optional<MarginValue> known = end_of(component, key);
  const bool is_better =
      !known || (verdict == Verdict::kNoSingularity ? step.value.approx > known->approx
                                                    : step.value.approx < known->approx);
  if (!is_better) return;
  component[key] = step.value.text;
  save();
}

void BoundCheckpoint::save() try {
  AtomicFile file(path_, path_ + ".new");
  file.write(content_.dump(2) + "\n");
  file.put_in_place_durably();
} catch (const std::exception& error) {
  throw FileError("the checkpoint " + path_ + ": " + error.what());
}

Json checkpointed_question(const Request& request, const Quantity& quantity,
                           const SearchOptions& search) {
  Json question = json_question(request, search);
  question.erase("options");  // they change how long it takes
  question["quantity"] = json_quantity(request.model, quantity);
  return question;
}

}  // namespace regulus::bounding
