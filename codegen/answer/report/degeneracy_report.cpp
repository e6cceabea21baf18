// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/degeneracy_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace regulus {
namespace {

using Json = nlohmann::ordered_json;
using Kind = TwistComponent::Kind;

constexpr const char* kUnnamed = "the largest entry is 1";
constexpr const char* kPlatform = "angular velocity of norm 1; velocity of norm 1 if there is none";

Json json_columns(const PreparedSearch& p) {
  Json columns = Json::array();
  const auto& components = p.labels.twist;
  for (int j = 0; j < p.labels.columns; ++j) {
    if (components.empty())
      columns.push_back({{"column", j + 1}});
    else
      columns.push_back({{"column", j + 1},
                         {"name", components[std::size_t(j)].name},
                         {"unit", components[std::size_t(j)].unit}});
  }
  return columns;
}

/// "(1, -0.5, 0) cm": the components of one kind.
std::string part_words(const std::vector<double>& v, const std::vector<TwistComponent>& components,
                       Kind kind) {
  std::vector<std::string> numbers;
  std::string unit;
  for (std::size_t j = 0; j < v.size(); ++j) {
    if (components[j].kind != kind) continue;
    numbers.push_back(fmt::format("{:.4g}", v[j]));
    unit = components[j].unit;
  }
  return fmt::format("({}){}", fmt::join(numbers, ", "),
                     unit.empty() || unit == "1" ? "" : " " + unit);
}

std::string describe_twist(const PreparedSearch& p, const std::vector<double>& v) {
  const auto& components = p.labels.twist;
  if (!components.empty())
    return fmt::format("velocity {}, angular velocity {}", part_words(v, components, Kind::kLinear),
                       part_words(v, components, Kind::kAngular));
  std::vector<std::string> numbers;
  for (const double x : v) numbers.push_back(fmt::format("{:.4g}", x));
  return fmt::format("({}), an entry for each column", fmt::join(numbers, ", "));
}

/// "1 (0.3), 4 (1)": the rows that take part with their weights.
std::string describe_row(const std::vector<double>& weights) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (std::fabs(weights[i]) > kTakesPart)
      words.push_back(fmt::format("{} ({:.4g})", i + 1, weights[i]));
  return fmt::format("{}", fmt::join(words, ", "));
}

template <class Words>
std::string format_vector(std::string line, const std::vector<std::vector<double>>& vectors,
                          Words words) {
  for (const auto& v : vectors) {
    line += words(v) + '\n';
    if (&v != &vectors.back()) line += "           and ";
  }
  return line;
}

/// Returns what a vector in the kernel of the matrix is.
const char* describe_kernel(MatrixKind kind) {
  switch (kind) {
    case MatrixKind::kInverse:
      return "twist      lost, approximately: ";
    case MatrixKind::kForward:
      return "speeds     of joints that leave the tool at rest, approximately: ";
    case MatrixKind::kForwardTransposed:
      return "wrench     that no joint carries, approximately: ";
  }
  return "";
}

std::string describe_space(std::size_t dimension) {
  return dimension == 1 ? "" : fmt::format("a space of dimension {}, spanned by ", dimension);
}

}  // namespace

Json json_degeneracy(const PreparedSearch& p, const std::optional<Degeneracy>& degeneracy) {
  if (!degeneracy)
    return {
        {"nullity", nullptr}, {"singular_values", nullptr}, {"twist", nullptr}, {"rows", nullptr}};
  Json object = {{"nullity", degeneracy->twists.size()},
                 {"singular_values", degeneracy->singular_values},
                 {"twist", nullptr},
                 {"rows", nullptr}};
  if (!degeneracy->twists.empty())
    object["twist"] = {{"approximate", true},
                       {"columns", json_columns(p)},
                       {"normalised", p.labels.twist.empty() ? kUnnamed : kPlatform},
                       {"vectors", degeneracy->twists}};
  if (!degeneracy->rows.empty())
    object["rows"] = {{"approximate", true},
                      {"taking_part", rows_taking_part(*degeneracy)},
                      {"threshold", kTakesPart},
                      {"vectors", degeneracy->rows}};
  return object;
}

std::string format_degeneracy(const PreparedSearch& p,
                              const std::optional<Degeneracy>& degeneracy) {
  if (!degeneracy) return "";
  const std::size_t nullity = degeneracy->twists.size();
  if (nullity == 0)
    return fmt::format("{} there: the least singular value is {:.2g} of the largest\n",
                       p.labels.matrix_kind == MatrixKind::kInverse ? "twist      no twist is lost"
                                                                    : "rank       no rank is lost",
                       degeneracy->singular_values.back());
  std::string lines =
      format_vector(describe_kernel(p.labels.matrix_kind) + describe_space(nullity),
                    degeneracy->twists, [&p](const auto& v) { return describe_twist(p, v); });
  if (!degeneracy->rows.empty())
    lines += format_vector("rows       dependent, approximately, with weights: ", degeneracy->rows,
                           describe_row);
  return lines;
}

}  // namespace regulus
