// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/report_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include "codegen/answer/report/question_report.hpp"

namespace regulus {
namespace {

using Json = nlohmann::ordered_json;

std::string shortest(double x) { return fmt::format("{}", x + 0.0); }  // −0 reads as 0

/// Returns the shortest decimal that reads as a double of the interval; for −x, the same with the
/// other sign.
std::string shortest_in(const Interval& x) {
  const bool negative = x.hi <= 0;
  for (int digits = 1; digits < 17; ++digits)
    for (const double end : {negative ? x.hi : x.lo, negative ? x.lo : x.hi}) {
      const std::string text = fmt::format("{:.{}g}", end, digits);
      double shown = 0;
      std::from_chars(text.data(), text.data() + text.size(), shown);
      if (x.lo <= shown && shown <= x.hi) return shortest(shown);
    }
  return shortest(negative ? x.hi : x.lo);
}

std::string joined(const std::string& lo, const std::string& hi) {
  return lo == hi ? lo : fmt::format("[{}, {}]", lo, hi);
}

/// Returns the decimal of at most six digits that is this angle in degrees, if there is one.
std::optional<double> short_degrees(const Interval& radians) {
  // Two roundings: of the factor and of the product.
  const double degree = 180 / std::numbers::pi;
  const double slack = 4 * std::numeric_limits<double>::epsilon() * std::fabs(radians.lo);
  const double lo = (radians.lo - slack) * degree, hi = (radians.hi + slack) * degree;
  double shown = 0;
  const std::string text = fmt::format("{:.6g}", lo / 2 + hi / 2);
  std::from_chars(text.data(), text.data() + text.size(), shown);
  return lo <= shown && shown <= hi ? std::optional(shown) : std::nullopt;
}

/// Returns " ([-15, 15] deg)" for angles in radians whose ends are short numbers of degrees.
std::string describe_degrees(const PreparedSearch& p, std::size_t k) {
  const Interval& outer = p.variety.outer[k];
  const std::optional<Interval>& inner = p.variety.inner[k];
  if (p.labels.variables[k].unit != "rad" || (outer.lo == 0 && outer.hi == 0)) return "";
  const auto lo = short_degrees(inner ? Interval{outer.lo, inner->lo} : outer);
  const auto hi = short_degrees(inner ? Interval{inner->hi, outer.hi} : outer);
  return lo && hi ? fmt::format(" ({} deg)", joined(shortest(*lo), shortest(*hi))) : "";
}

/// Returns bounds of variable k. The ends of its whole range are written as in the model, because
/// the outward and inward roundings enclose them.
std::string text_of(const PreparedSearch& p, std::size_t k, const Interval& x) {
  const Interval& outer = p.variety.outer[k];
  const std::optional<Interval>& inner = p.variety.inner[k];
  if (!inner && x.lo == outer.lo && x.hi == outer.hi) return shortest_in(outer);
  const bool from_first = inner && x.lo == outer.lo, to_last = inner && x.hi == outer.hi;
  return joined(from_first ? shortest_in({outer.lo, inner->lo}) : shortest(x.lo),
                to_last ? shortest_in({inner->hi, outer.hi}) : shortest(x.hi));
}

std::string short_text_of(const PreparedSearch&, std::size_t, const Interval& x) {
  return short_interval(x);
}

/// Returns the shortest decimal of a value that is known to six digits or more.
std::string value_text(const Interval& x) {
  const std::string brief = short_interval(x);
  return brief.front() == '[' ? joined(shortest(x.lo), shortest(x.hi)) : shortest_in(x);
}

Json json_variables(const PreparedSearch& p, std::span<const Interval> values, bool motion) {
  Json object = Json::object();
  const auto& variables = p.labels.variables;
  for (std::size_t i = 0; i < values.size() && i < variables.size(); ++i)
    if (is_motion(variables[i]) == motion) object[variables[i].name] = json_interval(values[i]);
  return object;
}

std::string format_variable(const PreparedSearch& p, bool motion) {
  std::string lines;
  const auto& variables = p.labels.variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    if (is_motion(variables[i]) != motion) continue;
    const std::string range = text_of(p, i, p.variety.outer[i]);
    lines += fmt::format("           {} {} {}{}{}\n", variables[i].name,
                         range.front() == '[' ? "in" : "=", range, unit_suffix(variables[i].unit),
                         describe_degrees(p, i));
  }
  return lines;
}

/// More than this many uncertain quantities are counted, not listed.
constexpr std::size_t kListed = 8;

std::string format_uncertain(const PreparedSearch& p) {
  const std::size_t count = uncertain_count(p);
  if (count == 0) return "uncertain  nothing: geometry and control are taken as exact\n";
  const std::string line = fmt::format(
      "uncertain  {} {}: {}\n", count, count == 1 ? "quantity" : "quantities",
      // Searches at several tolerances have one report.
      count <= kListed || p.is_replanned ? describe_groups(p.labels) : describe_tolerances(p));
  return count <= kListed ? line + format_variable(p, false) : line;
}

/// "x = 3, y = [4, 5]": of the motion parameters or of the other variables.
std::string assignments(const PreparedSearch& p, std::span<const Interval> values, bool motion,
                        std::string (*text)(const PreparedSearch&, std::size_t, const Interval&)) {
  std::string words;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const VariableLabel& variable = p.labels.variables[i];
    if (is_motion(variable) != motion) continue;
    words +=
        fmt::format("{}{} = {}", words.empty() ? "" : ", ", variable.name, text(p, i, values[i]));
  }
  return words;
}

