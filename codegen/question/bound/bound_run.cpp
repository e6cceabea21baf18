// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/bound_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "codegen/answer/report/progress.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/exact/sign.hpp"
#include "codegen/question/bound/bound_certificate.hpp"
#include "codegen/question/bound/bracket_topic.hpp"
#include "codegen/question/bound/fastest_twist.hpp"
#include "codegen/question/bound/norm_of_part.hpp"
#include "codegen/question/bound/reference.hpp"
#include "codegen/question/bound/way_bound.hpp"
#include "codegen/question/condition/condition_run.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "codegen/question/engine/settings.hpp"
#include "codegen/question/margin/prepared_margin.hpp"
#include "codegen/question/quantity/approx_values.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus {
namespace {

using GiNaC::ex;

constexpr int kPlaces = 8;  ///< where the quantity is evaluated beforehand
constexpr int kMostRefinements = 3;
/// Seconds of a search, if all components together have as much: enough for an attained end.
constexpr double kLeastSearch = 0.5;

/// "leg 3" becomes "leg_3".
std::string in_file_name(std::string label) {
  std::erase(label, ',');
  std::ranges::replace(label, ' ', '_');
  return label;
}

std::string certificate_of(const Component& c, const std::string& certificate) {
  return certificate.empty() ? certificate : certificate + certificate_suffix(c);
}

/// Brackets one component, or compares it with a limit.
class ComponentRun {
 public:
  /// `number`: of the component. `seconds`: its share of the time; `left`: all of the time.
  ComponentRun(const Request& request, const Component& component, std::size_t number,
               const BoundSettings& settings, double seconds, double left)
      : request_(request),
        settings_(settings),
        search_(settings.search),
        left_(std::max(left, 1e-3)),
        watch_() {
    result_.component = component;
    topic_.component = number;
    search_.time_limit = std::max(seconds, 1e-3);
  }

  ComponentBound bracket() {
    choose_reference();
    if (is_zero_everywhere()) return zero();
    MarginQuestion question = question_beyond(bordered_, sampled_);
    question.certified = certified();
    double gap = settings_.gap;
    for (int round = 0; round <= kMostRefinements; ++round) {
      run(question, gap);
      // A proof of any bound shows that everything is defined at every pose.
      if (result_.proved && is_zero_where_defined()) return zero();
      const std::optional<double> width = relative_gap(&result_, &result_);
      result_.is_closed = width && *width <= settings_.gap;
      if (result_.is_closed || !width || !closed_) break;
      // The gap of 1/r is relative to q − y, that of the bracket to q.
      gap *= 0.8 * settings_.gap / *width;
      question.low = certified_;
      question.high = refuted_;
    }
    return std::move(result_);
  }

