// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/question_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/answer/report/angle_text.hpp"
#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/set_facts.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/question/engine/choices.hpp"
#include "codegen/question/engine/settings.hpp"
#include "regulus/version.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// The groups that are described; more are counted.
constexpr std::size_t kDescribed = 6;

const char* word_of_kind(const VariableLabel& variable) {
  return variable.kind == VariableKind::kControl ? "control" : "geometry";
}

/// Returns the options that may change the answer or its time, by their names on the command line.
Json json_options(const SearchOptions& search) {
  const auto limit = [](auto value) { return value == 0 ? Json(nullptr) : Json(value); };
  Json weights = search.weights.empty() ? Json::object() : Json{{"weights", search.weights}};
  Json options{{"method", name(search.method)},
               {"determinant", word_of(search.determinant)},
               {"entries", word_of(search.entries)},
               {"bisect", word_of(search.bisection)},
               {"uncertainty", word_of(search.uncertainty)},
               {"engine", word_of(search.engine)},
               {"threads", settings_from(search).threads},
               {"max_boxes", limit(search.max_boxes)},
               {"time_limit", limit(search.time_limit)},
               {"precision", search.precision},
               {"symbolic_budget", search.symbolic_budget},
               {"without", search.without}};
  options.update(weights);
  return options;
}

/// The labels, the ranges as doubles, and the exact question if it has the same ranges.
struct AskedQuestion {
  const ReportLabels& labels;
  const Variety& variety;
  const Request& request;
  std::vector<Variable> exact;  ///< in the order of the labels; empty if they are not known
};

/// Returns the constant of the model; nullptr for a control error.
const GeometryParameter* constant_of(const Request& request, const VariableLabel& variable) {
  if (variable.kind != VariableKind::kGeometry) return nullptr;
  const auto& geometry = request.model.geometry;
  const auto at = std::ranges::find(geometry, variable.name, &GeometryParameter::name);
  return at == geometry.end() ? nullptr : &*at;
}

Json json_quantity(const AskedQuestion& asked, std::size_t index) {
  const VariableLabel& variable = asked.labels.variables[index];
  const GeometryParameter* const constant = constant_of(asked.request, variable);
  const bool in_ball = constant != nullptr && constant->ball >= 0;
  Json quantity{{"name", variable.name},
                {"kind", word_of_kind(variable)},
                {"group", constant == nullptr ? "" : constant->group},
                {"shape", in_ball ? "ball" : "range"},
                {"unit", variable.unit},
                {"range", json_interval(asked.variety.outer[index])}};
  if (asked.exact.empty()) return quantity;
  const Range& range = asked.exact[index].range;
  quantity["value_exact"] = formula_text((range.lo + range.hi) / 2);
  quantity[in_ball ? "radius_exact" : "tolerance_exact"] = formula_text((range.hi - range.lo) / 2);
  return quantity;
}

/// Returns the pose parameters that are formulas or constants of the motion. The order and the signs
/// of GiNaC's own terms may differ in another process; those of a certificate do not.
Json json_pose_formulas(const Request& request) {
  Json formulas = Json::object();
  for (std::size_t i = 0; i < request.model.pose.size(); ++i) {
    const PoseParameter& p = request.model.pose[i];
    if (!request.motion.pose[i].is_equal(p.symbol))
      formulas[p.name] = expression_text(request.motion.pose[i]);
  }
  return formulas;
}

/// Adds the exact ranges, threshold and formulas.
void add_exact(const AskedQuestion& asked, Json& question) {
  Json ranges = Json::object();
  for (const Variable& v : asked.exact)
    if (v.kind == VariableKind::kMotion)
      ranges[v.name] = {formula_text(v.range.lo), formula_text(v.range.hi)};
  question["ranges_exact"] = ranges;
  question["alpha_exact"] = formula_text(asked.request.motion.alpha);
  // A motion along way-points has none; their file has the poses.
  if (!asked.request.motion.trajectory) {
    question["pose_exact"] = json_pose_formulas(asked.request);
    Json constraints = Json::array();
    for (const auto& constraint : asked.request.motion.constraints)
      constraints.push_back(expression_text(constraint));
    question["constraints_exact"] = constraints;
  }
}

/// Words, each with the number of times it was added, in the order of first occurrence.
class Counts {
 public:
  void add(const std::string& word) {
    const auto at = std::ranges::find(counts_, word, &Count::first);
    if (at == counts_.end())
      counts_.emplace_back(word, 1);
    else
      ++at->second;
  }

  using Count = std::pair<std::string, std::size_t>;
  [[nodiscard]] const std::vector<Count>& all() const noexcept { return counts_; }

 private:
  std::vector<Count> counts_;
};

Counts count_groups(const ReportLabels& labels) {
  Counts groups;
  for (const VariableLabel& v : labels.variables)
    if (v.kind == VariableKind::kGeometry) groups.add(v.group);
  return groups;
}

std::size_t control_errors(const ReportLabels& labels) {
  return std::size_t(
      std::ranges::count(labels.variables, VariableKind::kControl, &VariableLabel::kind));
}

Json json_groups(const ReportLabels& labels) {
  Json groups = Json::array();
  const Counts counts = count_groups(labels);
  for (const auto& [group, count] : counts.all())
    groups.push_back({{"group", group}, {"kind", "geometry"}, {"quantities", count}});
  if (const std::size_t errors = control_errors(labels); errors > 0)
    groups.push_back({{"group", ""}, {"kind", "control"}, {"quantities", errors}});
  return groups;
}

