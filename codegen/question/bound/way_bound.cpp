// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/way_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/bound/bound_certificate.hpp"
#include "codegen/question/bound/bracket_topic.hpp"
#include "codegen/question/bound/fastest_twist.hpp"
#include "codegen/question/bound/reference.hpp"
#include "codegen/question/quantity/approx_values.hpp"
#include "codegen/question/way/path_bracket.hpp"
#include "codegen/question/way/trajectory_certificate.hpp"
#include "codegen/question/way/trajectory_report.hpp"
#include "codegen/support/errors.hpp"

namespace regulus {
namespace {

using GiNaC::ex;

constexpr std::size_t kMostSamples = 8;  ///< pieces where the quantity is evaluated beforehand
constexpr int kPlacesOfPiece = 2;
constexpr int kMostRounds = 3;
constexpr const char* kNoTime = "no search was likely to end within the time left";

/// The search of all pieces combines the columns of the matrix, where inverse_columns.hpp does so; a
/// single piece is bracketed without.
enum class Columns { kCombined, kPlain };

void refuse_workers(const SearchOptions& search) {
  if (search.workers != nullptr)
    throw UsageError(
        "a bound along way-points is computed on one machine; use regulus bound, with --threads");
}

/// "x = 9.5, y = -2": rounded, of all pose parameters but `parameter`.
std::string pose_text(const PreparedSearch& p, const WitnessPoint& point,
                      const std::string& parameter) {
  std::string text;
  for (std::size_t i = 0; i < point.pose.size() && i < p.labels.pose.size(); ++i)
    if (p.labels.pose[i].name != parameter)
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", p.labels.pose[i].name,
                          short_interval(point.pose[i]));
  return text;
}

class WayBound {
 public:
  WayBound(const Request& request, const Component& component, const BoundSettings& settings,
           double seconds, double left)
      : request_(request), settings_(settings), search_(settings.search), left_(left) {
    refuse_workers(search_);
    result_.component = component;
    search_.time_limit = std::max(seconds, 1e-3);
    if (!settings.certificate.empty())
      certificate_ = settings.certificate + certificate_suffix(component);
  }

  ComponentBound bracket() {
    if (left_ <= 0) {
      result_.reason = kNoTime;
      return std::move(result_);
    }
    choose_reference();
    if (settings_.certificate.empty() && is_zero_where_defined(bordered_, result_.component) &&
        bordered_.request.motion.must_be_defined.empty() &&
        bordered_.request.model.must_be_defined.empty()) {
      set_zero(result_);
      return std::move(result_);
    }
    const MarginQuestion question = question_beyond(bordered_, sampled_);
    // Numbers of the way-points make each entry of combined columns long.
    Request alone = bordered_.request;
    if (!bordered_.parameter.empty()) alone.model.matrix = bordered_.plain;
    PathBracket pieces(bordered_.request, alone, question, path_settings());
    double gap = settings_.gap;
    for (int round = 0; round <= kMostRounds; ++round) {
      pieces.close(gap);
      set_ends(pieces);
      const std::optional<double> width = relative_gap(&result_, &result_);
      result_.is_closed = width && *width <= settings_.gap;
      if (result_.is_closed || !width || !pieces.is_closed()) break;
      // The gap of 1/r is relative to q − y, that of the bracket to q.
      gap *= 0.8 * settings_.gap / *width;
    }
    finish(pieces);
    if (!certificate_.empty()) certify(question, pieces);
    return std::move(result_);
  }

  ComponentBound compare() {
    bordered_ = border_at_limit(request_, result_.component, *settings_.limit);
    SearchDisplay display(settings_.output);
    const TrajectoryCheck check =
        check_trajectory(bordered_.request, 0, search_, !certificate_.empty(),
                         {settings_.interrupt, display.observer()});
    add(check);
    result_.is_empty = check.reason == Reason::kEmptyVariety;
    if (check.verdict == Verdict::kNoSingularity) result_.verdict = LimitVerdict::kWithin;
    if (check.verdict == Verdict::kSingularity) {
      result_.verdict = LimitVerdict::kExceeded;
      result_.place =
          place_of(check.deciding->index, *check.deciding->preparation, check.deciding->result);
    }
    if (check.verdict == Verdict::kPossibleProblem) result_.reason = reason_of(check);
    if (!certificate_.empty()) certify_comparison(check);
    return std::move(result_);
  }

