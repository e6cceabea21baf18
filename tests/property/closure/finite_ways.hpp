// SPDX-License-Identifier: GPL-3.0-or-later
// Finite errors along way-points, for tests.
#pragma once

#include <nlohmann/json.hpp>

#include "codegen/question/quantity/platform_closure.hpp"
#include "tests/property/closure/checked_way_values.hpp"
#include "tests/support/files.hpp"

namespace regulus::detail::test::finite_ways {

struct FiniteOnWay {
  std::string model;
  std::string file{};  ///< of way-points; empty: the motion of the model
  std::string freedom{};
  double gap = 0.05;
  std::string limit{}, certificate{};
};

inline ComponentBound finite_error(const FiniteOnWay& asked) {
  ModelOptions options;
  options.motion = "m";
  options.waypoints = asked.file;
  const Request read = read_request(asked.model, options);
  const Request request = read.model.closure ? read : closure_of_platform(read);
  QuantityOptions words = words_of("error");
  words.is_finite = true, words.freedom = asked.freedom;
  BoundSettings settings;
  settings.gap = asked.gap;
  settings.search = usual_options();
  settings.over_branch = bounds_over_branch();
  settings.certificate = asked.certificate;
  Quantity quantity = quantity_of(request.model, words);
  if (!asked.limit.empty()) settings.limit = read_limit(asked.limit, quantity);
  return bound_quantity(request, std::move(quantity), settings, [](const ComponentBound&) {})
      .components.front();
}

/// Both ends hold what was seen, and what was seen comes near them.
inline void expect_finite(const ComponentBound& found, double seen, double part = 0.95) {
  ASSERT_TRUE(found.proved && found.attained) << found.component.label << found.reason;
  EXPECT_TRUE(found.is_closed) << found.component.label << found.reason;
  EXPECT_LE(seen, found.proved->approx) << found.component.label;
  EXPECT_GE(seen, part * found.attained->approx) << found.component.label;
}

/// Two questions about one set of poses have one answer.
inline void expect_same(const ComponentBound& a, const ComponentBound& b) {
  ASSERT_TRUE(a.proved && a.attained && b.proved && b.attained) << a.reason << b.reason;
  EXPECT_TRUE(a.is_closed && b.is_closed) << a.reason << b.reason;
  EXPECT_LE(a.attained->approx, b.proved->approx);
  EXPECT_LE(b.attained->approx, a.proved->approx);
}

/// The middle of an interval of a report.
inline double middle_of(const nlohmann::ordered_json& interval) {
  return (interval.at(0).get<double>() + interval.at(1).get<double>()) / 2;
}

struct BothEnds {
  std::string safe, attained;
};

/// Bounds it, and has both ends verified with the model and the file.
inline BothEnds verified_ends(FiniteOnWay asked, std::size_t pieces) {
  const TemporaryDirectory directory;
  asked.certificate = (directory.path() / "end").string();
  const ComponentBound found = finite_error(asked);
  const BothEnds ends{file_contents(found.proofs.safe().file),
                      file_contents(found.proofs.singular().file)};
  for (const std::string* const text : {&ends.safe, &ends.attained}) {
    const verifier::Verification v = verified_way(*text, asked.model, asked.file);
    EXPECT_EQ(v.outcome, verifier::Outcome::kVerified) << describe(v) << text->substr(0, 3000);
    EXPECT_EQ(v.pieces, pieces);
    EXPECT_EQ(verified(*text).outcome, verifier::Outcome::kVerified);
  }
  return ends;
}

inline std::string with_other(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The numbers of the bound, in its line and in the claim.
inline std::string with_bound(std::string text, const std::string& other) {
  const std::size_t begin = text.find("\nbound ") + 7;
  const std::string number = text.substr(begin, text.find('\n', begin) - begin);
  for (std::size_t at = 0; (at = text.find(' ' + number, at)) < text.find("\nproof\n"); ++at)
    text.replace(at + 1, number.size(), other);
  return text;
}

/// The trees of a certificate in another order; `order` counts from 1.
inline std::string with_trees(const std::string& text, const std::vector<std::size_t>& order) {
  std::vector<std::string> parts;
  std::size_t at = 0;
  for (std::size_t next = text.find("\ntree\n"); next != std::string::npos;
       next = text.find("\ntree\n", at + 1)) {
    parts.push_back(text.substr(at, next - at));
    at = next;
  }
  parts.push_back(text.substr(at, text.rfind("\nend ") - at));
  std::string all = parts[0];
  for (const std::size_t k : order) all += parts.at(k);
  std::size_t leaves = 0;
  for (std::size_t l = all.find("\nl "); l != std::string::npos; l = all.find("\nl ", l + 1))
    ++leaves;
  return all + "\nend " + std::to_string(leaves) + '\n';
}

/// Neither verified with the file nor of itself.
inline void expect_refused(const std::string& text, const FiniteOnWay& asked,
                           const std::string& what) {
  EXPECT_NE(verified_way(text, asked.model, asked.file).outcome, verifier::Outcome::kVerified)
      << what;
  EXPECT_NE(verified(text).outcome, verifier::Outcome::kVerified) << what << ", of itself";
}

}  // namespace regulus::detail::test::finite_ways
