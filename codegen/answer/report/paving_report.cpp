// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/report/paving_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/plain_words.hpp"
#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/answer/report/undefined_report.hpp"
#include "codegen/answer/report/witness_report.hpp"
#include "codegen/question/analysis/undefined.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormatVersion = 1;
constexpr std::array kEveryClaim{Claim::kFree, Claim::kSingular, Claim::kUndecided, Claim::kOutside,
                                 Claim::kUnreachable};

/// Returns the noun that the claims of boxes are about, up to what is claimed of its rank.
std::string matrix_of(const SearchSubject& p) {
  return p.labels.is_branch ? fmt::format("{}×{} matrix of the equations' derivatives",
                                          p.labels.rows, p.labels.columns)
                            : describe_size(p);
}

std::string name_of_determinant(const SearchSubject& p) {
  return p.labels.is_branch ? "|det| of its " + matrix_of(p) : "|det J⁻¹|";
}

/// Returns what is claimed of every pose of a free box.
std::string describe_free(const SearchSubject& p) {
  const bool threshold = p.variety.alpha.hi > 0;
  const std::string exceeds =
      fmt::format("{} > {}", name_of_determinant(p), threshold_text(p.variety.alpha, true));
  if (p.labels.is_branch)
    return fmt::format("the branch has exactly one configuration, and {},",
                       threshold ? exceeds : fmt::format("its {} has full rank", matrix_of(p)));
  return threshold ? exceeds : fmt::format("the {} has full rank", matrix_of(p));
}

/// Returns the claim of a box of that kind, for every value of the uncertain quantities or for
/// some.
std::string describe_claim(const SearchSubject& p, Claim claim) {
  const bool threshold = p.variety.alpha.hi > 0;
  const bool uncertain = uncertain_count(p) > 0;
  const char* poses = p.labels.constraints > p.labels.reach
                          ? "pose of the box that meets the constraints"
                      : p.labels.reach > 0 ? "pose of the box that the robot reaches"
                                           : "pose of the box";
  switch (claim) {
    case Claim::kFree:
      return fmt::format("{} at every {}{}", describe_free(p), poses,
                         uncertain ? ", for every value of the uncertain quantities" : "");
    case Claim::kSingular:
      return fmt::format("{} at some {}{}",
                         threshold ? fmt::format("{} ≤ {}", name_of_determinant(p),
                                                 threshold_text(p.variety.alpha, false))
                                   : fmt::format("the {} is singular", matrix_of(p)),
                         poses, uncertain ? ", for some value of the uncertain quantities" : "");
    case Claim::kUndecided:
      return "neither was shown";
    case Claim::kOutside:
      return "a constraint excludes every pose of the box";
    case Claim::kUnreachable:
      return "the robot reaches no pose of the box: a root is negative";
  }
  return "";
}

/// Returns "cm^2*rad", for example; "1" if no range has a unit.
std::string volume_unit(const SearchSubject& p, const std::vector<std::size_t>& axes) {
  std::map<std::string, int> powers;
  for (const std::size_t k : axes) {
    const std::string& unit = p.labels.variables[k].unit;
    if (!unit_suffix(unit).empty()) ++powers[unit];
  }
  std::string text;
  for (const auto& [unit, power] : powers)
    text += fmt::format("{}{}{}", text.empty() ? "" : "*", unit,
                        power > 1 ? fmt::format("^{}", power) : "");
  return text.empty() ? "1" : text;
}

Json json_ranges(const SearchSubject& p) {
  Json ranges = Json::array();
  for (std::size_t k = 0; k < p.labels.variables.size(); ++k) {
    const VariableLabel& variable = p.labels.variables[k];
    if (is_motion(variable))
      ranges.push_back({{"name", variable.name},
                        {"unit", variable.unit},
                        {"range", json_interval(p.variety.outer[k])}});
  }
  return ranges;
}

Json json_share(const Volumes& volumes, const Share& share) {
  return {{"boxes", share.boxes},
          {"volume", json_interval(share.volume)},
          {"fraction", json_interval(volumes.fraction(share))}};
}

std::uint64_t all_boxes(const Volumes& volumes) {
  std::uint64_t boxes = 0;
  for (const Claim claim : kEveryClaim) boxes += volumes.of(claim).boxes;
  return boxes;
}

std::string boxes_of(const Share& share) { return counted(share.boxes, "box", "boxes"); }

void tell_share(const Volumes& volumes, Claim claim, bool is_shown, Facts& facts) {
  const Share& share = volumes.of(claim);
  facts.add(name(claim), json_share(volumes, share));
  if (!is_shown) return;
  const bool beyond = claim == Claim::kUnreachable;
  facts.say(beyond ? "outside" : name(claim),
            fmt::format("{}, {}{}", percentage(volumes, share), boxes_of(share),
                        beyond ? ", out of reach" : ""));
}

Json json_workspace(const Volumes& volumes) {
  if (!volumes.workspace()) return nullptr;
  const Workspace& workspace = *volumes.workspace();
  return {{"fraction", json_interval(volumes.workspace_fraction())},
          {"inside", json_share(volumes, workspace.inside)},
          {"outside", json_share(volumes, workspace.outside)},
          {"undecided", json_share(volumes, workspace.undecided)}};
}

