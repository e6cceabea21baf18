// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/witness_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "codegen/answer/report/degeneracy_report.hpp"
#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/question/analysis/lost_twist.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// Exhaustive searches do not refine the witness; for them the first point is reported.
const WitnessPoint& closest(const Witness& witness) {
  return witness.near ? *witness.near : witness.points.front();
}

std::vector<Interval> hull_of_points(const Witness& witness) {
  std::vector<Interval> box = witness.points.front().variables;
  for (std::size_t k = 0; k < box.size(); ++k)
    for (const WitnessPoint& point : witness.points) box[k] = hull(box[k], point.variables[k]);
  return box;
}

/// Returns the largest difference in any variable, without a claim.
double approx_distance(const Witness& witness) {
  double largest = 0;
  for (const Interval& range : hull_of_points(witness))
    largest = std::max(largest, range.hi - range.lo);
  return largest;
}

/// "= 3"; "in [1, 2]"; "≈ 2.5" for bounds that differ in later digits.
std::string describe_value(const Interval& x) {
  const std::string text = short_interval(x);
  return fmt::format("{} {}", x.lo == x.hi ? "=" : text.front() == '[' ? "in" : "≈", text);
}

/// True if the determinant of a witness is that of J⁻¹, not of the matrix as the model writes it.
bool has_row_scales(const SearchSubject& p, const Witness& witness) {
  return witness.points.size() != 2 && p.variety.alpha.hi > 0;
}

std::optional<double> approx_scale(const SearchSubject& p, const Witness& witness,
                                   const InverseJacobian& matrix) {
  if (p.labels.rows != p.labels.columns) return std::nullopt;
  return matrix.approx_hadamard(closest(witness).variables, has_row_scales(p, witness));
}

/// "pi/2", "-5*pi/12", "7/10"; requires a number.
std::string text_of(const ExactNumber& number) {
  const std::string divisor = number.denominator == 1 ? "" : fmt::format("/{}", number.denominator);
  if (number.of_pi == 0 || number.numerator == 0) return std::to_string(number.numerator) + divisor;
  if (number.numerator == 1) return "pi" + divisor;
  return number.numerator == -1 ? "-pi" + divisor
                                : fmt::format("{}*pi{}", number.numerator, divisor);
}

/// Returns the coordinates that are known exactly and need not be doubles, by variable.
Json json_exact(const SearchSubject& p, const WitnessPoint& point) {
  Json exact = Json::object();
  for (std::size_t k = 0; k < point.numbers.size(); ++k)
    if (point.numbers[k].denominator > 0)
      exact[p.labels.variables[k].name] = text_of(point.numbers[k]);
  return exact;
}

std::string describe_exact_values(const SearchSubject& p, const WitnessPoint& point) {
  std::string words;
  for (std::size_t k = 0; k < point.numbers.size(); ++k)
    if (point.numbers[k].denominator > 0)
      words += fmt::format("{}{} = {}", words.empty() ? "exactly " : ", ",
                           p.labels.variables[k].name, text_of(point.numbers[k]));
  return words;
}

double widest(std::span<const Interval> box) {
  double width = 0;
  for (const Interval& x : box) width = std::max(width, x.hi - x.lo);
  return width;
}

/// Returns the names of the variables whose values are enclosed, in their order.
std::vector<std::string> names_of_chosen(const SearchSubject& p, const WitnessPoint& point) {
  std::vector<std::string> names;
  for (const std::uint32_t k : point.chosen) names.push_back(p.labels.variables[k].name);
  return names;
}

void say_enclosure(const SearchSubject& p, const WitnessPoint& point, Facts& facts) {
  facts.say("", fmt::format("its rank is less than {} for some {} within {:.1g} of this",
                            p.labels.columns, fmt::join(names_of_chosen(p, point), ", "),
                            widest(point.variables)));
  facts.say("", "what is lost there is enclosed, too, by a test of existence");
}

