// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/solve/platform_legs.hpp"

#include <algorithm>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/kernel/program/interpreter.hpp"
#include "codegen/kernel/program/interval_arithmetic.hpp"
#include "codegen/kernel/symbolic/from_ginac.hpp"
#include "codegen/kernel/symbolic/lowering.hpp"
#include "codegen/model/exact/exact_double.hpp"
#include "codegen/question/solve/nominal.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// The values of symbols as enclosures of them.
class SymbolRanges {
 public:
  void add(const GiNaC::realsymbol& symbol, const ex& middle, const ex& spread) {
    const std::string name = "v" + std::to_string(names_.size());
    meaning_.emplace(symbol, variable(name));
    names_.push_back(name);
    ranges_.push_back(hull(enclose_constant(middle - spread, "a tolerance"),
                           enclose_constant(middle + spread, "a tolerance")));
  }

  [[nodiscard]] Interval enclose(const ex& expression, const std::string& what) const {
    Lowering lowering(names_, {});
    lowering.output(GinacReader(meaning_).read(expression));
    const Program program = std::move(lowering).finish();
    IntervalArithmetic arithmetic;
    const auto values = evaluate<IntervalArithmetic>(program, std::span<const Interval>(ranges_),
                                                     std::span<const Interval>(), arithmetic);
    if (arithmetic.undefined())
      throw InputError::statement("", 0, what + " has no finite value within the tolerances",
                                  "make the tolerances smaller", what);
    return values.front();
  }

 private:
  SymbolMeaning meaning_;
  std::vector<std::string> names_;
  std::vector<Interval> ranges_;
};

/// A point of a ball is taken anywhere in the box around it.
SymbolRanges geometry_of(const Model& model) {
  SymbolRanges ranges;
  for (const GeometryParameter& g : model.geometry)
    ranges.add(g.symbol, g.value,
               g.ball >= 0 ? model.balls.at(static_cast<std::size_t>(g.ball)).radius : g.tolerance);
  return ranges;
}

/// Returns for each anchor the first one that is equal to it, exactly. `value_of`: takes an expression.
template <class AnchorOf, class ValueOf>
std::array<std::size_t, 6> points_of(const AnchorOf& anchor_of, const ValueOf& value_of) {
  std::array<std::size_t, 6> points{};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto is_same = [&](std::size_t k) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (!value_of(anchor_of(i)[axis] - anchor_of(k)[axis]).expand().is_zero()) return false;
      return true;
    };
    while (points[i] < i && !is_same(points[i])) ++points[i];
  }
  return points;
}

/// The legs without their lengths; `enclose`: takes an expression and what it is called.
template <class Enclose, class ValueOf>
GoughLegs legs_between_anchors(const Model& model, const Enclose& enclose,
                               const ValueOf& value_of) {
  GoughLegs legs;
  for (std::size_t i = 0; i < legs.length.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      legs.base[i][axis] = enclose(model.legs[i].base[axis], "an anchor of the base");
      legs.platform[i][axis] = enclose(model.legs[i].platform[axis], "an anchor of the platform");
    }
  legs.base_point = points_of([&](std::size_t i) { return model.legs[i].base; }, value_of);
  legs.platform_point = points_of([&](std::size_t i) { return model.legs[i].platform; }, value_of);
  return legs;
}

/// The squared length of a leg of nominal geometry at poses within the control errors.
Interval square_near_pose(const Request& request, const ExtensibleLeg& leg) {
  const NominalGeometry nominal(request.model);
  const std::vector<ex> pose = pose_of(request.motion);
  SymbolRanges ranges;
  for (std::size_t i = 0; i < pose.size(); ++i)
    ranges.add(request.model.pose[i].symbol, pose[i],
               request.motion.error.empty() ? ex(0) : request.motion.error[i]);
  Interval square(0.0);
  for (const ex& part : leg.vector) square += sqr(ranges.enclose(nominal.at(part), "a length"));
  return square;
}

constexpr long kPartsOfLength = 1L << 40, kPartsOfPose = 8;
ex with_room(const ex& error, long parts) { return error * (parts + 1) / parts; }

}  // namespace

std::vector<ex> squared_lengths(const Request& request) {
  std::vector<ex> squares;
  for (const ex& length : request.motion.legs) squares.push_back(pow(length, 2));
  if (!squares.empty()) return squares;
  const NominalGeometry nominal(request.model);
  const std::vector<ex> pose = pose_of(request.motion);
  GiNaC::exmap values;
  for (std::size_t i = 0; i < pose.size(); ++i) values[request.model.pose[i].symbol] = pose[i];
  for (const ExtensibleLeg& leg : request.model.legs) {
    ex square = 0;
    for (const ex& part : leg.vector) square += pow(nominal.at(part).subs(values), 2);
    squares.push_back(square);
  }
  return squares;
}

std::vector<ex> errors_of_squares(const Request& request) {
  const std::vector<ex> squares = squared_lengths(request), &error = request.motion.error;
  std::vector<ex> result(squares.size(), ex(0));
  if (std::ranges::all_of(error, [](const ex& x) { return x.is_zero(); })) return result;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    if (!request.motion.legs.empty()) {
      result[i] =
          with_room(error[i] * (2 * abs(request.motion.legs[i]) + error[i]), kPartsOfLength);
      continue;
    }
    const Interval change =
        square_near_pose(request, request.model.legs[i]) - enclose_constant(squares[i], "a length");
    result[i] = with_room(exact_number(mag(change)), kPartsOfPose);
  }
  return result;
}

Interval enclose_uncertain(const Model& model, const ex& expression, const char* what) {
  return geometry_of(model).enclose(expression, what);
}

GoughLegs enclose_legs(const Request& request) {
  const NominalGeometry nominal(request.model);
  GoughLegs legs = legs_between_anchors(
      request.model,
      [&](const ex& x, const char* what) { return enclose_constant(nominal.at(x), what); },
      [&](const ex& x) { return nominal.at(x); });
  const std::vector<ex> squares = squared_lengths(request);
  for (std::size_t i = 0; i < squares.size(); ++i)
    legs.length[i] = request.motion.legs.empty()
                         ? sqrt(enclose_constant(squares[i], "a length"))
                         : enclose_constant(request.motion.legs[i], "a length");
  return legs;
}

GoughLegs enclose_uncertain_legs(const Request& request) {
  const SymbolRanges ranges = geometry_of(request.model);
  GoughLegs legs = legs_between_anchors(
      request.model, [&](const ex& x, const char* what) { return ranges.enclose(x, what); },
      [](const ex& x) { return x; });
  const GoughLegs nominal = enclose_legs(request);
  for (std::size_t i = 0; i < legs.length.size(); ++i) {
    const Interval around =
        request.motion.legs.empty()
            ? sqrt(square_near_pose(request, request.model.legs[i]))
            : nominal.length[i] +
                  Interval(-1.0, 1.0) * enclose_constant(request.motion.error[i], "an error");
    legs.length[i] = hull(nominal.length[i], around);
  }
  return legs;
}

bool has_errors(const Motion& motion) {
  return !std::ranges::all_of(motion.error, [](const ex& x) { return x.is_zero(); });
}

bool has_tolerances(const Request& request) {
  return has_errors(request.motion) ||
         std::ranges::any_of(request.model.geometry, [](const GeometryParameter& g) {
           return !g.tolerance.is_zero() || g.ball >= 0;
         });
}

}  // namespace regulus::detail
