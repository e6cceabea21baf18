// SPDX-License-Identifier: GPL-3.0-or-later
#include "regulus/codegen/driver/witness_report.hpp"

#include <fmt/format.h>

#include "regulus/codegen/driver/degeneracy_report.hpp"
#include "regulus/codegen/driver/lost_twist.hpp"
#include "regulus/codegen/driver/report_parts.hpp"

namespace regulus::codegen {
namespace {

using Json = nlohmann::ordered_json;

/// Exhaustive searches stay away from the zero: there the first point stands for the proof.
const WitnessPoint& closest(const Witness& witness) {
  return witness.near ? *witness.near : witness.points.front();
}

std::vector<Interval> hull_of_points(const Witness& witness) {
  std::vector<Interval> box = witness.points.front().variables;
  for (std::size_t k = 0; k < box.size(); ++k)
    for (const WitnessPoint& point : witness.points) box[k] = hull(box[k], point.variables[k]);
  return box;
}

/// The largest difference in any variable; nothing is claimed of it.
double approx_distance(const Witness& witness) {
  double largest = 0;
  for (const Interval& range : hull_of_points(witness))
    largest = std::max(largest, range.hi - range.lo);
  return largest;
}

/// "= 3"; "in [1, 2]"; "≈ 2.5" for bounds that differ in later digits.
std::string value_words(const Interval& x) {
  const std::string text = short_interval(x);
  return fmt::format("{} {}", x.lo == x.hi ? "=" : text.front() == '[' ? "in" : "≈", text);
}

std::string proof_lines(const Preparation& p, const Witness& witness) {
  const WitnessPoint& point = closest(witness);
  const bool crossed = witness.points.size() == 2;
  const bool scaled = !crossed && p.variety.alpha.hi > 0;
  const std::string line =
      fmt::format("           {} {} there\n", scaled ? "det J⁻¹" : "determinant",
                  value_words(point.determinant));
  if (!crossed) return line;
  return line +
         fmt::format(
             "           it changes sign: {} and {} at points that differ by at most {:.2g}\n",
             short_interval(witness.points[0].determinant),
             short_interval(witness.points[1].determinant), approx_distance(witness));
}

}  // namespace

Json json_point(const Preparation& p, const WitnessPoint& point) {
  return {{"parameters", json_parameters(p, point.variables)},
          {"pose", json_pose(p, point.pose)},
          {"uncertain", json_uncertain(p, point.variables)},
          {"determinant", json_interval(point.determinant)}};
}

Json json_witness(const Preparation& p, const Result& result) {
  if (!result.witness) return nullptr;
  const Witness& witness = *result.witness;
  Json points = Json::array();
  for (const WitnessPoint& point : witness.points) points.push_back(json_point(p, point));
  Json report = {{"points", points}};
  if (witness.points.size() == 2) {
    const std::vector<Interval> box = hull_of_points(witness);
    report["vanishes_within"] = {{"parameters", json_parameters(p, box)},
                                 {"uncertain", json_uncertain(p, box)}};
  }
  if (!witness.near) return report;
  report["near"] = json_point(p, *witness.near);
  report.update(json_degeneracy(p, InverseJacobian(p).approx_degeneracy(witness.near->variables)));
  return report;
}

std::string witness_lines(const Preparation& p, const Result& result) {
  if (!result.witness) return "";
  const Witness& witness = *result.witness;
  const WitnessPoint& point = closest(witness);
  std::string lines = fmt::format("witness    {}\n", place_words(p, point.variables)) +
                      pose_line(p, point.pose) + uncertain_values_line(p, point.variables) +
                      proof_lines(p, witness);
  if (!witness.near) return lines;
  return lines + degeneracy_lines(p, InverseJacobian(p).approx_degeneracy(point.variables));
}

Json json_nearest(const Preparation& p, const LeastSingular& nearest) {
  Json report = {{"approximate", true},
                 {"parameters", json_parameters(p, nearest.variables)},
                 {"pose", json_pose(p, nearest.pose)},
                 {"uncertain", json_uncertain(p, nearest.variables)}};
  report.update(json_degeneracy(p, nearest.degeneracy));
  return report;
}

std::string nearest_lines(const Preparation& p, const std::optional<LeastSingular>& nearest) {
  if (!nearest) return "";
  const std::string lines =
      fmt::format("nearest    {}\n", short_place_words(p, nearest->variables)) +
      short_pose_line(p, nearest->pose) + uncertain_values_line(p, nearest->variables) +
      fmt::format(
          "           the least singular value met, about {:.2g} of the largest; this proves "
          "nothing\n",
          nearest->degeneracy.singular_values.back());
  return nearest->degeneracy.twists.empty() ? lines
                                            : lines + degeneracy_lines(p, nearest->degeneracy);
}

}  // namespace regulus::codegen