 private:
  [[nodiscard]] const Trajectory& trajectory() const { return *request_.motion.trajectory; }

  [[nodiscard]] std::vector<double> values_on(std::size_t piece) const {
    Bordered alone = bordered_;
    alone.request = piece_request(bordered_.request, piece);
    return approx_values(alone, kPlacesOfPiece);
  }

  void choose_reference() {
    bordered_ = border(request_, result_.component);
    if (bordered_.parameter.empty()) return;
    std::vector<double> values;
    const std::size_t pieces = trajectory().pieces.size(), count = std::min(kMostSamples, pieces);
    for (std::size_t i = 0; i < count; ++i) {
      const std::vector<double> some = values_on(count < 2 ? 0 : i * (pieces - 1) / (count - 1));
      values.insert(values.end(), some.begin(), some.end());
    }
    const Reference reference = regulus::choose_reference(result_.component, values);
    sampled_ = reference.sampled;
    if (reference.approx != 0) bordered_ = border(request_, result_.component, reference.value());
  }

  [[nodiscard]] PathBracketSettings path_settings() const {
    PathBracketSettings settings;
    settings.search = search_;
    settings.forming_limit = std::max(left_, 1e-3);
    settings.output = settings_.output;
    settings.interrupt = settings_.interrupt;
    settings.guess = [this](std::size_t piece) { return guess(piece); };
    settings.earlier = [this](std::size_t piece,
                              const MarginQuestion& question) -> std::unique_ptr<EarlierSearches> {
      if (settings_.checkpoint == nullptr) return nullptr;
      return settings_.checkpoint->searches_of(
          question, fmt::format("{}, segment {}", result_.component.label, piece + 1),
          formula_text(bordered_.reference));
    };
    return settings;
  }

  [[nodiscard]] std::optional<double> guess(std::size_t piece) const {
    Bordered alone = bordered_;
    alone.request = piece_request(bordered_.request, piece);
    const std::vector<double> values = better_values(alone, kPlacesOfPiece);
    if (values.empty()) return std::nullopt;
    if (!bordered_.is_reciprocal) return std::ranges::min(values);
    const double largest = std::ranges::max(values);
    return largest > 0 ? 1 / largest : kInfinity;
  }

  void set_ends(PathBracket& pieces) {
    const std::optional<MarginValue> certified = pieces.certified();
    if (certified && !(bordered_.is_reciprocal && certified->exact.is_zero())) {
      const BoundEnd end = end_at(bound_at(bordered_, result_.component, *certified));
      if (std::isfinite(end.approx)) result_.proved = end;
    }
    const PieceWitness* witness = pieces.witness();
    if (witness == nullptr) return;
    result_.is_unbounded = bordered_.is_reciprocal && witness->step.value.exact.is_zero();
    if (!result_.is_unbounded)
      result_.attained = end_at(bound_at(bordered_, result_.component, witness->step.value));
  }

  void finish(PathBracket& pieces) {
    result_.boxes += pieces.boxes();
    result_.seconds += pieces.seconds();
    result_.is_empty = pieces.is_empty();
    const bool interrupted = settings_.interrupt != nullptr && *settings_.interrupt;
    result_.reason = interrupted ? "the run was interrupted"
                     : result_.is_closed || result_.is_unbounded || pieces.is_closed() ? ""
                                                                                       : kNoTime;
    PieceWitness* witness = pieces.witness();
    if (witness == nullptr) return;
    witness->margin->request.replan(witness->margin->prepared, witness->step.value);
    result_.place = place_of(witness->piece, witness->margin->prepared, witness->step.result);
    if (result_.is_unbounded) result_.place->values = pose_line_;  // singular under every load
  }

  [[nodiscard]] AttainedPlace place_of(std::size_t piece, const PreparedSearch& prepared,
                                       const Result& result) {
    AttainedPlace place = attained_place(prepared, result, bordered_.parameter);
    std::optional<Interval> s;
    pose_line_.clear();
    if (result.witness) {
      const Witness& witness = *result.witness;
      const WitnessPoint& point = witness.near ? *witness.near : witness.points.front();
      s = point.variables.front();
      pose_line_ = fmt::format("           {}\n", pose_text(prepared, point, bordered_.parameter));
    }
    place.pose = describe_segment(trajectory(), piece, s);
    place.values = pose_line_ + place.values;
    place.json["segment"] = json_segment(trajectory(), piece, s);
    if (result_.component.kind == QuantityKind::kSpeed)
      add_fastest_twist(place, request_, result_.component);
    return place;
  }

