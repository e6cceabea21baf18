// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/datasheet.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/support/errors.hpp"

namespace regulus {
namespace {

using GiNaC::ex;

/// Each pair of a row and a column is a bracket of its own.
constexpr std::size_t kMostPairs = 12;

/// True if the constant is certainly not above the other.
bool is_at_most(const ex& a, const ex& b) {
  const CertainSign sign = certain_sign(b - a);
  return sign == CertainSign::kPositive || sign == CertainSign::kZero;
}

/// Returns true if both ends of every range are equally far from 0.
bool is_symmetric(const std::vector<Range>& ranges) {
  return std::ranges::all_of(
      ranges, [](const Range& r) { return certain_sign(r.lo + r.hi) == CertainSign::kZero; });
}

/// The questions of a datasheet, in the order of its rows.
class Questions {
 public:
  explicit Questions(const Request& request)
      : model_(request.model), is_along_way_(request.motion.trajectory != nullptr) {
    collect();
  }

  std::vector<QuantityOptions> all;

 private:
  void collect() {
    for (const VectorSet& load : model_.loads) add_forces(load.name);
    for (const VectorSet& load : model_.loads)
      if (!model_.actuators.stiffness.empty()) add("deflection").load = load.name;
    for (const VectorSet& twist : model_.twists) add("speed").twist = twist.name;
    if (!model_.actuators.error.empty()) add("error");
    add("sigma-min");
    add("sigma-max");
    if (!is_along_way_) add("condition").norm = "2";
    add("condition");
    add("determinant");
  }

  QuantityOptions& add(const char* quantity) {
    all.push_back({});
    all.back().quantity = quantity;
    return all.back();
  }

  /// Limits that are no mirror images need the signs of forces.
  void add_forces(const std::string& load) {
    if (is_symmetric(model_.actuators.force)) {
      add("force").load = load;
      return;
    }
    QuantityOptions& least = add("force");
    least.load = load;
    least.least = true;
    QuantityOptions& largest = add("force");
    largest.load = load;
    largest.is_signed = true;
  }

  const Model& model_;
  const bool is_along_way_;
};

/// Returns the limits of a component, as a range of q; nullopt if the model has none.
std::optional<Range> limits_of(const Model& model, const Component& c) {
  const Actuators& a = model.actuators;
  if (c.kind == QuantityKind::kForce && !a.force.empty()) return a.force[c.row];
  if (c.kind == QuantityKind::kSpeed && !a.speed.empty())
    return Range{-a.speed[c.row], a.speed[c.row]};
  return std::nullopt;
}

/// Keeps the better of two results for one component: each end of either is true.
void keep_better(ComponentBound& known, ComponentBound found, bool is_least) {
  const auto is_above = [](const BoundEnd& a, const BoundEnd& b) {
    return !is_at_most(a.exact, b.exact);
  };
  const auto extends = [&](const BoundEnd& a, const BoundEnd& b) {
    return is_least ? is_above(b, a) : is_above(a, b);
  };
  if (known.attained && (!found.attained || extends(*known.attained, *found.attained))) {
    found.attained = known.attained;
    found.place = known.place;
  }
  if (known.proved && (!found.proved || extends(*found.proved, *known.proved)))
    found.proved = known.proved;
  found.is_unbounded = found.is_unbounded || known.is_unbounded;
  found.boxes += known.boxes;
  found.seconds += known.seconds;
  known = std::move(found);
}

/// Bounds all quantities twice: first each component with little time, which is often enough, so
/// that each has an attained end at least; then those that are not closed, with the time that is
/// left.
class DatasheetRun {
 public:
  DatasheetRun(const Request& request, const BoundSettings& settings, const BoundListener& listener)
      : request_(request),
        settings_(settings),
        listener_(listener),
        left_(settings.search.time_limit) {}

  std::vector<Bound> run(std::vector<Quantity> quantities) {
    for (std::size_t i = 0; i < quantities.size() && !is_interrupted(); ++i) {
      const double most = left_ / double(quantities.size() - i);
      const double little = kFirstSeconds * double(quantities[i].components.size());
      // A matrix that takes long to form leaves time for the quantities after it.
      const bool is_last = i + 1 == quantities.size();
      const double forming = is_last ? left_ : kPartToForm * left_;
      bounds_.push_back(bound(std::move(quantities[i]), std::min(little, most), forming));
    }
    std::size_t open = std::size_t(
        std::ranges::count_if(bounds_, [](const Bound& bound) { return !bound.is_closed(); }));
    for (Bound& known : bounds_) {
      if (known.is_closed() || left_ <= 0 || is_interrupted()) continue;
      refine(known, left_ / double(open));
      --open;
    }
    use_singular_values();
    return std::move(bounds_);
  }

