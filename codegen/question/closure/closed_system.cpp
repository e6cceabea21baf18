// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closed_system.hpp"

#include <algorithm>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/model/mechanism/closure_matrix.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

class SystemBuilder {
 public:
  SystemBuilder(const Request& request, DerivativesBy by,
                const std::vector<PoseParameter>& constants)
      : given_(request), uncertain_(uncertain_names(request)), by_(by), constants_(constants) {}

  ClosedSystem build() {
    const Closure& closure = *given_.model.closure;
    Model& model = system_.request.model;
    model.name = given_.model.name;
    model.path = given_.model.path;
    model.sha256 = given_.model.sha256;
    system_.request.motion.name = given_.motion.name;
    for (const MotionParameter& p : given_.motion.parameters)
      add({p.symbol, p.name, p.unit}, p.range, {p.name, p.unit, VariableKind::kMotion});
    system_.shape.parameters = model.pose.size();
    add_geometry();
    add_pose();
    system_.shape.variables = model.pose.size();
    if (by_ == DerivativesBy::kVariablesAndNominal) add_nominal(closure);
    system_.shape.unknowns = closure.unknowns.size() + copies_.size();
    if (by_ != DerivativesBy::kUnknowns) system_.shape.differentiated = system_.shape.variables;
    if (by_ == DerivativesBy::kVariablesAndPose) system_.shape.driven = given_.model.pose.size();
    for (std::size_t i = 0; i < closure.unknowns.size(); ++i)
      add_variable(closure.unknowns[i], typical_range(closure.start[i]));
    for (std::size_t i = 0; i < copies_.size(); ++i)
      add_variable(copies_[i], typical_range(closure.start[i]));
    for (const PoseParameter& constant : constants_) add_variable(constant, typical_range(0));
    write_matrix(closure);
    write_conditions();
    return std::move(system_);
  }

 private:
  /// The forms of a kernel are chosen for these values. They hold for all.
  static Range typical_range(const ex& start) {
    const ex reach = 1 + abs(start) / 2;
    return {start - reach, start + reach};
  }

  void add_variable(const PoseParameter& variable, const Range& range) {
    Motion& motion = system_.request.motion;
    system_.request.model.pose.push_back(variable);
    motion.parameters.push_back({variable.symbol, variable.name, variable.unit, range});
    motion.pose.push_back(variable.symbol);
    motion.error.push_back(0);
  }

  void add(const PoseParameter& variable, const Range& range, VariableLabel label) {
    add_variable(variable, range);
    system_.labels.push_back(std::move(label));
  }

  /// A point in a ball is taken anywhere in the box around it.
  void add_geometry() {
    const Model& given = given_.model;
    for (const GeometryParameter& g : given.geometry) {
      if (!uncertain_.contains(g.name)) {
        system_.request.model.geometry.push_back(g);
        system_.request.model.geometry.back().ball =
            -1;  // it has no radius, and this model no ball
        continue;
      }
      const ex spread = g.ball >= 0 ? given.balls.at(std::size_t(g.ball)).radius : g.tolerance;
      add({g.symbol, g.name, "1"}, {g.value - spread, g.value + spread},
          {g.name, "1", VariableKind::kGeometry, false, g.group, g.ball >= 0});
    }
  }

  /// Notes what the pose parameters are, as commanded and with their errors.
  void add_pose() {
    const Motion& motion = given_.motion;
    for (std::size_t i = 0; i < given_.model.pose.size(); ++i) {
      const PoseParameter& pose = given_.model.pose[i];
      commanded_[pose.symbol] = motion.pose[i];
      actual_[pose.symbol] = motion.pose[i];
      if (motion.error.empty() || motion.error[i].is_zero()) continue;
      const GiNaC::realsymbol error("error_of_" + pose.name);
      actual_[pose.symbol] = motion.pose[i] + error;
      add({error, "error_of_" + pose.name, pose.unit}, {-motion.error[i], motion.error[i]},
          {pose.name + "_error", pose.unit, VariableKind::kControl, false, "", false});
    }
  }

  /// Notes what expressions of the model mean for the mechanism without errors.
  void add_nominal(const Closure& closure) {
    for (const GeometryParameter& g : given_.model.geometry)
      if (uncertain_.contains(g.name)) middles_[g.symbol] = g.value;
    nominal_ = middles_;
    for (const auto& [pose, commanded] : commanded_) nominal_[pose] = commanded.subs(middles_);
    for (const PoseParameter& unknown : closure.unknowns) {
      const std::string name = unknown.name + "_nominal";
      copies_.push_back({GiNaC::realsymbol(name), name, unknown.unit});
      nominal_[unknown.symbol] = copies_.back().symbol;
    }
  }

  /// Adds what must be defined, also without errors.
  void require(const ex& condition, const GiNaC::exmap& actual, const GiNaC::exmap& nominal) {
    std::vector<ex>& conditions = system_.request.model.must_be_defined;
    conditions.push_back(condition.subs(actual));
    if (!copies_.empty()) conditions.push_back(condition.subs(nominal));
  }

