// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/search_facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/set_facts.hpp"
#include "codegen/model/reduced_note.hpp"
#include "codegen/question/engine/choices.hpp"
#include "codegen/question/engine/settings.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

void tell_matrix(const SearchSubject& p, Facts& facts) {
  facts.add("matrix", name(p.labels.matrix_kind)).add("matrix_notes", p.labels.matrix_notes);
  const char* label = "matrix";
  for (const std::string& note : p.labels.matrix_notes) facts.say(std::exchange(label, ""), note);
}

/// The text does not depend on the speed of the compiler: `boxes` decides whether a compilation was
/// requested.
std::string describe_engine(const PreparedSearch& p, const SearchOptions& search,
                            std::uint64_t boxes) {
  if (p.text)
    return fmt::format("the text, compiled by Clang for {}, cache {}", name(p.isa), p.cache);
  if (search.engine == Engine::kInterpreted || p.stopped) return "interpreted";
  if (!p.no_compiler.empty()) return "interpreted, because there is no compiler: " + p.no_compiler;
  if (!p.late)
    return fmt::format("compiled {}for {}, cache {}",
                       search.engine == Engine::kClang ? "by Clang " : "", name(p.isa), p.cache);
  const std::string most = in_thousands(p.late->after_boxes());
  return boxes < p.late->after_boxes()
             ? fmt::format("interpreted (the search ended before {} boxes)", most)
             : fmt::format("interpreted, and compiled meanwhile from {} boxes on", most);
}

std::string describe_without(const SearchOptions& search) {
  return search.without.empty() ? "" : fmt::format(" without {}", fmt::join(search.without, ", "));
}

const char* json_name(FormDetail detail) {
  switch (detail) {
    case FormDetail::kFull:
      return "full";
    case FormDetail::kSmallParts:
      return "small-parts";
    case FormDetail::kAsWritten:
      return "as-written";
  }
  return "";
}

/// Returns the detail of the forms: "full", "small-parts", "as-written"; null if forming was stopped.
Json json_forms(const PreparedSearch& p) {
  if (p.stopped) return nullptr;
  return json_name(p.labels.detail);
}

/// Returns the numbers of boxes before and after the compilation was requested, {"interpreted",
/// "compiled"}; one of them is 0 if the engine never changes. The end of the compilation is left
/// out, since it differs from run to run: until then, boxes of the second number are interpreted,
/// too.
Json json_engine_boxes(const PreparedSearch& p, std::uint64_t boxes) {
  std::uint64_t interpreted = 0;
  if (p.is_interpreted && !p.late)
    interpreted = boxes;
  else if (p.late)
    interpreted = std::min(boxes, p.late->after_boxes());
  return {{"interpreted", interpreted}, {"compiled", boxes - interpreted}};
}

/// Returns an empty text for forms of full detail.
std::string describe_detail(const PreparedSearch& p) {
  if (p.stopped)
    return fmt::format("none: {} before the search",
                       p.stopped->interrupted ? "interrupted" : "the time limit was reached");
  if (p.labels.detail == FormDetail::kFull) return "";
  return fmt::format("{}: the model takes more terms than the budget for them; bounds may be wide",
                     p.labels.detail == FormDetail::kSmallParts ? "of short parts only"
                                                                : "as the model writes them");
}

}  // namespace

Json json_seconds(const StageSeconds& s) {
  Json seconds{{"model", s.model}, {"symbolic", s.symbolic}, {"program", s.program}};
  if (s.emit > 0) seconds["emit"] = s.emit;
  if (s.compile > 0) seconds["compile"] = s.compile;
  seconds["search"] = s.search;
  seconds["total"] = s.before_search() + s.search;
  return seconds;
}

Json json_seconds(double search) { return {{"search", search}, {"total", search}}; }

const char* json_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNoSingularity:
      return "no-singularity";
    case Verdict::kSingularity:
      return "singularity";
    case Verdict::kPossibleProblem:
      return "possible-problem";
  }
  return "";
}

std::string describe_size(const SearchSubject& p) {
  return fmt::format("{} {}×{} {}", full_or_reduced(p.labels.matrix_notes), p.labels.rows,
                     p.labels.columns, name(p.labels.matrix_kind));
}