void say_proof(const SearchSubject& p, const Witness& witness, const std::optional<double>& scale,
               Facts& facts) {
  if (!witness.points.front().null_vector.empty())
    return say_enclosure(p, witness.points.front(), facts);
  if (p.labels.rows != p.labels.columns) {
    facts.say("",
              fmt::format("its rank is less than {} there, by exact algebra", p.labels.columns));
    return;
  }
  facts.say(
      "", fmt::format("{} {} there{}", has_row_scales(p, witness) ? "det J⁻¹" : "determinant",
                      describe_value(closest(witness).determinant),
                      scale && *scale > 0
                          ? fmt::format("; rows of these lengths could have one of {:.2g}", *scale)
                          : ""));
  if (witness.points.size() == 2)
    facts.say("",
              fmt::format("it changes sign: {} and {} at points that differ by at most {:.2g}",
                          short_interval(witness.points[0].determinant),
                          short_interval(witness.points[1].determinant), approx_distance(witness)));
}

/// Tells the points of a witness, and for two of them the box between.
void add_points(const SearchSubject& p, const Witness& witness, const std::optional<double>& scale,
                Facts& facts) {
  Json points = Json::array();
  for (const WitnessPoint& point : witness.points) points.push_back(json_point(p, point));
  facts.add("points", points).add("approx_hadamard", or_null(scale));
  if (witness.points.size() != 2) return;
  const std::vector<Interval> box = hull_of_points(witness);
  facts.add("vanishes_within",
            {{"parameters", json_parameters(p, box)}, {"uncertain", json_uncertain(p, box)}});
}

}  // namespace

Json json_point(const SearchSubject& p, const WitnessPoint& point) {
  const bool has_determinant = p.labels.rows == p.labels.columns;
  Json report = {{"parameters", json_parameters(p, point.variables)},
                 {"pose", json_pose(p, point.pose)},
                 {"uncertain", json_uncertain(p, point.variables)},
                 {"determinant", has_determinant ? json_interval(point.determinant) : Json()}};
  if (!point.numbers.empty()) report["exact"] = json_exact(p, point);
  if (!point.null_vector.empty()) {
    report["enclosed"] = names_of_chosen(p, point);
    report["null_vector"] = Json::array();
    for (const Interval& x : point.null_vector) report["null_vector"].push_back(json_interval(x));
  }
  return report;
}

void tell_witness(const PreparedSearch& p, const Result& result, Facts& facts) {
  if (!result.witness) {
    facts.add("witness", nullptr);
    return;
  }
  const Witness& witness = *result.witness;
  const WitnessPoint& point = closest(witness);
  const InverseJacobian matrix(p);
  const std::optional<double> scale = approx_scale(p, witness, matrix);
  Facts told = facts.part();
  told.say("witness", describe_place(p, point.variables));
  told.say("", describe_exact_values(p, point)).say("", describe_pose_of(p, point.pose));
  told.say("", describe_uncertain_values(p, point.variables));
  say_proof(p, witness, scale, told);
  add_points(p, witness, scale, told);
  if (witness.near) {
    told.add("near", json_point(p, *witness.near));
    tell_degeneracy(p, matrix.approx_degeneracy(witness.near->variables), told);
  }
  facts.tell_part("witness", std::move(told));
}

void tell_nearest(const SearchSubject& p, const LeastSingular& nearest, Facts& facts) {
  Facts told = facts.part();
  told.add("approximate", true)
      .add("parameters", json_parameters(p, nearest.variables))
      .add("pose", json_pose(p, nearest.pose))
      .add("uncertain", json_uncertain(p, nearest.variables));
  told.say("nearest", describe_short_place(p, nearest.variables));
  told.say("", describe_short_pose(p, nearest.pose));
  told.say("", describe_uncertain_values(p, nearest.variables));
  const bool is_lost = !nearest.share && !nearest.degeneracy.twists.empty();
  if (nearest.share)
    told.tell("hadamard_share", *nearest.share, "",
              fmt::format("almost singular there: |det| of the balanced matrix is about {:.2g} of "
                          "what rows of these lengths could have",
                          *nearest.share));
  else
    told.say("", fmt::format("the least singular value met, about {:.2g} of the largest; this "
                             "proves nothing",
                             nearest.degeneracy.singular_values.back()));
  if (is_lost)
    told.say("", "a determinant or a rank that is touched there, and not crossed, stays open");
  // People read of no loss unless something is lost, and not where the matrix is only almost singular.
  Facts lost = is_lost ? told.part() : Facts(Readers::kPrograms);
  tell_degeneracy(p, nearest.degeneracy, lost);
  told.append(std::move(lost));
  facts.tell_part("nearest_singular", std::move(told));
}

}  // namespace regulus::detail
