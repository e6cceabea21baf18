// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/condition_run.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/model/exact/exact_double.hpp"
#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/question/bound/singular_pose.hpp"
#include "codegen/question/bound/way_place.hpp"
#include "codegen/question/condition/condition_certificate.hpp"
#include "codegen/question/condition/condition_kernel.hpp"
#include "codegen/question/condition/condition_search.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/question/way/path_run.hpp"
#include "codegen/question/way/trajectory_report.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus::detail {
namespace {

/// Seconds of a search, if there are as many: enough for an attained end.
constexpr double kLeastConditionSearch = 0.5;
/// The gap of the bounds of singular values whose ratio is a bound of κ.
constexpr double kGapOfExtremes = 0.01;

constexpr int kDigitsOfEnd = 12;
/// The part of the upper end that is left to the rounding of the verifier, whose test is another one.
constexpr double kRoomToVerify = 0x1p-32;

/// Returns a decimal that is not above, or not below, the number: shorter in a report and in a
/// certificate than the number itself.
BoundEnd decimal_end(double x, RoundTo side) {
  const std::string text = rounded_text(end_at(exact_number(x)), side, kDigitsOfEnd);
  return end_at(parse_constant(text, {.file = "", .key = ""}).value);
}

/// Says why a search is not closed.
std::string describe_end(const ConditionResult& result) {
  if (result.is_continued) return describe(result.reason);
  return std::string("the bounds of the checkpoint were not all proved again: ") +
         describe(result.reason);
}

/// The run has the same steps whether the poses are a variety or a trajectory.
class ConditionRun {
 public:
  ConditionRun(const Request& request, const Component& component, const BoundSettings& settings,
               double seconds, double left, const OtherBound& other)
      : other_(other),
        seconds_(std::max(seconds, 1e-3)),
        left_(left),
        request_(request),
        settings_(settings) {
    result_.component = component;
    SearchOptions forming = settings.search;
    forming.time_limit = std::max(left, 1e-3);
    kernel_ =
        form_condition_kernel(request, forming, forming_watch(settings.output, settings.interrupt));
  }
  ConditionRun(const ConditionRun&) = delete;
  ConditionRun& operator=(const ConditionRun&) = delete;
  virtual ~ConditionRun() = default;

  ComponentBound run() {
    certificate_.emplace(certificate_path(), request_, result_.component,
                         uncertain_names(prepared_.labels), settings_.placing);
    if (prepared_.stopped) return stopped();
    SearchDisplay display(settings_.output);
    std::vector<Observer*> watching;
    for (Observer* observer : {certificate_->observer(), display.observer()})
      if (observer != nullptr) watching.push_back(observer);
    Observers observers(std::move(watching));
    const auto search = [&](const ConditionSettings& settings) {
      return this->search(settings, observers);
    };
    const ConditionResult found =
        settings_.checkpoint == nullptr
            ? search(search_settings())
            : settings_.checkpoint->file().continue_search(search_settings(), search);
    prepared_.seconds.search = found.seconds;
    result_.boxes += found.boxes;
    result_.seconds += prepared_.seconds_spent();
    result_.is_empty = found.is_empty;
    result_.is_unbounded = found.is_singular;
    if (found.attained && !result_.place) result_.place = place_of(found.attained->variables);
    if (settings_.limit)
      set_verdict(found);
    else
      set_ends(found);
    certify(found);
    result_.proofs = certificate_->proofs();
    return std::move(result_);
  }

 protected:
  [[nodiscard]] virtual ConditionResult search(const ConditionSettings& settings,
                                               Observer& observer) = 0;
  /// Returns a point of the search as the certificate has it.
  [[nodiscard]] virtual ConditionPlace on_certificate(const std::vector<Interval>& point) const = 0;
  [[nodiscard]] virtual AttainedPlace place_of(const std::vector<Interval>& point) = 0;

  [[nodiscard]] MatrixScaling scaling() const { return prepared_.stages->formulation().scaling; }
  [[nodiscard]] std::vector<Interval> pose_at(const Problem& kernel,
                                              const std::vector<Interval>& point) const {
    return BoxMatrices(kernel, scaling(), kernel.outer.size()).pose_at(point);
  }

 private:
  [[nodiscard]] std::string certificate_path() const {
    return settings_.certificate.empty()
               ? ""
               : settings_.certificate + certificate_suffix(result_.component);
  }

