// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/bound_run.hpp"

#include <algorithm>

#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/question/bound/norm_of_part.hpp"
#include "codegen/question/bound/reference.hpp"
#include "codegen/question/bound/singular_pose.hpp"
#include "codegen/question/bound/variety_bound.hpp"
#include "codegen/question/bound/way_bound.hpp"
#include "codegen/question/condition/condition_run.hpp"
#include "codegen/question/quantity/quantity_traits.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/time_budget.hpp"

namespace regulus::detail {
namespace {

/// "leg 3" becomes "leg_3".
std::string in_file_name(std::string label) {
  std::erase(label, ',');
  std::ranges::replace(label, ' ', '_');
  return label;
}

std::string certificate_of(const Component& c, const std::string& certificate) {
  return certificate.empty() ? certificate : certificate + certificate_suffix(c);
}

ComponentBound bound_component(const Request& request, const Component& component,
                               const BoundSettings& settings, const TimeBudget& budget) {
  if (request.model.closure) return settings.over_branch(request, component, settings, budget);
  if (component.kind == QuantityKind::kCondition2) {
    const auto other = [&](const Component& c, const BoundSettings& of, double seconds) {
      return bound_component(request, c, of, TimeBudget(seconds));
    };
    return bound_condition_number(request, component, settings, budget.left(), budget.all(), other);
  }
  if (request.motion.trajectory) return bound_along_way(request, component, settings, budget);
  return bound_over_variety(request, component, settings, budget);
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

/// A singular pose, looked for once, where the search of a component has found nothing: all that needs
/// an inverse has no bound there.
class SingularPoseOfBound {
 public:
  SingularPoseOfBound(const Request& request, const BoundSettings& settings)
      : request_(request), settings_(settings) {}

  [[nodiscard]] bool is_found() const noexcept { return pose_.has_value(); }

  void look_for(ComponentBound& component, const TimeBudget& budget) {
    const bool is_unknown =
        !component.proved && !component.attained && !component.is_unbounded && !component.is_empty;
    if (has_looked_ || !is_unknown || !has_value(component.component) || settings_.limit ||
        request_.model.closure || budget.is_over() ||
        (settings_.interrupt != nullptr && *settings_.interrupt))
      return;
    has_looked_ = true;
    pose_ =
        find_singular_pose(request_, settings_, TimeBudget::option(budget.left()), component.boxes);
  }

  /// Says what is known of a component there.
  void describe(ComponentBound& component) const {
    if (traits_of(component.component.kind).is_always_least)
      component.attained = end_at(0);
    else
      component.is_unbounded = true;
    component.is_closed = component.attains_zero();
    component.place = pose_->place;
    component.reason.clear();
    component.proofs.set_no_singular(
        "`regulus check` writes the proof that the matrix is singular");
  }

 private:
  /// True if it is known what the quantity is where the matrix is singular.
  [[nodiscard]] static bool has_value(const Component& c) {
    const QuantityTraits& traits = traits_of(c.kind);
    return traits.is_lost_where_singular || (traits.is_always_least && c.is_absolute);
  }

  const Request& request_;
  const BoundSettings& settings_;
  std::optional<SingularPose> pose_;
  bool has_looked_ = false;
};

}  // namespace

bool ComponentBound::attains_zero() const {
  return component.is_absolute && traits_of(component.kind).is_always_least && attained &&
         attained->exact.is_zero();
}

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
  Bound bound{std::move(quantity), {}};
  const TimeBudget all = TimeBudget::of_option(settings.search.time_limit, settings.forming_limit);
  const std::vector<Component>& components = bound.quantity.components;
  SingularPoseOfBound singular(request, settings);
  for (std::size_t i = 0; i < components.size(); ++i) {
    const TimeBudget budget = all.share(components.size() - i);
    if (singular.is_found()) {
      bound.components.emplace_back().component = components[i];
    } else {
      bound.components.push_back(bound_component(request, components[i], settings, budget));
      singular.look_for(bound.components.back(), all.share(components.size() - i));
    }
    if (singular.is_found()) singular.describe(bound.components.back());
    // A certificate is of the end that the component's own search found.
    if (!settings.limit && settings.certificate.empty() && !request.model.closure)
      use_freedoms(bound.components.back(), bound, request.model, settings.gap);
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

}  // namespace regulus::detail