  ComponentBound compare() {
    bordered_ = border_at_limit(request_, result_.component, *settings_.limit);
    reference_ = bordered_.reference;
    MarginQuestion question = question_at_limit(bordered_);
    question.certified = certified();
    PreparedMargin margin = prepared(question);
    MarginCertificates certificates(certificate(), margin.request, margin.prepared.labels,
                                    settings_.held);
    search_at(margin, *question.high, certificates);
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::string certificate() const {
    return certificate_of(result_.component, settings_.certificate);
  }
  [[nodiscard]] bool is_zero_where_defined() const {
    return settings_.certificate.empty() &&
           regulus::is_zero_where_defined(bordered_, result_.component);
  }
  /// Nothing can be undefined.
  [[nodiscard]] bool is_zero_everywhere() const {
    return is_zero_where_defined() && bordered_.request.motion.must_be_defined.empty() &&
           bordered_.request.model.must_be_defined.empty();
  }
  [[nodiscard]] ComponentBound zero() {
    set_zero(result_);
    return std::move(result_);
  }

  void choose_reference() {
    bordered_ = border(request_, result_.component);
    if (bordered_.parameter.empty()) return;
    const Reference reference =
        regulus::choose_reference(result_.component, approx_values(bordered_, kPlaces));
    sampled_ = reference.sampled;
    topic_.reference = reference.approx;
    reference_ = reference.value();
    if (reference.approx != 0) bordered_ = border(request_, result_.component, reference_);
  }

  /// The certificate states the model, the quantity and the bound that the range of r means.
  [[nodiscard]] CertifiedAbout certified() const {
    return [this](const Request& grown, const std::set<std::string>& uncertain) {
      const Motion& motion = grown.motion;
      const ex end = bordered_.parameter.empty() ? motion.alpha : motion.parameters.back().range.hi;
      return certified_bound(request_, result_.component, bordered_, end, uncertain);
    };
  }

  void tell_workers(const MarginQuestion& question) {
    if (search_.workers == nullptr) return;
    topic_.low = question.low.approx;
    topic_.high.reset();
    if (question.high) topic_.high = question.high->approx;
    search_.workers->turn_to(write_topic(topic_));
  }

  /// Forms the matrix in all of the time that is left: the share is for the search.
  [[nodiscard]] PreparedMargin prepared(const MarginQuestion& question) {
    pass_time();
    tell_workers(question);
    SearchOptions forming = search_;
    forming.time_limit = left_;
    PreparedMargin margin(question, bordered_.request, 0, forming,
                          forming_watch(settings_.output, settings_.interrupt));
    pass_time();
    margin.settings.interrupt = settings_.interrupt;
    margin.settings.time_limit =
        margin.prepared.stopped ? 0 : std::max(search_.time_limit, std::min(kLeastSearch, left_));
    return margin;
  }

  void pass_time() {
    const double seconds = watch_.lap();
    left_ = std::max(1e-3, left_ - seconds);
    search_.time_limit = std::max(1e-3, search_.time_limit - seconds);
  }

  void run(const MarginQuestion& question, double gap) {
    PreparedMargin margin = prepared(question);
    MarginCertificates certificates(certificate(), margin.request, margin.prepared.labels,
                                    settings_.held);
    std::unique_ptr<EarlierSearches> earlier;
    if (settings_.checkpoint != nullptr)
      earlier = settings_.checkpoint->searches_of(question, result_.component.label,
                                                  formula_text(reference_));
    MarginRun run(
        margin.prepared, question, margin.request, margin.search, settings_.output, margin.settings,
        gap, certificates, [](const MarginStep&) {}, earlier.get());
    const Margin found = run.run();
    margin.prepared.seconds.search = found.seconds;
    add(margin.prepared, found.boxes);
    closed_ = found.closed && found.certified && found.refuted;
    if (found.certified) set_proved(found.certified->value);
    if (found.refuted) set_attained(margin, *found.refuted);
    result_.is_empty = found.empty.has_value();
    result_.reason = found.interrupted ? "the run was interrupted"
                     : closed_ || result_.is_unbounded
                         ? ""
                         : "no search was likely to end within the time left";
    result_.proofs = certificates.proofs();
  }

  void set_proved(const MarginValue& value) {
    certified_ = value;
    if (bordered_.is_reciprocal && value.exact.is_zero()) return;
    const BoundEnd end = end_at(bound_at(bordered_, result_.component, value));
    if (std::isfinite(end.approx)) result_.proved = end;
  }

  void set_attained(PreparedMargin& margin, const MarginStep& step) {
    refuted_ = step.value;
    result_.place = place_of(margin, step.value, step.result);
    if (bordered_.is_reciprocal && step.value.exact.is_zero()) {
      result_.is_unbounded = true;
      result_.place->values.clear();  // it is singular under every load
      return;
    }
    result_.attained = end_at(bound_at(bordered_, result_.component, step.value));
  }

  void search_at(PreparedMargin& margin, const MarginValue& value,
                 MarginCertificates& certificates) {
    margin.request.replan(margin.prepared, value);
    SearchDisplay display(settings_.output);
    std::vector<Observer*> watching;
    for (Observer* observer : {certificates.watch(value), display.observer()})
      if (observer != nullptr) watching.push_back(observer);
    Observers observers(std::move(watching));
    const Result result = run_search(margin.prepared, search_, margin.settings, &observers);
    certificates.finish(value, result);
    margin.prepared.seconds.search = result.statistics.seconds;
    add(margin.prepared, result.statistics.boxes);
    result_.is_empty = result.occupancy == Occupancy::kEmpty;
    result_.proofs = certificates.proofs();
    if (result.verdict == Verdict::kNoSingularity) result_.verdict = LimitVerdict::kWithin;
    if (result.verdict == Verdict::kSingularity) {
      result_.verdict = LimitVerdict::kExceeded;
      result_.place = place_of(margin, value, result);
    }
    if (result.verdict == Verdict::kPossibleProblem) result_.reason = describe(result.reason);
  }

  [[nodiscard]] AttainedPlace place_of(PreparedMargin& margin, const MarginValue& value,
                                       const Result& result) const {
    margin.request.replan(margin.prepared, value);
    AttainedPlace place = attained_place(margin.prepared, result, bordered_.parameter);
    if (result_.component.kind == QuantityKind::kSpeed)
      add_fastest_twist(place, request_, result_.component);
    return place;
  }

  void add(const PreparedSearch& p, std::uint64_t boxes) {
    result_.boxes += boxes;
    result_.seconds += p.seconds_spent();
  }

  const Request& request_;
  const BoundSettings& settings_;
  SearchOptions search_;  ///< its time limit is the rest of the component's share
  double left_;           ///< seconds
  Stopwatch watch_;
  Bordered bordered_;
  ex reference_ = 0;
  BracketTopic topic_;
  std::optional<double> sampled_;  ///< a value of r at which B is singular somewhere, approximately
  MarginValue certified_, refuted_;
  bool closed_ = false;
  ComponentBound result_;
};

ComponentBound bound_variety(const Request& request, const Component& component, std::size_t number,
                             const BoundSettings& settings, double seconds, double left) {
  const auto other = [&](const Component& c, const BoundSettings& of, double share) {
    return bound_variety(request, c, 0, of, share, share);
  };
  if (component.kind == QuantityKind::kCondition2)
    return bound_condition_number(request, component, settings, seconds, left, other);
  ComponentRun run(request, component, number, settings, seconds, left);
  return settings.limit ? run.compare() : run.bracket();
}

/// Compares exact numbers; approximately only if their difference has no certain sign.
bool is_beyond(const BoundEnd& end, const BoundEnd& other, bool below) {
  const CertainSign sign = certain_sign(below ? other.exact - end.exact : end.exact - other.exact);
  if (sign == CertainSign::kUnknown) return below != (end.approx > other.approx);
  return sign == CertainSign::kPositive;
}

/// Returns the component with the extreme end; nullptr if one has none.
const ComponentBound* decisive(const Bound& bound, std::optional<BoundEnd> ComponentBound::*end,
                               bool all_needed) {
  const ComponentBound* best = nullptr;
  if (all_needed && bound.components.size() < bound.quantity.components.size()) return nullptr;
  for (const ComponentBound& c : bound.components) {
    const std::optional<BoundEnd>& here = c.*end;
    if (!here) {
      if (all_needed && !c.is_empty) return nullptr;
      continue;
    }
    if (!best || is_beyond(*here, *(best->*end), bound.quantity.is_least)) best = &c;
  }
  return best;
}

/// Uses what other components attain.
void use_freedoms(ComponentBound& component, const Bound& bound, const Model& model, double gap) {
  raise_by_freedoms(component, bound.components, model);
  const std::optional<double> width = relative_gap(&component, &component);
  if (component.is_closed || !width || !(*width <= gap)) return;
  component.is_closed = true;
  component.reason.clear();
}

}  // namespace

const ComponentBound* Bound::decisive_attained() const {
  return decisive(*this, &ComponentBound::attained, false);
}

const ComponentBound* Bound::decisive_proved() const {
  return decisive(*this, &ComponentBound::proved, true);
}

std::optional<double> Bound::gap() const {
  return relative_gap(decisive_attained(), decisive_proved());
}

bool Bound::is_closed() const {
  return components.size() == quantity.components.size() &&
         std::ranges::all_of(components, &ComponentBound::is_closed);
}

LimitVerdict Bound::verdict() const {
  const auto has = [this](LimitVerdict verdict) {
    return std::ranges::any_of(components,
                               [&](const ComponentBound& c) { return c.verdict == verdict; });
  };
  if (has(LimitVerdict::kExceeded)) return LimitVerdict::kExceeded;
  const bool all = components.size() == quantity.components.size();
  return all && !has(LimitVerdict::kUndecided) ? LimitVerdict::kWithin : LimitVerdict::kUndecided;
}

Bound bound_quantity(const Request& request, Quantity quantity, const BoundSettings& settings,
                     const BoundListener& listener) {
  const bool is_along_way = request.motion.trajectory != nullptr;
  refuse_unsupported(request, quantity);
  Bound bound{std::move(quantity), {}};
  Stopwatch watch;
  double left = settings.search.time_limit, forming = settings.forming_limit;
  const std::vector<Component>& components = bound.quantity.components;
  for (std::size_t i = 0; i < components.size(); ++i) {
    // Each component has an equal part of the time that is left.
    const double share = left / double(components.size() - i);
    const double most = std::max(left, forming);
    bound.components.push_back(
        is_along_way ? bound_along_way(request, components[i], settings, share, most)
                     : bound_variety(request, components[i], i, settings, share, most));
    // A certificate is of the end that the component's own search found.
    if (!settings.limit && settings.certificate.empty())
      use_freedoms(bound.components.back(), bound, request.model, settings.gap);
    const double seconds = watch.lap();
    left -= seconds;
    forming -= seconds;
    listener(bound.components.back());
    if (settings.interrupt != nullptr && *settings.interrupt) break;
  }
  return bound;
}

std::string certificate_suffix(const Component& component) {
  return component.label.empty() ? "" : "." + in_file_name(component.label);
}

void refuse_threshold(const ModelOptions& options) {
  if (!options.alpha.empty())
    throw UsageError(
        "--alpha: a bound has no threshold; to compare |det J^-1| with a number, use "
        "the quantity determinant with --limit");
}

std::vector<OutputFile> certificate_files(const Quantity& quantity,
                                          const std::string& certificate) {
  std::vector<OutputFile> files;
  for (const Component& c : quantity.components)
    for (const OutputFile& file : EndProofs::files(certificate_of(c, certificate)))
      files.push_back(file);
  return files;
}

}  // namespace regulus
