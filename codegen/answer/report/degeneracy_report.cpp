// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/degeneracy_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <functional>

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;
using Kind = TwistComponent::Kind;

constexpr const char* kUnnamed = "the largest entry is 1";
constexpr const char* kPlatform = "angular velocity of norm 1; velocity of norm 1 if there is none";

Json json_columns(const SearchSubject& p) {
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

/// "(1, -0.5, 0) cm/s": the components of one kind.
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
                     unit.empty() || unit == "1" ? "" : " " + unit + "/s");
}

/// "1 (0.3), 4 (1)": the numbers or names that take part, with their weights.
std::string describe_weights(const std::vector<double>& weights,
                             const std::function<std::string(std::size_t)>& name) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (std::fabs(weights[i]) > kTakesPart)
      words.push_back(fmt::format("{} ({:.4g})", name(i), weights[i]));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string describe_row(const std::vector<double>& weights) {
  const std::string words =
      describe_weights(weights, [](std::size_t i) { return std::to_string(i + 1); });
  const bool is_one = words.find(',') == std::string::npos;
  return is_one ? words.substr(0, words.find(' ')) + " alone, which is 0" : words;
}

std::string describe_twist(const SearchSubject& p, const std::vector<double>& v) {
  const auto& components = p.labels.twist;
  if (!components.empty())
    return fmt::format("velocity {}, angular velocity {}", part_words(v, components, Kind::kLinear),
                       part_words(v, components, Kind::kAngular));
  if (p.labels.matrix_kind == MatrixKind::kForward && p.labels.pose.size() == v.size())
    return describe_weights(v, [&p](std::size_t i) { return p.labels.pose[i].name; });
  std::vector<std::string> numbers;
  for (const double x : v) numbers.push_back(fmt::format("{:.4g}", x));
  return fmt::format("({}), an entry for each column", fmt::join(numbers, ", "));
}

template <class Words>
void say_vectors(const std::string& label, std::string before,
                 const std::vector<std::vector<double>>& vectors, Words words, Facts& facts) {
  for (const auto& v : vectors) {
    before += words(v);
    if (&v != &vectors.back()) before += "\nand ";
  }
  facts.say(label, std::move(before));
}

/// Returns what a vector in the kernel of the matrix is: the label, and how the sentence begins.
std::pair<const char*, const char*> kernel_words(MatrixKind kind) {
  switch (kind) {
    case MatrixKind::kInverse:
      return {"twist", "lost, approximately: "};
    case MatrixKind::kForward:
      return {"speeds", "of joints that leave the tool at rest, approximately: "};
    case MatrixKind::kForwardTransposed:
      return {"wrench", "that no joint carries, approximately: "};
  }
  return {};
}

std::string describe_space(std::size_t dimension) {
  return dimension == 1 ? "" : fmt::format("a space of dimension {}, spanned by ", dimension);
}

void say_nothing_lost(const SearchSubject& p, const Degeneracy& degeneracy, Facts& facts) {
  const bool is_twist = p.labels.matrix_kind == MatrixKind::kInverse;
  facts.say(is_twist ? "twist" : "rank",
            fmt::format("no {} is lost there: the least singular value is {:.2g} of the largest",
                        is_twist ? "twist" : "rank", degeneracy.singular_values.back()));
}

void tell_rows(const Degeneracy& degeneracy, Facts& facts) {
  if (degeneracy.rows.empty()) {
    facts.add("rows", nullptr);
    return;
  }
  facts.add("rows", {{"approximate", true},
                     {"taking_part", rows_taking_part(degeneracy)},
                     {"threshold", kTakesPart},
                     {"vectors", degeneracy.rows}});
  if (!degeneracy.twists.empty())
    say_vectors("rows", "dependent, approximately, with weights: ", degeneracy.rows, describe_row,
                facts);
}

}  // namespace

void tell_degeneracy(const SearchSubject& p, const std::optional<Degeneracy>& degeneracy,
                     Facts& facts) {
  if (!degeneracy) {
    for (const char* key : {"nullity", "singular_values", "twist", "rows"}) facts.add(key, nullptr);
    return;
  }
  const std::size_t nullity = degeneracy->twists.size();
  facts.add("nullity", nullity).add("singular_values", degeneracy->singular_values);
  facts.add("twist", nullptr);
  if (nullity == 0) {
    say_nothing_lost(p, *degeneracy, facts);
  } else {
    facts.add("twist", {{"approximate", true},
                        {"columns", json_columns(p)},
                        {"normalised", p.labels.twist.empty() ? kUnnamed : kPlatform},
                        {"vectors", degeneracy->twists}});
    const auto [label, begin] = kernel_words(p.labels.matrix_kind);
    say_vectors(
        label, begin + describe_space(nullity), degeneracy->twists,
        [&p](const auto& v) { return describe_twist(p, v); }, facts);
  }
  tell_rows(*degeneracy, facts);
}

}  // namespace regulus::detail