  /// Without a matrix there are no boxes to decide.
  ComponentBound stopped() {
    result_.seconds += prepared_.seconds_spent();
    result_.reason = regulus::describe(prepared_.stopped->interrupted ? Reason::kInterrupted
                                                                      : Reason::kTimeBudget);
    result_.proofs = certificate_->proofs();
    return std::move(result_);
  }

  /// The certificate of a comparison is about the limit.
  void certify(const ConditionResult& found) {
    const auto end = [this](const std::optional<BoundEnd>& own, LimitVerdict verdict) {
      if (!settings_.limit) return own;
      return result_.verdict == verdict ? std::optional(end_at(*settings_.limit)) : std::nullopt;
    };
    if (found.attained && found.attained->shown.condition == kInfinity)
      certificate_->show_singular(on_certificate(found.attained->variables));
    const auto attained = end(result_.attained, LimitVerdict::kExceeded);
    if (attained && !found.is_singular)
      certificate_->attain(*attained, on_certificate(found.attained->variables));
    const auto proved = end(result_.proved, LimitVerdict::kWithin);
    if (proved && found.is_by_hint)
      certificate_->note_ratio();
    else if (proved)
      certificate_->prove(*proved);
  }

  [[nodiscard]] ConditionSettings search_settings() {
    ConditionSettings settings;
    settings.threads = settings_from(settings_.search).threads;
    settings.gap = settings_.gap;
    if (settings_.limit) settings.limit = enclose_constant(*settings_.limit, "--limit");
    if (settings_.search.max_boxes != 0) settings.max_boxes = settings_.search.max_boxes;
    const double least = std::min(kLeastConditionSearch, seconds_left(prepared_, left_));
    settings.time_limit =
        prepared_.stopped ? 0 : std::max(seconds_left(prepared_, seconds_), least);
    settings.interrupt = settings_.interrupt;
    settings.ask = [this](double seconds) { return hint(seconds); };
    settings.workers = settings_.search.workers;
    turn_to(settings.workers, topic_of(kernel_), request_.motion);
    return settings;
  }

  /// Its seconds are seconds of the search that asks.
  ConditionHint hint(double seconds) {
    ConditionHint hint;
    if (!(seconds > 0) || prepared_.stopped) return hint;
    hint.is_singular = has_singular_pose(seconds / 2);
    if (hint.is_singular) return hint;
    const std::optional<Interval> largest = extreme("sigma-max", seconds / 8);
    const std::optional<Interval> least = extreme("sigma-min", seconds / 8);
    if (largest && least && least->lo > 0) hint.upper = div_ru(largest->hi, least->lo);
    return hint;
  }

  /// Looks for a singular pose, and shows it.
  bool has_singular_pose(double seconds) {
    std::optional<SingularPose> found =
        find_singular_pose(request_, settings_, seconds, result_.boxes);
    if (!found) return false;
    result_.place = std::move(found->place);
    certificate_->show_singular(found->result, found->uncertain, found->piece);
    return true;
  }

  /// Encloses the proved bound of the largest or the least singular value at all poses.
  std::optional<Interval> extreme(const char* quantity, double seconds) {
    BoundSettings settings = settings_;
    settings.limit.reset();
    settings.certificate.clear();
    settings.checkpoint = nullptr;      // it is of this search
    settings.search.workers = nullptr;  // the same
    settings.gap = kGapOfExtremes;
    const Quantity asked = quantity_of(request_.model, {.quantity = quantity});
    const ComponentBound bound = other_(asked.components.front(), settings, seconds);
    result_.boxes += bound.boxes;
    if (!bound.proved) return std::nullopt;
    return enclose_constant(bound.proved->exact, quantity);
  }

  void set_verdict(const ConditionResult& found) {
    const Interval limit = enclose_constant(*settings_.limit, "--limit");
    const bool is_exceeded =
        found.is_singular || (found.attained && found.attained->shown.condition >= limit.hi);
    if (is_exceeded)
      result_.verdict = LimitVerdict::kExceeded;
    else if (found.is_closed && found.proved <= limit.lo)
      result_.verdict = LimitVerdict::kWithin;
    else if (!found.is_empty)
      result_.reason = describe_end(found);
  }

