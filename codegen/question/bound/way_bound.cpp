// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/way_bound.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/bound/bracket_question.hpp"
#include "codegen/question/bound/component_run.hpp"
#include "codegen/question/bound/fastest_twist.hpp"
#include "codegen/question/bound/way_place.hpp"
#include "codegen/question/quantity/approx_values.hpp"
#include "codegen/question/way/path_attempts.hpp"
#include "codegen/question/way/path_bracket.hpp"
#include "codegen/question/way/trajectory_report.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kMostSamples = 8;  ///< pieces where the quantity is evaluated beforehand
constexpr int kPlacesOfPiece = 2;

class WayBound final : public ComponentRun {
 public:
  WayBound(const Request& request, const Component& component, const BoundSettings& settings,
           const TimeBudget& budget)
      : ComponentRun(request, component, settings, budget), proof_seconds_(budget.left()) {}

 private:
  [[nodiscard]] const Trajectory& trajectory() const { return *request_.motion.trajectory; }

  [[nodiscard]] Bordered on_piece(std::size_t piece) const {
    Bordered alone = bordered_;
    alone.request = piece_request(bordered_.request, piece);
    return alone;
  }

  std::vector<double> samples() override {
    std::vector<double> values;
    const std::size_t pieces = trajectory().pieces.size(), count = std::min(kMostSamples, pieces);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t piece = count < 2 ? 0 : i * (pieces - 1) / (count - 1);
      const std::vector<double> some = approx_values(on_piece(piece), kPlacesOfPiece);
      values.insert(values.end(), some.begin(), some.end());
    }
    return values;
  }

  [[nodiscard]] std::optional<double> guess(std::size_t piece) const {
    const std::vector<double> values = better_values(on_piece(piece), kPlacesOfPiece);
    if (values.empty()) return std::nullopt;
    if (!bordered_.is_reciprocal) return std::ranges::min(values);
    const double largest = std::ranges::max(values);
    return largest > 0 ? 1 / largest : kInfinity;
  }

  /// The bracket of the pieces knows the ends of the call before.
  Ends close(const MarginQuestion& question, double gap) override {
    if (budget_.all() <= 0) return {};
    if (!pieces_) form(question);
    pieces_->close(gap);
    Ends ends{.certified = pieces_->certified(),
              .is_closed = pieces_->is_closed(),
              .is_empty = pieces_->is_empty()};
    PieceWitness* const witness = pieces_->witness();
    if (witness == nullptr) return ends;
    ends.refuted = witness->step.value;
    PreparedSearch& prepared = witness->margin.prepared;
    witness->margin.request.replan(prepared, witness->step.value);
    const bool is_unbounded = bordered_.is_reciprocal && ends.refuted->exact.is_zero();
    ends.place = place_of(witness->piece, prepared, witness->step.result, !is_unbounded);
    return ends;
  }

  void form(const MarginQuestion& question) {
    question_ = question;
    alone_ = request_of_pieces(bordered_);
    pieces_.emplace(
        bordered_.request, alone_, question_,
        PathBracketSettings{
            .search = settings_.search,
            .budget = budget_,
            .output = settings_.output,
            .interrupt = settings_.interrupt,
            .topic = topic_of(question_),
            .guess = [this](std::size_t piece) { return guess(piece); },
            .earlier = [this](std::size_t piece, const MarginQuestion& of) -> Earlier {
              if (settings_.checkpoint == nullptr) return nullptr;
              return settings_.checkpoint->searches_of(
                  of, fmt::format("{}{}, segment {}", settings_.part, component().label, piece + 1),
                  formula_text(bordered_.reference));
            }});
  }

  void finish() override {
    result_.proofs = proofs(kNoSafeProof, kNoSingularProof);
    if (!pieces_) return;
    result_.boxes += pieces_->boxes();
    result_.seconds += pieces_->seconds();
    if (!are_proofs_wanted()) return;
    if (const std::optional<MarginValue> certified = pieces_->certified()) certify(*certified);
    if (const PieceWitness* witness = pieces_->witness()) certify_witness(*witness);
  }

  /// Checks all pieces again, for their trees.
  void certify(const MarginValue& value) {
    const Checked checked = check(question_, value, proof_seconds_);
    if (checked.step.result.verdict != Verdict::kNoSingularity)
      result_.proofs.set_no_safe(kNothingClaimed);
  }

  /// The search of all pieces combines the columns of the matrix, where inverse_columns.hpp does so;
  /// a single piece was bracketed without.
  void certify_witness(const PieceWitness& witness) {
    Bordered plain = bordered_;
    plain.combination.reset();
    const MarginStep& step = witness.step;
    const CertifiedMotion motion = certified(witness.margin.request.at(step.value), plain);
    const CertifiedQuestion question = motion.about(
        piece_request(request_, witness.piece), uncertain_names(witness.margin.prepared.labels));
    std::string obstacle = certificate_obstacle(question, true);
    if (!obstacle.empty()) return result_.proofs.set_no_singular(std::move(obstacle));
    result_.proofs.write_singular(
        question.head(true), witness_lines(step.result),
        fmt::format("singular at {}, on segment {}", step.value.text, witness.piece + 1));
  }

  MarginStep search_at(const MarginQuestion& question, const MarginValue& value) override {
    result_.proofs = proofs("the limit is exceeded", "no pose exceeds the limit");
    Checked checked = check(question, value, budget_.left());
    const TrajectoryCheck& of = checked.check;
    if (of.verdict == Verdict::kSingularity)
      result_.place =
          place_of(of.deciding->index, *of.deciding->preparation, of.deciding->result, true);
    if (of.verdict == Verdict::kPossibleProblem) result_.reason = reason_of(of);
    return std::move(checked.step);
  }

  struct Checked {
    MarginStep step;
    TrajectoryCheck check;
  };

  /// Checks all pieces at a value, and proves the result.
  Checked check(const MarginQuestion& question, const MarginValue& value, double seconds) {
    const MarginRequest request(bordered_.request, question);
    PathAttempts attempts(request, settings_.search, settings_.output, settings_.interrupt,
                          result_.proofs, topic_of(question));
    MarginStep step = attempts.at(value, {value.approx, kAnyBoxes, seconds});
    result_.proofs = attempts.proofs();
    result_.boxes += step.result.statistics.boxes;
    result_.seconds += attempts.seconds();
    std::optional<TrajectoryCheck> refuted = attempts.take_refuted();
    return {std::move(step), refuted ? std::move(*refuted) : *attempts.take_last()};
  }

  [[nodiscard]] AttainedPlace place_of(std::size_t piece, const PreparedSearch& prepared,
                                       const Result& result, bool has_values) const {
    AttainedPlace place =
        place_on_way(trajectory(), piece, prepared, result, bordered_.parameter, has_values);
    if (component().kind == QuantityKind::kSpeed) add_fastest_twist(place, request_, component());
    return place;
  }

  [[nodiscard]] std::string reason_of(const TrajectoryCheck& check) const {
    if (!check.deciding) return describe(check.reason);
    return std::string(describe(check.reason)) + ", on " +
           describe_segment(trajectory(), check.deciding->index, std::nullopt);
  }

  using Earlier = std::unique_ptr<EarlierSearches>;

  const double proof_seconds_;  ///< as many as the bracket has
  MarginQuestion question_;
  Request alone_;
  std::optional<PathBracket> pieces_;
};

}  // namespace

ComponentBound bound_along_way(const Request& request, const Component& component,
                               const BoundSettings& settings, const TimeBudget& budget) {
  WayBound bound(request, component, settings, budget);
  return settings.limit ? bound.compare() : bound.bracket();
}

}  // namespace regulus::detail