  void write_matrix(const Closure& closure) {
    Model& model = system_.request.model;
    const std::size_t n = system_.shape.unknowns, m = system_.shape.variables;
    const std::size_t derivatives = n + system_.shape.differentiated, d = system_.shape.driven;
    model.matrix = GiNaC::matrix(unsigned(1 + derivatives + d), unsigned(n));
    for (unsigned j = 0; j < n; ++j) {
      const bool is_nominal = j >= closure.equations.size();
      const ex equation =
          differentiable(is_nominal ? closure.equations[j - closure.equations.size()].subs(nominal_)
                                    : closure.equations[j].subs(actual_));
      model.matrix(0, j) = equation;
      for (std::size_t k = 0; k < derivatives; ++k)
        model.matrix(unsigned(1 + k), j) = equation.diff(model.pose[k < n ? m + k : k - n].symbol);
      if (is_nominal) continue;
      const ex as_written = differentiable(closure.equations[j]);
      for (std::size_t k = 0; k < d; ++k)
        model.matrix(unsigned(1 + derivatives + k), j) =
            as_written.diff(given_.model.pose[k].symbol).subs(actual_);
    }
  }

  void write_conditions() {
    Motion& motion = system_.request.motion;
    for (const ex& e : given_.model.must_be_defined) require(e, actual_, nominal_);
    for (const ex& e : given_.motion.must_be_defined) require(e.subs(commanded_), {}, middles_);
    for (const ex& e : given_.motion.constraints) motion.constraints.push_back(e.subs(commanded_));
    for (const ex& e : given_.motion.reach) motion.reach.push_back(e.subs(commanded_));
  }

  const Request& given_;
  const std::set<std::string> uncertain_;
  const DerivativesBy by_;
  const std::vector<PoseParameter>& constants_;
  GiNaC::exmap commanded_, actual_;
  GiNaC::exmap nominal_, middles_;  ///< without errors: of the model, and of uncertain quantities
  std::vector<PoseParameter> copies_;  ///< of the unknowns, without errors
  ClosedSystem system_;
};

bool has_atan2(const ex& expression) {
  for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part)
    if (GiNaC::is_a<GiNaC::function>(*part) &&
        GiNaC::ex_to<GiNaC::function>(*part).get_name() == "atan2")
      return true;
  return false;
}

}  // namespace

ClosedSystem close(const Request& request, DerivativesBy by,
                   const std::vector<PoseParameter>& constants) {
  for (const ex& equation : request.model.closure->equations)
    if (has_atan2(equation))
      throw UsageError(
          "an equation of [closure] has atan2, which jumps; write the equation with sin and cos");
  return SystemBuilder(request, by, constants).build();
}

SystemBoxes::SystemBoxes(const Problem& problem, const MatrixScaling& scaling,
                         const ClosedShape& shape)
    : shape_(shape),
      constants_(problem.outer.begin() + std::ptrdiff_t(std::min(shape.variables + shape.unknowns,
                                                                 problem.outer.size())),
                 problem.outer.end()),
      boxes_(problem, scaling, 0) {}

void SystemBoxes::evaluate(std::span<const Box> boxes, bool has_rates) {
  has_rates_ = has_rates;
  if (constants_.empty()) return boxes_.evaluate_entries(boxes, has_rates);
  std::vector<Box> all;
  for (const Box& box : boxes) all.push_back(with_constants(box));
  boxes_.evaluate_entries(all, has_rates);
}

/// Appends the derivatives by unknowns and by variables.
void SystemBoxes::take(std::span<const Interval> entries, std::vector<Interval>& by_unknown,
                       std::vector<Interval>& by_variable) const {
  const std::size_t n = shape_.unknowns, m = shape_.differentiated;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k) by_unknown.push_back(entries[(1 + k) * n + j]);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < m; ++k) by_variable.push_back(entries[(1 + n + k) * n + j]);
}

std::optional<SystemBoxes::System> SystemBoxes::at(std::size_t lane) const {
  if (!boxes_.is_defined(lane)) return std::nullopt;
  const std::size_t n = shape_.unknowns, m = shape_.variables;
  const BoxMatrices::Entries entries = boxes_.matrix(lane).center;
  System system;
  system.value.assign(entries.begin(), entries.begin() + std::ptrdiff_t(n));
  take(entries, system.by_unknown, system.by_variable);
  const std::size_t first = (1 + n + shape_.differentiated) * n;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < shape_.driven; ++k)
      system.by_pose.push_back(entries[first + k * n + j]);
  for (std::size_t by = m - shape_.differentiated; has_rates_ && by < m + n; ++by)
    take(boxes_.slope(lane, by), system.rates_by_unknown, system.rates_by_variable);
  return system;
}

std::vector<char> SystemBoxes::are_outside(std::span<const Box> boxes) {
  std::vector<char> outside(boxes.size(), 0);
  if (!boxes_.has_constraints()) return outside;
  boxes_.evaluate(boxes);
  for (std::size_t lane = 0; lane < boxes.size(); ++lane) outside[lane] = boxes_.is_outside(lane);
  return outside;
}

}  // namespace regulus::detail