std::string pose_line_of(const PreparedSearch& p, std::span<const Interval> pose,
                         std::string (*text)(const Interval&)) {
  const auto& parameters = p.labels.pose;
  const auto& variables = p.labels.variables;
  bool shown = false;
  std::string words;
  for (std::size_t i = 0; i < pose.size() && i < parameters.size(); ++i) {
    shown = shown || i >= variables.size() || variables[i].name != parameters[i].name;
    words += fmt::format("{}{} = {}", words.empty() ? "" : ", ", parameters[i].name, text(pose[i]));
  }
  return shown ? fmt::format("           where the pose is {}\n", words) : "";
}

/// The text does not depend on the speed of the compiler: `boxes` decides whether a compilation was
/// requested.
std::string describe_engine(const PreparedSearch& p, const SearchOptions& search,
                            std::uint64_t boxes) {
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

}  // namespace

Json json_interval(const Interval& x) { return Json::array({x.lo, x.hi}); }

Json json_parameters(const PreparedSearch& p, std::span<const Interval> variables) {
  return json_variables(p, variables, true);
}

Json json_uncertain(const PreparedSearch& p, std::span<const Interval> variables) {
  return json_variables(p, variables, false);
}

Json json_pose(const PreparedSearch& p, std::span<const Interval> pose) {
  Json object = Json::object();
  const auto& parameters = p.labels.pose;
  for (std::size_t i = 0; i < pose.size() && i < parameters.size(); ++i)
    object[parameters[i].name] = json_interval(pose[i]);
  return object;
}

Json json_seconds(const StageSeconds& s) {
  return {{"model", s.model},   {"symbolic", s.symbolic},
          {"emit", s.emit},     {"compile", s.compile},
          {"search", s.search}, {"total", s.model + s.symbolic + s.emit + s.compile + s.search}};
}

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

Json json_engine_boxes(const PreparedSearch& p, const SearchOptions& search, std::uint64_t boxes) {
  std::uint64_t interpreted = 0;
  if (search.engine == Engine::kInterpreted || p.stopped || !p.no_compiler.empty())
    interpreted = boxes;
  else if (p.late)
    interpreted = std::min(boxes, p.late->after_boxes());
  return {{"interpreted", interpreted}, {"compiled", boxes - interpreted}};
}

std::string in_thousands(std::uint64_t count) {
  if (count < 1000) return std::to_string(count);
  return fmt::format("{} {:03}", in_thousands(count / 1000), count % 1000);
}

std::string short_interval(const Interval& x) {
  const std::string lo = fmt::format("{:.6g}", x.lo + 0.0);  // −0 reads as 0
  const std::string hi = fmt::format("{:.6g}", x.hi + 0.0);
  return lo == hi ? lo : fmt::format("[{}, {}]", lo, hi);
}

std::string threshold_text(const Interval& alpha, bool exceeded) {
  const double end = exceeded ? alpha.lo : alpha.hi;
  for (int digits = 6;; ++digits) {
    const std::string text = fmt::format("{:.{}g}", end, digits);
    double shown = 0;
    std::from_chars(text.data(), text.data() + text.size(), shown);
    if ((alpha.lo <= shown && shown <= alpha.hi) || digits == 17) return text;
  }
}

std::string unit_suffix(const std::string& unit) {
  return unit.empty() || unit == "1" ? "" : " " + unit;
}

bool is_motion(const VariableLabel& variable) { return variable.kind == VariableKind::kMotion; }