/// The units of all numbers that a report gives by name.
Json json_units(const AskedQuestion& asked) {
  Json units = Json::object();
  for (const PoseLabel& p : asked.labels.pose) units[p.name] = p.unit;
  for (const VariableLabel& v : asked.labels.variables) units[v.name] = v.unit;
  if (asked.request.model.closure)
    for (const PoseParameter& u : asked.request.model.closure->unknowns) units[u.name] = u.unit;
  return units;
}

Json json_asked(const AskedQuestion& asked, const SearchOptions& search) {
  const ReportLabels& labels = asked.labels;
  Json ranges = Json::object(), uncertain = Json::array();
  for (std::size_t i = 0; i < labels.variables.size(); ++i)
    if (is_motion(labels.variables[i]))
      ranges[labels.variables[i].name] = json_interval(asked.variety.outer[i]);
    else
      uncertain.push_back(json_quantity(asked, i));
  Json question{{"model_sha256", labels.model_sha256},
                {"motion", labels.motion},
                {"ranges", ranges},
                {"uncertain", uncertain},
                {"groups", json_groups(labels)},
                {"units", json_units(asked)},
                {"alpha", json_interval(asked.variety.alpha)},
                {"where", labels.where},
                {"constraints", labels.constraints}};
  if (asked.exact.size() == labels.variables.size()) add_exact(asked, question);
  question["options"] = json_options(search);
  question["version"] = kVersion;
  return question;
}

/// Returns "base ±0.05": `size` has the sign and the unit.
std::string describe_tolerance(const VariableLabel& variable, const std::string& size) {
  return fmt::format("{} {}{}", variable.group.empty() ? variable.name : variable.group, size,
                     variable.in_ball ? " in balls" : "");
}

/// Returns "±0.05 mm": six digits, for people.
std::string size_of_tolerance(const SearchSubject& p, std::size_t index) {
  return half_width_text(p.variety.outer[index], p.labels.variables[index].unit);
}

std::string describe_counts(const Counts& tolerances) {
  std::vector<std::string> words;
  for (const auto& [tolerance, count] : tolerances.all())
    words.push_back(count == 1 ? tolerance : fmt::format("{} of {}", count, tolerance));
  const std::size_t left = words.size() > kDescribed ? words.size() - kDescribed : 0;
  words.resize(words.size() - left);
  return fmt::format("{}{}", fmt::join(words, ", "),
                     left > 0 ? fmt::format(" and {} more", left) : "");
}

}  // namespace

Json json_question(const PreparedSearch& p, const SearchOptions& search) {
  const Request& request = p.stages->request();
  AskedQuestion asked{p.labels, p.variety, request, {}};
  if (!p.is_replanned) asked.exact = formulate_shape(request.model, request.motion).variables;
  return json_asked(asked, search);
}

Json json_question(const Request& request, const SearchOptions& search) {
  const AskedSet set = set_of(request);
  return json_asked({set.subject.labels, set.subject.variety, request, set.exact}, search);
}

Json json_kept_question(const PreparedSearch& p, const SearchOptions& search) {
  Json question = json_question(p, search);
  question.erase("options");  // the others change how long it takes
  question.erase("pose_exact");
  question.erase("constraints_exact");
  question["uncertainty"] = word_of(search.uncertainty);
  // These are not checked, so a run that continues must name them, too.
  for (const FilterFile& filter : p.filters) question["filters"].push_back(filter.sha256());
  if (p.text) question["kernel"] = p.text->sha256;
  return question;
}

Json json_vector_set(const VectorSet& set, const std::vector<std::string>& units) {
  Json members = Json::array();
  for (const GeometryParameter& entry : set.entries) {
    Json member{{"name", entry.name}, {"value_exact", formula_text(entry.value)}};
    if (entry.ball >= 0)
      member["radius_exact"] = formula_text(set.balls.at(std::size_t(entry.ball)).radius);
    else
      member["tolerance_exact"] = formula_text(entry.tolerance);
    member["unit"] = members.size() < units.size() ? units[members.size()] : "1";
    members.push_back(std::move(member));
  }
  return {{"name", set.name}, {"entries", members}};
}

std::string describe_groups(const ReportLabels& labels) {
  std::vector<std::string> words;
  const Counts counts = count_groups(labels);
  for (const auto& [group, count] : counts.all())
    words.push_back(group.empty() ? fmt::format("{} without a group", count)
                                  : fmt::format("{} of {}", count, group));
  if (const std::size_t errors = control_errors(labels); errors > 0)
    words.push_back(fmt::format("{} control error{}", errors, errors == 1 ? "" : "s"));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string describe_tolerances(const SearchSubject& p) {
  Counts tolerances;
  const auto& variables = p.labels.variables;
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (!is_motion(variables[i]))
      tolerances.add(describe_tolerance(variables[i], size_of_tolerance(p, i)));
  return describe_counts(tolerances);
}

std::string describe_growing_tolerances(const SearchSubject& grown, const SearchSubject& before) {
  Counts tolerances;
  const auto& variables = grown.labels.variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    if (is_motion(variables[i])) continue;
    const bool grows = std::ranges::find(before.labels.variables, variables[i].name,
                                         &VariableLabel::name) == before.labels.variables.end();
    tolerances.add(describe_tolerance(variables[i], grows ? "±v" : size_of_tolerance(grown, i)));
  }
  return describe_counts(tolerances) + "; v grows";
}

}  // namespace regulus::detail