const char* describe_pose(const SearchSubject& p) {
  return p.labels.where == name(Where::kReachable) ? "reachable pose of the motion"
         : p.labels.where == name(Where::kWithinRanges)
             ? "pose of the motion with the actuated joints in range"
             : "pose of the motion";
}

void tell_threshold(const SearchSubject& p, Facts& facts) {
  facts.add("alpha", mid(p.variety.alpha)).add("alpha_enclosure", json_interval(p.variety.alpha));
}

void tell_question(const SearchSubject& p, const Request& request, Facts& facts) {
  tell_model(p, facts);
  facts.add("notes", p.labels.notes);
  say_poses(p, request, facts);
  facts.add("where", p.labels.where);
  say_where(p, facts);
  tell_matrix(p, facts);
  say_uncertain(p, facts);
  tell_threshold(p, facts);
}

void add_model(const SearchSubject& p, Facts& facts) {
  facts.add("model", p.labels.model).add("model_file", p.model_file);
  facts.add("model_sha256", p.labels.model_sha256).add("motion", p.labels.motion);
}

void add_model(const Request& request, Facts& facts) {
  facts.add("model", request.model.name).add("model_file", request.model.path);
  facts.add("model_sha256", request.model.sha256).add("motion", request.motion.name);
}

void tell_model(const SearchSubject& p, Facts& facts) {
  add_model(p, facts);
  facts.say("model", p.labels.model).say("motion", p.labels.motion);
}

void tell_model(const Request& request, Facts& facts) {
  add_model(request, facts);
  facts.say("model", request.model.name).say("motion", request.motion.name);
}

Json without_head(Json question) {
  for (const char* key : {"model_sha256", "motion", "options", "version"}) question.erase(key);
  return question;
}

void add_search(const SearchOptions& search, const Json& question, Facts& facts) {
  facts.add("engine", word_of(search.engine)).add("threads", settings_from(search).threads);
  for (const char* key : {"options", "version"}) facts.add(key, question[key]);
  facts.add("question", without_head(question));
}

void tell_method(const PreparedSearch& p, const SearchOptions& search, Method method,
                 std::uint64_t boxes, Facts& facts) {
  facts.add("method", name(method)).add("without", search.without).add("forms", json_forms(p));
  facts.add("engine_boxes", json_engine_boxes(p, boxes));
  facts.add("isa", name(p.isa)).add("cache", p.cache).add("bits", p.bits);
  facts.say("method", fmt::format("{}{}, {}", name(method), describe_without(search),
                                  describe_engine(p, search, boxes)));
  facts.say("", p.cache_note).say("forms", describe_detail(p));
}

void tell_time(const StageSeconds& seconds, Facts& facts) {
  facts.tell("seconds", json_seconds(seconds), "time", describe_time(seconds));
}

std::string describe_time(const StageSeconds& s) {
  constexpr double kShown = 0.05e-3;  // less is shown as 0.0 ms
  constexpr double kLong = 10;        // more is shown in seconds
  std::string text;
  for (const auto& [stage, seconds] : {std::pair{"model", s.model},
                                       {"symbolic", s.symbolic},
                                       {"program", s.program},
                                       {"emit", s.emit},
                                       {"compile", s.compile}})
    if (seconds >= kLong)
      text += fmt::format("{} {:.1f} s, ", stage, seconds);
    else if (seconds >= kShown)
      text += fmt::format("{} {:.1f} ms, ", stage, 1e3 * seconds);
  return text + (s.search >= kLong ? fmt::format("search {:.1f} s", s.search)
                                   : fmt::format("search {:.3f} ms", 1e3 * s.search));
}

Json json_occupancy(const Result& result) {
  if (result.occupancy == Occupancy::kUnknown) return nullptr;
  return result.occupancy == Occupancy::kInhabited;
}

void tell_occupancy(const Result& result, Facts& facts) {
  facts.add("nonempty", json_occupancy(result));
  if (result.verdict == Verdict::kNoSingularity && result.occupancy == Occupancy::kUnknown)
    facts.say("warning",
              "no pose was found that satisfies the constraints: the claim may be about no pose");
}

}  // namespace regulus::detail