std::size_t uncertain_count(const PreparedSearch& p) {
  std::size_t count = 0;
  for (const VariableLabel& variable : p.labels.variables) count += !is_motion(variable);
  return count;
}

std::string describe_place(const PreparedSearch& p, std::span<const Interval> variables) {
  const std::string words = assignments(p, variables, true, text_of);
  return words.empty() ? "the only pose" : words;
}

std::string describe_short_place(const PreparedSearch& p, std::span<const Interval> variables) {
  const std::string words = assignments(p, variables, true, short_text_of);
  return words.empty() ? "the only pose" : words;
}

std::string format_uncertain_values(const PreparedSearch& p, std::span<const Interval> variables) {
  const std::size_t count = uncertain_count(p);
  if (count == 0) return "";
  if (count > kListed)
    return fmt::format("           with values of the {} uncertain quantities that --json lists\n",
                       count);
  return fmt::format("           with {}\n", assignments(p, variables, false, short_text_of));
}

std::string format_pose(const PreparedSearch& p, std::span<const Interval> pose) {
  return pose_line_of(p, pose, value_text);
}

std::string format_short_pose(const PreparedSearch& p, std::span<const Interval> pose) {
  return pose_line_of(p, pose, short_interval);
}

std::string describe_size(const PreparedSearch& p) {
  return fmt::format("full {}×{} {}", p.labels.rows, p.labels.columns, name(p.labels.matrix_kind));
}

std::string format_matrix_notes(const PreparedSearch& p) {
  std::string lines;
  for (const std::string& note : p.labels.matrix_notes)
    lines += fmt::format("{:<11}{}\n", lines.empty() ? "matrix" : "", note);
  return lines;
}

const char* describe_pose(const PreparedSearch& p) {
  return p.labels.where == name(Where::kReachable) ? "reachable pose of the variety"
         : p.labels.where == name(Where::kWithinRanges)
             ? "pose of the variety with the actuated joints in range"
             : "pose of the variety";
}

std::string format_where(const PreparedSearch& p) {
  if (p.labels.where.empty()) return "";
  const bool ranges = p.labels.where == name(Where::kWithinRanges);
  return fmt::format("where      {}: poses out of reach{} are no part of the claim\n",
                     p.labels.where, ranges ? " and joints out of range" : "");
}

std::string format_question(const PreparedSearch& p) {
  return fmt::format("model      {}\nmotion     {}\n", p.labels.model, p.labels.motion) +
         format_variable(p, true) + format_where(p) + format_matrix_notes(p) + format_uncertain(p);
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

/// Returns an empty text for forms of full detail.
std::string format_detail(const PreparedSearch& p) {
  if (p.stopped)
    return fmt::format("forms      none: {} before the search\n",
                       p.stopped->interrupted ? "interrupted" : "the time limit was reached");
  if (p.labels.detail == FormDetail::kFull) return "";
  return fmt::format(
      "forms      {}: the model takes more terms than the budget for them; bounds may be wide\n",
      p.labels.detail == FormDetail::kSmallParts ? "of short parts only"
                                                 : "as the model writes them");
}

std::string format_method(const PreparedSearch& p, const SearchOptions& search, Method method,
                          std::uint64_t boxes) {
  const std::string line = fmt::format("method     {}{}, {}\n", name(method),
                                       describe_without(search), describe_engine(p, search, boxes));
  const std::string note = p.cache_note.empty() ? "" : fmt::format("           {}\n", p.cache_note);
  return line + note + format_detail(p);
}

std::string format_time(const StageSeconds& s) {
  return fmt::format(
      "time       model {:.1f} ms, symbolic {:.1f}, emit {:.1f}, compile {:.1f}, search {:.3f}\n",
      1e3 * s.model, 1e3 * s.symbolic, 1e3 * s.emit, 1e3 * s.compile, 1e3 * s.search);
}

Json json_forms(const PreparedSearch& p) {
  if (p.stopped) return nullptr;
  return json_name(p.labels.detail);
}

Json json_occupancy(const Result& result) {
  if (result.occupancy == Occupancy::kUnknown) return nullptr;
  return result.occupancy == Occupancy::kInhabited;
}

std::string format_occupancy(const Result& result) {
  if (result.verdict != Verdict::kNoSingularity || result.occupancy != Occupancy::kUnknown)
    return "";
  return "warning    no pose was found that satisfies the constraints: the claim may be about "
         "no pose\n";
}

}  // namespace regulus