/// People read nothing if all poses meet the constraints.
void tell_workspace(const SearchSubject& p, const Volumes& volumes, Facts& facts) {
  facts.add("workspace", json_workspace(volumes));
  const auto& workspace = volumes.workspace();
  if (!workspace || workspace->outside.boxes + workspace->undecided.boxes == 0) return;
  const Interval part = volumes.workspace_fraction();
  facts.say("workspace",
            fmt::format("{:.2f} to {:.2f} % of the ranges {}", std::floor(1e4 * part.lo) / 100,
                        std::ceil(1e4 * part.hi) / 100,
                        p.labels.constraints > p.labels.reach ? "meet the constraints"
                                                              : "are within reach"));
}

void tell_volumes(const SearchSubject& p, const Volumes& volumes, const Result& result,
                  Facts& facts) {
  facts.add("volume", json_interval(volumes.total()));
  for (const Claim claim : kEveryClaim)
    tell_share(volumes, claim,
               (claim != Claim::kOutside || p.labels.constraints > p.labels.reach) &&
                   (claim != Claim::kUnreachable || p.labels.reach > 0),
               facts);
  facts.add("unfinished", json_share(volumes, volumes.unfinished()));
  tell_workspace(p, volumes, facts);
  facts.add("stopped_by", nullptr);
  if (result.stopped_by)
    facts.tell(
        "stopped_by", describe(*result.stopped_by), "stopped",
        fmt::format("{}: {}, {}, not searched, undecided", describe(*result.stopped_by),
                    boxes_of(volumes.unfinished()), percentage(volumes, volumes.unfinished())));
}

/// Algebra looks for a singular pose after the ranges were divided. It cannot decide boxes any more.
void say_box_of_witness(const Volumes& volumes, const Result& result, Facts& facts) {
  if (result.verdict != Verdict::kSingularity || volumes.of(Claim::kSingular).boxes > 0) return;
  facts.say("note",
            result.reason == Reason::kAlwaysSingular
                ? "algebra showed this after the ranges had been divided, so the boxes stay "
                  "undecided"
                : "algebra proved the witness after the ranges had been divided, so its box "
                  "stays undecided");
}

void tell_claims(const SearchSubject& p, Facts& facts) {
  tell_meaning_of_parts(p, "box", facts);
  const std::string free = "free: " + describe_claim(p, Claim::kFree);
  const std::string singular = "singular: " + describe_claim(p, Claim::kSingular);
  facts.tell("claim", free + "; " + singular, "claim", free + '\n' + singular);
}

}  // namespace

Json json_paving_header(const SearchSubject& p, const PavingOptions& options) {
  Json claims = Json::object();
  for (const Claim claim : kEveryClaim) claims[name(claim)] = describe_claim(p, claim);
  Json header = {{"regulus_paving", kFormatVersion},
                 {"model", p.labels.model},
                 {"model_sha256", p.labels.model_sha256},
                 {"motion", p.labels.motion},
                 {"parameters", json_ranges(p)},
                 {"uncertain", json_uncertain(p, p.variety.outer)},
                 {"where", p.labels.where},
                 {"constraints", p.labels.constraints - p.labels.reach},
                 {"alpha", mid(p.variety.alpha)},
                 {"alpha_enclosure", json_interval(p.variety.alpha)},
                 {"resolution", options.resolution},
                 {"claims", claims}};
  if (options.encloses_determinants)
    header["determinant_of"] = p.variety.alpha.hi > 0 ? "J⁻¹" : "the matrix as the model writes it";
  return header;
}

void tell_paving(const PreparedSearch& p, const Request& asked, const SearchOptions& search,
                 const PavingOptions& options, const Volumes& volumes, const Result& result,
                 Facts& facts) {
  facts.add("verdict", json_name(result.verdict)).add("reason", describe(result.reason));
  tell_question(p, asked, facts);
  if (facts.are_for_programs())
    add_search(search, p.labels.is_branch ? json_question(asked, search) : json_question(p, search),
               facts);
  tell_method(p, search, result.method, result.statistics.boxes, facts);
  facts.add("resolution", options.resolution).add("unit", volume_unit(p, options.axes));
  if (!options.axes.empty())
    facts.say("resolution", fmt::format("1/{:g} of each range", 1 / options.resolution));
  tell_boxes(result.statistics, facts);
  tell_time(p.seconds_spent(), facts);
  tell_volumes(p, volumes, result, facts);
  tell_witness(p, result, facts);
  say_box_of_witness(volumes, result, facts);
  if (result.reason == Reason::kUndefined)
    tell_undefined(p, find_undefined(p, result.blocking_box), facts);
  tell_occupancy(result, facts);
  tell_claims(p, facts);
}

std::string percentage(const Volumes& volumes, const Share& share) {
  const Interval part = volumes.fraction(share);
  if (share.boxes == 0) return "0 %";
  if (share.boxes == all_boxes(volumes)) return "100 %";
  const double percent = 100 * mid(part);
  if (percent < 0.005) return "< 0.01 %";
  if (percent > 99.995) return "> 99.99 %";
  return fmt::format("{:.2f} %", percent);
}

}  // namespace regulus::detail
