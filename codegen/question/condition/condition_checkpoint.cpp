// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/condition_checkpoint.hpp"

namespace regulus {
namespace {

using Json = nlohmann::ordered_json;

Json json_state(const ConditionState& state) {
  Json object{{"steps", state.steps}, {"open", state.open}, {"was_told", state.was_told}};
  if (state.attained) object["attained"] = *state.attained;
  return object;
}

ConditionState read_state(const Json& object) try {
  ConditionState state;
  state.steps = object.at("steps").get<std::string>();
  state.open = object.at("open").get<std::string>();
  state.was_told = object.at("was_told").get<bool>();
  if (object.contains("attained")) state.attained = object.at("attained").get<BoxId>();
  return state;
} catch (const Json::exception& error) {
  throw ConditionStateError(error.what());
}

}  // namespace

ConditionResult search_with_checkpoint(const ConditionQuestion& question,
                                       ConditionSettings settings, Observer* progress,
                                       BoundCheckpoint* checkpoint) {
  if (checkpoint == nullptr) return search_condition(question, settings, progress);
  settings.save = [checkpoint](const ConditionState& state) {
    checkpoint->keep_search_state(json_state(state));
  };
  try {
    ConditionState from;
    if (const Json saved = checkpoint->search_state(); !saved.is_null()) {
      from = read_state(saved);
      settings.from = &from;
    }
    return search_condition(question, settings, progress);
  } catch (const ConditionStateError& error) {
    checkpoint->refuse(std::string("its search is damaged: ") + error.what());
  }
}

std::string describe_end(const ConditionResult& result) {
  if (result.is_continued) return describe(result.reason);
  return std::string("the bounds of the checkpoint were not all proved again: ") +
         describe(result.reason);
}

}  // namespace regulus
