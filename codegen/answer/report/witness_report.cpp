// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/witness_report.hpp"

#include <fmt/format.h>

#include "codegen/answer/report/degeneracy_report.hpp"
#include "codegen/answer/report/report_parts.hpp"
#include "codegen/question/analysis/lost_twist.hpp"

namespace regulus {
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
bool has_row_scales(const PreparedSearch& p, const Witness& witness) {
  return witness.points.size() != 2 && p.variety.alpha.hi > 0;
}

std::optional<double> approx_scale(const PreparedSearch& p, const Witness& witness,
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
Json json_exact(const PreparedSearch& p, const WitnessPoint& point) {
  Json exact = Json::object();
  for (std::size_t k = 0; k < point.numbers.size(); ++k)
    if (point.numbers[k].denominator > 0)
      exact[p.labels.variables[k].name] = text_of(point.numbers[k]);
  return exact;
}

std::string format_exact_values(const PreparedSearch& p, const WitnessPoint& point) {
  std::string words;
  for (std::size_t k = 0; k < point.numbers.size(); ++k)
    if (point.numbers[k].denominator > 0)
      words += fmt::format("{}{} = {}", words.empty() ? "" : ", ", p.labels.variables[k].name,
                           text_of(point.numbers[k]));
  return words.empty() ? words : fmt::format("           exactly {}\n", words);
}

std::string format_lost_rank(const PreparedSearch& p) {
  return fmt::format("           its rank is less than {} there, by exact algebra\n",
                     p.labels.columns);
}

std::string format_proof(const PreparedSearch& p, const Witness& witness,
                         const InverseJacobian& matrix) {
  const WitnessPoint& point = closest(witness);
  if (p.labels.rows != p.labels.columns) return format_lost_rank(p);
  const bool crossed = witness.points.size() == 2;
  const std::optional<double> scale = approx_scale(p, witness, matrix);
  const std::string line = fmt::format(
      "           {} {} there{}\n", has_row_scales(p, witness) ? "det J⁻¹" : "determinant",
      describe_value(point.determinant),
      scale ? fmt::format("; rows of these lengths allow {:.2g} (Hadamard)", *scale) : "");
  if (!crossed) return line;
  return line +
         fmt::format(
             "           it changes sign: {} and {} at points that differ by at most {:.2g}\n",
             short_interval(witness.points[0].determinant),
             short_interval(witness.points[1].determinant), approx_distance(witness));
}

}  // namespace

Json json_point(const PreparedSearch& p, const WitnessPoint& point) {
  const bool has_determinant = p.labels.rows == p.labels.columns;
  Json report = {{"parameters", json_parameters(p, point.variables)},
                 {"pose", json_pose(p, point.pose)},
                 {"uncertain", json_uncertain(p, point.variables)},
                 {"determinant", has_determinant ? json_interval(point.determinant) : Json()}};
  if (!point.numbers.empty()) report["exact"] = json_exact(p, point);
  return report;
}

Json json_witness(const PreparedSearch& p, const Result& result) {
  if (!result.witness) return nullptr;
  const Witness& witness = *result.witness;
  Json points = Json::array();
  for (const WitnessPoint& point : witness.points) points.push_back(json_point(p, point));
  Json report = {{"points", points}};
  const InverseJacobian matrix(p);
  const std::optional<double> scale = approx_scale(p, witness, matrix);
  report["approx_hadamard"] = scale ? Json(*scale) : Json(nullptr);
  if (witness.points.size() == 2) {
    const std::vector<Interval> box = hull_of_points(witness);
    report["vanishes_within"] = {{"parameters", json_parameters(p, box)},
                                 {"uncertain", json_uncertain(p, box)}};
  }
  if (!witness.near) return report;
  report["near"] = json_point(p, *witness.near);
  report.update(json_degeneracy(p, matrix.approx_degeneracy(witness.near->variables)));
  return report;
}

std::string format_witness(const PreparedSearch& p, const Result& result) {
  if (!result.witness) return "";
  const Witness& witness = *result.witness;
  const WitnessPoint& point = closest(witness);
  const InverseJacobian matrix(p);
  std::string lines = fmt::format("witness    {}\n", describe_place(p, point.variables)) +
                      format_exact_values(p, point) + format_pose(p, point.pose) +
                      format_uncertain_values(p, point.variables) +
                      format_proof(p, witness, matrix);
  if (!witness.near) return lines;
  return lines + format_degeneracy(p, matrix.approx_degeneracy(point.variables));
}

Json json_nearest(const PreparedSearch& p, const LeastSingular& nearest) {
  Json report = {{"approximate", true},
                 {"parameters", json_parameters(p, nearest.variables)},
                 {"pose", json_pose(p, nearest.pose)},
                 {"uncertain", json_uncertain(p, nearest.variables)}};
  if (nearest.share) report["hadamard_share"] = *nearest.share;
  report.update(json_degeneracy(p, nearest.degeneracy));
  return report;
}

std::string format_nearest(const PreparedSearch& p, const std::optional<LeastSingular>& nearest) {
  if (!nearest) return "";
  const std::string place =
      fmt::format("nearest    {}\n", describe_short_place(p, nearest->variables)) +
      format_short_pose(p, nearest->pose) + format_uncertain_values(p, nearest->variables);
  if (nearest->share)
    return place + fmt::format(
                       "           almost singular there: |det| of the balanced matrix is about "
                       "{:.2g} of what its "
                       "rows allow (Hadamard)\n",
                       *nearest->share);
  const std::string lines =
      place +
      fmt::format(
          "           the least singular value met, about {:.2g} of the largest; this proves "
          "nothing\n",
          nearest->degeneracy.singular_values.back());
  return nearest->degeneracy.twists.empty() ? lines
                                            : lines + format_degeneracy(p, nearest->degeneracy);
}

}  // namespace regulus