  [[nodiscard]] std::string reason_of(const TrajectoryCheck& check) const {
    if (!check.deciding) return describe(check.reason);
    return std::string(describe(check.reason)) + ", on " +
           describe_segment(trajectory(), check.deciding->index, std::nullopt);
  }

  void add(const TrajectoryCheck& check) {
    result_.boxes += check.path.statistics.boxes;
    result_.seconds += check.seconds;
  }

  /// The certificate states the model, the quantity and the bound that the range of r in `bordered`
  /// means.
  [[nodiscard]] CertifiedMotion certified_at(const Request& bordered, Columns columns) const {
    const Motion& motion = bordered.motion;
    const ex end = bordered_.parameter.empty() ? motion.alpha : motion.parameters.back().range.hi;
    Bordered searched = bordered_;
    if (columns == Columns::kPlain) searched.combination.reset();
    return {request_,
            [this, end, searched](const Request& along, const std::set<std::string>& uncertain) {
              return certified_bound(along, result_.component, searched, end, uncertain);
            }};
  }

  /// Writes a proof of each end: of all pieces, and of the pose on one of them.
  void certify(const MarginQuestion& question, PathBracket& pieces) {
    result_.proofs = EndProofs(certificate_, settings_.held, kNoSafeProof, kNoSingularProof);
    if (const PieceWitness* witness = pieces.witness()) certify_witness(*witness);
    const std::optional<MarginValue> certified = pieces.certified();
    if (!certified) return;
    const Request proved = MarginRequest(bordered_.request, question).at(*certified);
    const TrajectoryCheck check = check_trajectory(proved, 0, search_, true, {settings_.interrupt});
    add(check);
    const ProofStatus written =
        certify_trajectory(result_.proofs.safe_file(), check,
                           certified_at(proved, Columns::kCombined), settings_.held);
    if (written.is_written())
      result_.proofs.set_safe("safe at " + certified->text);
    else
      result_.proofs.set_no_safe(written.obstacle());
  }

  /// Writes a proof of the one end that a comparison has found.
  void certify_comparison(const TrajectoryCheck& check) {
    EndProofs& proofs = result_.proofs = EndProofs(
        certificate_, settings_.held, "the limit is exceeded", "no pose exceeds the limit");
    const bool is_singular = check.verdict == Verdict::kSingularity;
    const ProofStatus written =
        certify_trajectory(is_singular ? proofs.singular_file() : proofs.safe_file(), check,
                           certified_at(bordered_.request, Columns::kCombined), settings_.held);
    const std::string limit = formula_text(*settings_.limit);
    if (written.is_written())
      return is_singular ? proofs.set_singular("exceeds " + limit)
                         : proofs.set_safe("within " + limit);
    const bool is_open = check.verdict == Verdict::kPossibleProblem;
    if (is_open || !is_singular) proofs.set_no_safe(written.obstacle());
    if (is_open || is_singular) proofs.set_no_singular(written.obstacle());
  }

  void certify_witness(const PieceWitness& witness) {
    const PreparedMargin& margin = *witness.margin;
    const CertifiedQuestion question =
        certified_at(margin.request.at(witness.step.value), Columns::kPlain)
            .about(piece_request(request_, witness.piece), uncertain_names(margin.prepared.labels));
    std::string obstacle = certificate_obstacle(question, true);
    if (!obstacle.empty()) return result_.proofs.set_no_singular(std::move(obstacle));
    result_.proofs.write_singular(
        question.head(true), witness_lines(witness.step.result),
        fmt::format("singular at {}, on segment {}", witness.step.value.text, witness.piece + 1));
  }

  const Request& request_;
  const BoundSettings& settings_;
  SearchOptions search_;
  const double left_;
  std::string certificate_;  ///< files, without their endings
  Bordered bordered_;
  std::optional<double> sampled_;
  std::string pose_line_;
  ComponentBound result_;
};

}  // namespace

ComponentBound bound_along_way(const Request& request, const Component& component,
                               const BoundSettings& settings, double seconds, double left) {
  WayBound bound(request, component, settings, seconds, left);
  return settings.limit ? bound.compare() : bound.bracket();
}

}  // namespace regulus
