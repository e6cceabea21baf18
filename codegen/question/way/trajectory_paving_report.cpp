// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/place_text.hpp"
#include "codegen/answer/report/plain_words.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/answer/report/witness_report.hpp"
#include "codegen/question/way/trajectory_paving.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostLines = 40;

const char* word_of_claim(Claim claim) noexcept { return name(claim); }

constexpr std::array kClaimsInOrder = {Claim::kFree, Claim::kSingular, Claim::kUndecided,
                                       Claim::kOutside, Claim::kUnreachable};

const Trajectory& trajectory_of(const PathPaving& paving) {
  return *paving.check.request.motion.trajectory;
}

bool has_reason(const PathStretch& stretch) {
  return stretch.claim == Claim::kUndecided && stretch.reason != Reason::kAllBoxesCertified;
}

/// "segments 3 to 117, t from 0.02 to 1.1632 s"
std::string describe_stretch(const Trajectory& t, const PathStretch& stretch) {
  const std::size_t first = stretch.begin.piece, last = stretch.end.piece;
  std::string text = first == last ? fmt::format("segment {}", first + 1)
                                   : fmt::format("segments {} to {}", first + 1, last + 1);
  if (t.has_time)
    text += fmt::format(", t from {:.6g} to {:.6g}{}", approx_time_at(t, stretch.begin),
                        approx_time_at(t, stretch.end), unit_suffix(t.time_unit));
  else if (stretch.begin.s > 0 || stretch.end.s < 1)
    text += fmt::format(", from {:.4g} of its way to {:.4g} of its way", stretch.begin.s,
                        stretch.end.s);
  text += fmt::format(" (lines {} to {})", t.pieces[first].first_line, t.pieces[last].last_line);
  if (has_reason(stretch)) text += fmt::format(": {}", describe(stretch.reason));
  return text;
}

/// "100 %" and "0 %" only for all and nothing.
std::string percentage(double share) {
  if (share <= 0 || share >= 1) return share <= 0 ? "0 %" : "100 %";
  return fmt::format("{:.3g} %", std::clamp(100 * share, 0.001, 99.9));
}

/// Tells what the kinds of stretches claim.
void tell_claims(const PathPaving& paving, Facts& facts) {
  const PreparedSearch& p = paving.check.hull;
  const Interval& alpha = p.variety.alpha;
  const std::string size = describe_size(p), poses = describe_poses_on_way(paving.check);
  const bool is_uncertain = uncertain_count(p) > 0;
  const std::string free =
      fmt::format("free: {} at every {} of the stretch{}",
                  alpha.hi > 0 ? "|det J⁻¹| > " + threshold_text(alpha, true)
                               : fmt::format("the {} has full rank", size),
                  poses, is_uncertain ? ", for every value of the uncertain quantities" : "");
  const std::string singular =
      fmt::format("singular: {} at some {} of the stretch{}",
                  alpha.hi > 0 ? "|det J⁻¹| ≤ " + threshold_text(alpha, false)
                               : fmt::format("the {} is singular", size),
                  poses, is_uncertain ? ", for some value of the uncertain quantities" : "");
  tell_meaning_of_parts(p, "stretch", facts);
  facts.tell("claim", free + "; " + singular, "claim", free + '\n' + singular);
}

/// Tells the pose of the first piece that was shown to be singular.
void tell_singular_pose(const PathPaving& paving, Facts& facts) {
  facts.add("segment", nullptr).add("witness", nullptr);
  if (!paving.singular) return;
  const DecidingPiece& piece = *paving.singular;
  const Trajectory& t = trajectory_of(paving);
  const std::optional<Interval> s = parameter_of(piece);
  facts.tell("segment", json_segment(t, piece.index, s), "pose",
             "singular in " + describe_segment(t, piece.index, s));
  tell_witness(*piece.preparation, piece.result, facts);
}

}  // namespace

void tell_stretches(const Trajectory& trajectory, const std::vector<PathStretch>& stretches,
                    std::span<const Claim> claims, ClaimWord word, Facts& facts) {
  facts.add("stretches", stretches.size());
  for (std::size_t i = 0; i < std::min(stretches.size(), kMostLines); ++i)
    facts.say(word(stretches[i].claim), describe_stretch(trajectory, stretches[i]));
  if (stretches.size() > kMostLines)
    facts.say("", fmt::format("and {} stretches more; --output FILE has all of them",
                              stretches.size() - kMostLines));
  Json shares = Json::object();
  std::string words;
  for (const Claim claim : claims) {
    const double share = approx_share_of(trajectory, stretches, claim);
    shares[word(claim)] = share;
    if (share > 0)
      words += fmt::format("{}{} {}", words.empty() ? "" : ", ", word(claim), percentage(share));
  }
  facts.tell("share", std::move(shares), "share",
             fmt::format("{} of the {}", words, trajectory.has_time ? "time" : "segments"));
}

void tell_path_paving(const PathPaving& paving, const SearchOptions& search, Facts& facts) {
  facts.add("verdict", json_name(paving.check.verdict));
  facts.add("reason", describe(paving.check.reason));
  tell_trajectory_question(paving.check, search, facts);
  facts.add("resolution", paving.resolution);
  tell_stretches(trajectory_of(paving), paving.stretches, kClaimsInOrder, word_of_claim, facts);
  tell_singular_pose(paving, facts);
  tell_claims(paving, facts);
}

Json json_stretch_of(const Trajectory& t, const PathStretch& stretch, ClaimWord word) {
  Json line{
      {"kind", word(stretch.claim)},
      {"segments", {stretch.begin.piece + 1, stretch.end.piece + 1}},
      {"s", {stretch.begin.s, stretch.end.s}},
      {"lines", {t.pieces[stretch.begin.piece].first_line, t.pieces[stretch.end.piece].last_line}}};
  if (t.has_time) line["time"] = {approx_time_at(t, stretch.begin), approx_time_at(t, stretch.end)};
  if (has_reason(stretch)) line["reason"] = describe(stretch.reason);
  return line;
}

Json json_stretch(const PathPaving& paving, const PathStretch& stretch) {
  return json_stretch_of(trajectory_of(paving), stretch, word_of_claim);
}

}  // namespace regulus::detail
