// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/datasheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/way/margin_checkpoint.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/time_budget.hpp"
#include "runtime/cluster/bytes.hpp"

namespace regulus::detail {
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
  explicit Questions(const Request& request) : model_(request.model) { collect(request); }

  std::vector<QuantityOptions> all;

 private:
  void collect(const Request& request) {
    for (const VectorSet& load : model_.loads) add_forces(load.name);
    for (const VectorSet& load : model_.loads)
      if (!model_.actuators.stiffness.empty()) add("deflection").load = load.name;
    for (const VectorSet& twist : model_.twists) add("speed").twist = twist.name;
    if (model_.closure && !model_.actuators.speed.empty()) add("speed");
    if (!model_.actuators.error.empty()) add("error");
    if (model_.closure && has_finite_errors(request)) add("finite-error");
    add("sigma-min");
    add("sigma-max");
    add("condition").norm = "2";
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
std::optional<Range> stated_limits(const Model& model, const Component& c) {
  const Actuators& a = model.actuators;
  if (c.kind == QuantityKind::kForce && !a.force.empty()) return a.force[c.row];
  if (c.kind == QuantityKind::kSpeed && !a.speed.empty() && !model.closure)
    return Range{-a.speed[c.row], a.speed[c.row]};
  return std::nullopt;
}

/// Keeps the better of two results for one component: each end of either is true. `again`: the proofs
/// of the second; `held`: those of the first, and of what is kept.
void keep_better(ComponentBound& known, ComponentBound found, bool is_least, HeldFiles& again,
                 HeldFiles& held) {
  const auto is_above = [](const BoundEnd& a, const BoundEnd& b) {
    return !is_at_most(a.exact, b.exact);
  };
  const auto extends = [&](const BoundEnd& a, const BoundEnd& b) {
    return is_least ? is_above(b, a) : is_above(a, b);
  };
  if (known.attained && (!found.attained || extends(*known.attained, *found.attained))) {
    found.attained = known.attained;
    found.place = known.place;
    found.proofs.keep_singular(known.proofs);
  } else {
    held.take(again, found.proofs.singular_file());
  }
  if (known.proved && (!found.proved || extends(*found.proved, *known.proved))) {
    found.proved = known.proved;
    found.proofs.keep_safe(known.proofs);
  } else {
    held.take(again, found.proofs.safe_file());
  }
  found.is_unbounded = found.is_unbounded || known.is_unbounded;
  found.boxes += known.boxes;
  found.seconds += known.seconds;
  known = std::move(found);
}

/// A quantity with the words that asked for it.
struct AskedQuantity {
  Quantity quantity;
  std::string name;  ///< in names of files and in a checkpoint: "least_force_payload"
};

std::string name_of(const QuantityOptions& asked) {
  std::string name = asked.quantity;
  if (asked.least) name = "least_" + name;
  if (asked.is_signed) name = "largest_" + name;
  for (const std::string& word : {asked.load, asked.twist, asked.norm})
    if (!word.empty()) name += '_' + word;
  return name;
}

std::string part_of(const AskedQuantity& asked) { return asked.name + ' '; }

/// Returns the quantities that the model has data for; `left_out`: why it has none for the others.
std::vector<AskedQuantity> quantities_of(const Request& request,
                                         std::vector<std::string>& left_out) {
  std::vector<AskedQuantity> quantities;
  for (const QuantityOptions& question : Questions(request).all) try {
      Quantity quantity = quantity_of(request.model, question);
      if (quantity.kind == QuantityKind::kCondition && quantity.components.size() > kMostPairs)
        throw UsageError(fmt::format("condition: {} pairs of a row and a column; bound it alone",
                                     quantity.components.size()));
      require_finite_errors(request, quantity);
      quantities.push_back({std::move(quantity), name_of(question)});
    } catch (const UsageError& error) {
      // One reason may hold for the condition number in either norm.
      if (std::ranges::find(left_out, error.what()) == left_out.end())
        left_out.emplace_back(error.what());
    }
  return quantities;
}

std::string certificate_of(const std::string& certificate, const std::string& name) {
  return certificate.empty() ? certificate : certificate + '.' + name;
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
        budget_(TimeBudget::of_option(settings.search.time_limit)) {}

  std::vector<Bound> run(std::vector<AskedQuantity> quantities) {
    for (std::size_t i = 0; i < quantities.size() && !is_interrupted(); ++i) {
      const std::size_t open = quantities.size() - i;
      const double little = kFirstSeconds * double(quantities[i].quantity.components.size());
      // A matrix that takes long to form leaves time for the quantities after it.
      const double forming = open == 1 ? budget_.left() : kPartToForm * budget_.left();
      bounds_.push_back(
          bound(quantities[i], std::min(little, budget_.share(open).left()), forming, held_));
    }
    std::size_t open = std::size_t(
        std::ranges::count_if(bounds_, [](const Bound& bound) { return !bound.is_closed(); }));
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      if (bounds_[i].is_closed() || budget_.is_over() || is_interrupted()) continue;
      refine(bounds_[i], quantities[i].name, budget_.share(open).left());
      --open;
    }
    if (settings_.certificate.empty()) use_singular_values();
    put_in_place();
    return std::move(bounds_);
  }

  [[nodiscard]] bool is_interrupted() const {
    return settings_.interrupt != nullptr && *settings_.interrupt;
  }

 private:
  Bound bound(const AskedQuantity& asked, double seconds, double forming, HeldFiles& held) {
    BoundSettings part = settings_;
    part.search.time_limit = TimeBudget::option(seconds);
    part.forming_limit = forming;
    part.certificate = certificate_of(settings_.certificate, asked.name);
    part.part = part_of(asked);
    part.placing.held = &held;
    return bound_quantity(request_, asked.quantity, part, listener_);
  }

  void refine(Bound& known, const std::string& name, double seconds) {
    AskedQuantity open{known.quantity, name};
    open.quantity.components.clear();
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < known.components.size(); ++i)
      if (const ComponentBound& c = known.components[i];
          !c.is_closed && !c.is_unbounded && !c.is_empty) {
        open.quantity.components.push_back(c.component);
        places.push_back(i);
      }
    HeldFiles again;
    Bound found = bound(open, seconds, budget_.left(), again);
    for (std::size_t i = 0; i < found.components.size(); ++i)
      keep_better(known.components[places[i]], std::move(found.components[i]),
                  known.quantity.is_least, again, held_);
  }