  /// Returns a bound a little above that of the search, within the gap.
  [[nodiscard]] double with_room(const ConditionResult& found) const {
    double end = found.proved * (1 + kRoomToVerify);
    if (found.is_closed && found.attained)
      end = std::min(end, found.attained->shown.condition / (1 - settings_.gap));
    return std::max(end, found.proved);
  }

  void set_ends(const ConditionResult& found) {
    if (found.is_singular || found.is_empty) return;
    if (std::isfinite(found.proved))
      result_.proved = decimal_end(with_room(found), RoundTo::kAbove);
    if (found.attained)
      result_.attained = decimal_end(found.attained->shown.condition, RoundTo::kBelow);
    result_.is_closed = found.is_closed && found.attained.has_value();
    if (!result_.is_closed) result_.reason = describe_end(found);
  }

  const OtherBound& other_;
  const double seconds_, left_;
  ConditionKernel kernel_;
  std::optional<ConditionCertificate> certificate_;
  ComponentBound result_;

 protected:
  const Request& request_;
  const BoundSettings& settings_;
  PreparedSearch& prepared_ = kernel_.prepared;
};

class VarietyCondition final : public ConditionRun {
 public:
  using ConditionRun::ConditionRun;

 private:
  ConditionResult search(const ConditionSettings& settings, Observer& observer) override {
    return search_condition({prepared_.problem(), scaling()}, settings, &observer);
  }

  [[nodiscard]] ConditionPlace on_certificate(const std::vector<Interval>& point) const override {
    return {point};
  }

  AttainedPlace place_of(const std::vector<Interval>& point) override {
    Result result;
    result.witness.emplace().points.push_back(
        {point, {}, {}, {}, pose_at(prepared_.problem(), point)});
    return attained_place(prepared_, result, "");
  }
};

/// The poses of a trajectory: one search of all of its pieces.
class WayCondition final : public ConditionRun {
 public:
  WayCondition(const Request& request, const Component& component, const BoundSettings& settings,
               double seconds, double left, const OtherBound& other)
      : ConditionRun(request, component, settings, seconds, left, other),
        path_(trajectory(), request.motion.error) {
    SearchOptions options = settings.search;
    settle_options(options);
  }

 private:
  [[nodiscard]] const Trajectory& trajectory() const { return *request_.motion.trajectory; }

  ConditionResult search(const ConditionSettings& settings, Observer& observer) override {
    variety_.emplace(path_, prepared_.problem(), request_.motion.parameters.size());
    return search_condition({variety_->problem(), *variety_, scaling()}, settings, &observer);
  }

  [[nodiscard]] ConditionPlace on_certificate(const std::vector<Interval>& point) const override {
    return {variety_->on_piece(point), variety_->piece_of(point)};
  }

  AttainedPlace place_of(const std::vector<Interval>& point) override {
    const ConditionPlace place = on_certificate(point);
    Request regularity = request_;
    regularity.motion.alpha = 0;
    SearchOptions options = settings_.search;
    options.time_limit = 0;
    options.workers = nullptr;  // they have another kernel
    options.method = Method::kReg;
    options.engine = Engine::kInterpreted;
    const PreparedSearch piece = prepare(piece_request(regularity, place.piece), 0, options,
                                         forming_watch(settings_.output, settings_.interrupt));
    if (piece.stopped) return segment_of(place);
    Result result;
    result.witness.emplace().points.push_back(
        {place.variables, {}, {}, {}, pose_at(variety_->kernel(), variety_->on_kernel(point))});
    return place_on_way(trajectory(), place.piece, piece, result, "");
  }

  /// Returns the segment, which is known without the matrix of its piece.
  [[nodiscard]] AttainedPlace segment_of(const ConditionPlace& place) const {
    AttainedPlace segment;
    segment.pose = describe_segment(trajectory(), place.piece, place.variables.front());
    segment.json["segment"] = json_segment(trajectory(), place.piece, place.variables.front());
    return segment;
  }

  const PathBounds path_;
  std::optional<PathVariety> variety_;
};

}  // namespace

ComponentBound bound_condition_number(const Request& request, const Component& component,
                                      const BoundSettings& settings, double seconds, double left,
                                      const OtherBound& other) {
  if (request.motion.trajectory)
    return WayCondition(request, component, settings, seconds, left, other).run();
  return VarietyCondition(request, component, settings, seconds, left, other).run();
}

}  // namespace regulus::detail
