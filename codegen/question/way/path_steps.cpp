// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/path_steps.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

namespace regulus::detail {
namespace {

constexpr const char* kPlace = "all segments";

/// "-5": certified by the rule 5; "2": split in the variable 2; "x": lost.
std::string word_of(const PathStep& step) {
  switch (step.kind) {
    case PathStep::Kind::kCertified:
      return '-' + std::to_string(static_cast<unsigned>(step.rule)) + ' ';
    case PathStep::Kind::kSplit:
      return std::to_string(step.variable) + ' ';
    case PathStep::Kind::kLost:
      break;
  }
  return "x ";
}

std::size_t number_below(std::size_t end, std::string_view digits) {
  std::size_t number = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || stop != digits.data() + digits.size() || number >= end)
    throw SavedTreeError("found '" + std::string(digits) + "', expected a number below " +
                         std::to_string(end));
  return number;
}

PathStep step_of(std::string_view word, std::size_t splittable) {
  if (word == "x") return {};
  if (!word.starts_with('-'))
    return {PathStep::Kind::kSplit, Rule::kBlocked, number_below(splittable, word)};
  const std::size_t rules = static_cast<std::size_t>(Rule::kWitness);
  return {PathStep::Kind::kCertified, static_cast<Rule>(number_below(rules, word.substr(1))), 0};
}

}  // namespace

PathSteps::PathSteps(const SearchCheckpoint* checkpoint, std::size_t splittable)
    : file_(checkpoint != nullptr ? checkpoint->file() : nullptr),
      pace_(checkpoint != nullptr ? checkpoint->interval() : 0) {
  if (file_ == nullptr || !file_->known().contains(kPlace)) return;
  try {
    // A path that stands still is split in no variable.
    read(file_->known().at(kPlace), std::max<std::size_t>(splittable, 1));
  } catch (const nlohmann::json::exception& error) {
    file_->refuse_tree(SavedTreeError(error.what()));
  } catch (const SavedTreeError& error) {
    file_->refuse_tree(error);
  }
}

void PathSteps::read(const nlohmann::ordered_json& saved, std::size_t splittable) {
  std::istringstream words(saved.at("steps").get<std::string>());
  for (std::string word; words >> word;) earlier_.push_back(step_of(word, splittable));
  earlier_limit_ = saved.at("limit").get<double>();
}

bool PathSteps::take(std::vector<PathStep>& steps) {
  if (earlier_.size() - next_ < steps.size()) {
    stop_repeating();
    return false;
  }
  std::copy_n(earlier_.begin() + std::ptrdiff_t(next_), steps.size(), steps.begin());
  next_ += steps.size();
  return true;
}

void PathSteps::add(const std::vector<PathStep>& steps, double limit) {
  if (file_ == nullptr || has_ended_) return;
  for (const PathStep& step : steps) text_ += word_of(step);
  limit_ = limit;
  if (pace_.is_due()) save();
}

void PathSteps::end(bool is_told) noexcept {
  has_ended_ = true;
  keeps_earlier_ = keeps_earlier_ || is_told;
}

void PathSteps::save() {
  if (file_ == nullptr || is_repeating() || keeps_earlier_) return;
  pace_.pass([this] {
    file_->known()[kPlace] = {{"steps", text_}, {"limit", limit_}};
    file_->save();
  });
}

}  // namespace regulus::detail
