// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/bound/datasheet.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/model/certain_sign.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::inline bounding {
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
  explicit Questions(const Model& model) : model_(model) { collect(); }

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
};

/// Returns the limits of a component, as a range of q; nullopt if the model has none.
std::optional<Range> limits_of(const Model& model, const Component& c) {
  const Actuators& a = model.actuators;
  if (c.kind == QuantityKind::kForce && !a.force.empty()) return a.force[c.row];
  if (c.kind == QuantityKind::kSpeed && !a.speed.empty())
    return Range{-a.speed[c.row], a.speed[c.row]};
  return std::nullopt;
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
  for (const QuantityOptions& question : Questions(request.model).all) try {
      Quantity quantity = quantity_of(request.model, question);
      if (quantity.kind == QuantityKind::kCondition && quantity.components.size() > kMostPairs)
        throw UsageError(fmt::format("condition: {} pairs of a row and a column; bound it alone",
                                     quantity.components.size()));
      quantities.push_back(std::move(quantity));
    } catch (const UsageError& error) {
      sheet.left_out.emplace_back(error.what());
    }
  Stopwatch watch;
  double left = settings.search.time_limit;
  for (std::size_t i = 0; i < quantities.size() && !sheet.is_interrupted; ++i) {
    BoundSettings part = settings;
    part.search.time_limit = left / double(quantities.size() - i);
    part.forming_limit = left;
    sheet.bounds.push_back(bound_quantity(request, std::move(quantities[i]), part, listener));
    left -= watch.lap();
    sheet.is_interrupted = settings.interrupt != nullptr && *settings.interrupt;
  }
  return sheet;
}

}  // namespace regulus::bounding