  /// Proofs are put in place at the end of the whole run.
  void put_in_place() {
    if (settings_.placing.held == nullptr) return held_.put_in_place();
    for (const Bound& bound : bounds_)
      for (const ComponentBound& c : bound.components)
        for (const std::string& file : {c.proofs.safe_file(), c.proofs.singular_file()})
          settings_.placing.held->take(held_, file);
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
  const TimeBudget budget_;
  HeldFiles held_;
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
  const std::optional<Range> limits = stated_limits(model, c.component);
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

std::string limit_text(const Model& model, const ComponentBound& c) {
  const std::optional<Range> limits = stated_limits(model, c.component);
  if (!limits) return "";
  const ex& limit = c.component.sign < 0 ? limits->lo : limits->hi;
  return fmt::format("{:.6g}", mid(enclose_constant(limit, "a limit")));
}

Datasheet make_datasheet(const Request& request, const BoundSettings& settings,
                         const BoundListener& listener) {
  Datasheet sheet;
  std::vector<AskedQuantity> quantities = quantities_of(request, sheet.left_out);
  if (quantities.empty()) add_without_data(request.model, sheet.left_out);
  DatasheetRun run(request, settings, listener);
  sheet.bounds = run.run(std::move(quantities));
  sheet.is_interrupted = run.is_interrupted();
  return sheet;
}

Quantity quantity_of_part(const Request& request, const std::string& part) {
  std::vector<std::string> left_out;
  for (AskedQuantity& asked : quantities_of(request, left_out))
    if (part_of(asked) == part) return std::move(asked.quantity);
  throw cluster::MalformedMessage();
}

std::vector<OutputFile> datasheet_files(const Request& request, const std::string& certificate) {
  std::vector<OutputFile> files;
  std::vector<std::string> left_out;
  for (const AskedQuantity& asked : quantities_of(request, left_out))
    std::ranges::move(certificate_files(asked.quantity, certificate_of(certificate, asked.name)),
                      std::back_inserter(files));
  return files;
}

nlohmann::ordered_json checkpointed_datasheet(const Request& request, const SearchOptions& search) {
  nlohmann::ordered_json question = checkpointed_question(request, search);
  question["datasheet"] = true;
  return question;
}

}  // namespace regulus::detail