  [[nodiscard]] bool is_interrupted() const {
    return settings_.interrupt != nullptr && *settings_.interrupt;
  }

 private:
  Bound bound(Quantity quantity, double seconds, double forming) {
    BoundSettings part = settings_;
    part.search.time_limit = seconds;
    part.forming_limit = forming;
    Bound found = bound_quantity(request_, std::move(quantity), part, listener_);
    left_ -= watch_.lap();
    return found;
  }

  void refine(Bound& known, double seconds) {
    Quantity open = known.quantity;
    open.components.clear();
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < known.components.size(); ++i)
      if (const ComponentBound& c = known.components[i];
          !c.is_closed && !c.is_unbounded && !c.is_empty) {
        open.components.push_back(c.component);
        places.push_back(i);
      }
    Bound found = bound(std::move(open), seconds, left_);
    for (std::size_t i = 0; i < found.components.size(); ++i)
      keep_better(known.components[places[i]], std::move(found.components[i]),
                  known.quantity.is_least);
  }

  /// The condition number is below the largest singular value of all poses by the least.
  void use_singular_values() {
    const ComponentBound* largest = only_component(QuantityKind::kSigmaMax);
    const ComponentBound* least = only_component(QuantityKind::kSigmaMin);
    ComponentBound* condition = only_component(QuantityKind::kCondition2);
    if (!condition || !largest || !least || condition->is_unbounded) return;
    if (!largest->proved || !least->proved) return;
    if (certain_sign(least->proved->exact) != CertainSign::kPositive) return;
    const ex ratio = largest->proved->exact / least->proved->exact;
    if (condition->proved && is_at_most(condition->proved->exact, ratio)) return;
    condition->proved = end_at(ratio);
    const double above = condition->proved->approx;
    condition->is_closed =
        condition->attained && above - condition->attained->approx <= settings_.gap * above;
    if (condition->is_closed) condition->reason.clear();
  }

  /// Returns nullptr if the quantity was not bounded.
  ComponentBound* only_component(QuantityKind kind) {
    for (Bound& bound : bounds_)
      if (bound.quantity.kind == kind && !bound.components.empty()) return &bound.components[0];
    return nullptr;
  }

  static constexpr double kFirstSeconds = 0.25;  ///< for each component
  static constexpr double kPartToForm = 0.5;     ///< of the time that is left

  const Request& request_;
  const BoundSettings& settings_;
  const BoundListener& listener_;
  double left_;
  Stopwatch watch_;
  std::vector<Bound> bounds_;
};

/// Names the quantities that the model has no data for.
void add_without_data(const Model& model, std::vector<std::string>& left_out) {
  if (model.loads.empty()) left_out.emplace_back("force and deflection: the model has no [load]");
  if (model.twists.empty()) left_out.emplace_back("speed: the model has no [twist]");
  if (model.actuators.error.empty())
    left_out.emplace_back("error: the model has no error in [actuators]");
}

}  // namespace

LimitState limit_state(const Model& model, const ComponentBound& c) {
  const std::optional<Range> limits = limits_of(model, c.component);
  if (!limits) return LimitState::kNone;
  if (c.is_unbounded) return LimitState::kExceeded;
  const bool least = c.component.sign < 0;
  const auto is_within = [&](const ex& value) {
    return least ? is_at_most(limits->lo, value) : is_at_most(value, limits->hi);
  };
  if (c.proved && is_within(c.proved->exact)) return LimitState::kKept;
  if (c.attained && !is_within(c.attained->exact)) return LimitState::kExceeded;
  return LimitState::kUnknown;
}

Datasheet make_datasheet(const Request& request, const BoundSettings& settings,
                         const BoundListener& listener) {
  Datasheet sheet;
  std::vector<Quantity> quantities;
  for (const QuantityOptions& question : Questions(request).all) try {
      Quantity quantity = quantity_of(request.model, question);
      if (quantity.kind == QuantityKind::kCondition && quantity.components.size() > kMostPairs)
        throw UsageError(fmt::format("condition: {} pairs of a row and a column; bound it alone",
                                     quantity.components.size()));
      quantities.push_back(std::move(quantity));
    } catch (const UsageError& error) {
      sheet.left_out.emplace_back(error.what());
    }
  if (quantities.empty()) add_without_data(request.model, sheet.left_out);
  DatasheetRun run(request, settings, listener);
  sheet.bounds = run.run(std::move(quantities));
  sheet.is_interrupted = run.is_interrupted();
  return sheet;
}

}  // namespace regulus
