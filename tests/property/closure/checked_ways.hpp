// SPDX-License-Identifier: GPL-3.0-or-later
// Follows closures that tests write along way-points, and has the answers verified.
#pragma once

#include <fmt/format.h>

#include <vector>

#include "codegen/question/closure/closure_way_paving.hpp"
#include "codegen/question/closure/closure_way_report.hpp"
#include "tests/property/closure/checked_closures.hpp"

namespace regulus::detail::test {

/// A table of way-points in a folder of its own.
class WayFile {
 public:
  explicit WayFile(const std::string& table) { write(table); }
  void write(const std::string& table) const { std::ofstream(path()) << table; }
  [[nodiscard]] std::string path() const { return (folder_.path() / "way.csv").string(); }

 private:
  TemporaryDirectory folder_;
};

/// A table of the places of a crank.
inline std::string table_of(const std::vector<double>& places) {
  std::string text = "theta\n";
  for (const double place : places) text += fmt::format("{:.17g}\n", place);
  return text;
}

struct CheckedWay {
  PreparedWay prepared;
  WayFinding found;

  [[nodiscard]] Verdict verdict() const { return found.result.verdict; }
  [[nodiscard]] std::string claim() const { return describe_claim(prepared, found); }
};

/// Follows a model along a file.
inline CheckedWay check_way_text(const std::string& model, const std::string& file,
                                 const SearchOptions& search = usual_options()) {
  ModelOptions options;
  options.motion = "m";
  options.waypoints = file;
  CheckedWay checked{prepare_way(read_request(model, options), 0, search, {}), {}};
  checked.found = check_way(checked.prepared, search, {});
  return checked;
}

/// The options of a search that is not expected to end.
inline SearchOptions few_boxes() {
  SearchOptions search = usual_options();
  search.max_boxes = 2000;
  return search;
}

/// Returns the certificate; empty if nothing is proved.
inline std::string certified_way(const CheckedWay& checked) {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "certificate").string();
  const ProofStatus status = certify_way(path, checked.prepared, checked.found, {});
  std::ostringstream text;
  if (status.is_written()) text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Verifies a certificate, and compares it with a model and a file.
inline verifier::Verification verified_way(const std::string& certificate, const std::string& model,
                                           const std::string& file) {
  verifier::Options options;
  options.model_text = model;
  options.model_name = "model.toml";
  options.waypoints = file;
  std::istringstream stream(certificate);
  return verifier::verify(stream, options);
}

/// Encloses the unknowns on a piece at s, where the other variables are in their middles.
inline std::vector<Interval> unknowns_on(const CheckedWay& checked, std::size_t piece, double s) {
  const BranchTree& tree = checked.found.pieces.at(piece).branch.tree;
  std::vector<Interval> place{Interval(s)};
  for (std::size_t k = 1; k < checked.prepared.common.shape.variables; ++k)
    place.emplace_back(mid(checked.prepared.common.problem.outer[k]));
  const std::size_t leaf = tree.leaves_at(place).front();
  return enclose(*tree.leaves()[leaf].tube, place);
}

}  // namespace regulus::detail::test
