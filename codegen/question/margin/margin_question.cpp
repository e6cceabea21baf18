// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/margin/margin_question.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/answer/report/number_text.hpp"
#include "codegen/kernel/formulation/variable_ranges.hpp"
#include "codegen/model/constants.hpp"
#include "codegen/model/drawing.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/exact/sign.hpp"
#include "codegen/model/mechanism/joint_limits.hpp"
#include "codegen/model/overrides.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

MarginValue read_value(const std::string& text, const char* option,
                       NumberUnit unit = NumberUnit::kPlain) {
  MarginValue value{text, 0, 0, {}};
  from_option(option, [&] {
    const Place place{.file = "", .key = option};
    const ParsedExpression term = parse_constant(text, place, unit);
    if (std::string_view(option) == "--grow" && certain_sign(term.value) == CertainSign::kNegative)
      throw UsageError("--grow: '" + text +
                       "' is below 0, and the values of a margin begin at 0 or above; they are the "
                       "upper end of the range, whose lower end stays as in the motion");
    value.exact = checked_nonnegative(term, place);
    value.must_be_defined = term.must_be_defined;
    value.approx = approx_value(value.exact).value_or(0);
  });
  return value;
}

bool is_range(const std::string& text) { return text.find(':') != std::string::npos; }
void read_range(MarginQuestion& question, const std::string& text, const char* option) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
    throw UsageError(std::string(option) + ": found '" + text + "', expected LO:HI");
  question.low = read_value(text.substr(0, colon), option);
  if (colon + 1 == text.size()) return;
  question.high = read_value(text.substr(colon + 1), option);
  // The bracket is stored in doubles, so the ends must differ as doubles, too.
  if (certain_sign(question.high->exact - question.low.exact) != CertainSign::kPositive ||
      !(question.low.approx < question.high->approx))
    throw UsageError(std::string(option) + ": found '" + text + "', expected LO below HI");
}

/// The size of a range has a meaning only if a pose parameter is its own motion parameter.
void require_box_variety(const Request& request) {
  const Motion& motion = request.motion;
  for (const MotionParameter& p : motion.parameters) {
    const auto same = [&p](const PoseParameter& pose) { return pose.symbol.is_equal(p.symbol); };
    if (std::none_of(request.model.pose.begin(), request.model.pose.end(), same))
      throw UsageError("--scale: the motion '" + motion.name + "' is not a box, because '" +
                       p.name +
                       "' is not a pose parameter; choose a motion with ranges of the pose only");
  }
}

void scale_ranges(Motion& motion, const ex& scale) {
  for (MotionParameter& p : motion.parameters) {
    const ex middle = (p.range.lo + p.range.hi) / 2;
    const ex half = (p.range.hi - p.range.lo) / 2 * scale;
    p.range = {middle - half, middle + half};
  }
}

MotionParameter* find_parameter(Motion& motion, const std::string& name) {
  const auto found = std::ranges::find(motion.parameters, name, &MotionParameter::name);
  return found == motion.parameters.end() ? nullptr : &*found;
}

/// True if c ≤ 0 at a value of p ≥ 0 is shown to imply it at every larger one: dc/dp = -k·pⁿ, k ≥ 0.
bool loosens(const ex& c, const ex& p) {
  constexpr int kMostPowers = 8;
  const ex slope = c.diff(GiNaC::ex_to<GiNaC::symbol>(p));
  for (int n = 0; n <= kMostPowers; ++n) {
    const ex factor = (slope / pow(p, n)).normal();
    if (!symbols_of(factor).empty()) continue;
    const CertainSign sign = certain_sign(factor);
    return sign == CertainSign::kNegative || factor.is_zero();
  }
  return false;
}

bool none_has(const std::vector<ex>& expressions, const ex& symbol) {
  return std::ranges::none_of(expressions, [&](const ex& e) { return e.has(symbol); });
}

/// True if p is the size of a shape: the poses at one value of p are among those at a larger one.
/// Then the set of all values up to v is the set at v.
bool is_size(const Motion& motion, const MotionParameter& p) {
  return certain_sign(p.range.lo) != CertainSign::kNegative &&
         certain_sign(p.range.lo) != CertainSign::kUnknown && none_has(motion.pose, p.symbol) &&
         none_has(motion.error, p.symbol) && none_has(motion.must_be_defined, p.symbol) &&
         std::ranges::all_of(motion.constraints,
                             [&](const auto& c) { return loosens(c, p.symbol); });
}

void set_parameter(Motion& motion, const MarginQuestion& question, const ex& end) {
  MotionParameter* p = find_parameter(motion, question.groups);
  const ex low = is_size(motion, *p) ? end : p->range.lo;
  p->range = {question.is_two_sided ? ex(-end) : low, end};
}

/// A parameter grows from the low end of its declared range.
void require_parameter(Request& request, const MarginQuestion& question) {
  const MotionParameter* p = find_parameter(request.motion, question.groups);
  if (p == nullptr)
    throw UsageError("--grow: the motion '" + request.motion.name + "' has no parameter '" +
                     question.groups + "' with a range");
  if (certain_sign(p->range.lo - question.low.exact) == CertainSign::kPositive)
    throw UsageError("--grow: LO is " + question.low.text + ", below the range of '" +
                     question.groups + "', which begins at " + formula_text(p->range.lo));
}

/// Sets the ranges of the control errors, whose variables are in the order of the pose parameters.
/// `formed`: a request in which every error that may grow is above 0.
void set_errors(std::vector<Variable>& variables, const Request& request, const Request& formed) {
  std::size_t i = 0;
  for (Variable& variable : variables) {
    if (variable.kind != VariableKind::kControl) continue;
    while (formed.motion.error.at(i).is_zero()) ++i;
    const ex error = request.motion.error.at(i++);
    variable.range = {-error, error};
  }
}

/// Removes the tubes with a range; returns their number. The names may be left out.
int take_tube(MarginQuestion& question, std::vector<std::string>& tubes) {
  int ranges = 0;
  for (std::size_t i = tubes.size(); i-- > 0;) {
    if (!is_range(tubes[i])) continue;
    ++ranges;
    question.quantity = MarginQuantity::kTube;
    const std::size_t equals = tubes[i].find('=');
    const std::size_t begin = equals == std::string::npos ? 0 : equals + 1;
    question.groups = tubes[i].substr(0, begin);
    read_range(question, tubes[i].substr(begin), "--tube");
    tubes.erase(tubes.begin() + std::ptrdiff_t(i));
  }
  return ranges;
}

}  // namespace

MarginValue decimal_value(double value) {
  return {fmt::format("{}", value), shortest_decimal(value), value, {}};
}

MarginValue value_at(const MarginQuestion& question, double planned) {
  if (planned == question.low.approx) return question.low;
  if (question.high && planned == question.high->approx) return *question.high;
  return decimal_value(planned);
}

MarginValue forming_value(const MarginQuestion& question) {
  return question.high ? *question.high : decimal_value(1);
}

MarginQuestion take_question(ModelOptions& model, const GrowingSize& size) {
  MarginQuestion question;
  question.beyond_limits = model.beyond_limits;
  int ranges = 0;
  auto& tolerances = model.tolerances;
  for (std::size_t i = tolerances.size(); i-- > 0;) {
    if (!is_range(tolerances[i])) continue;
    ++ranges;
    question.quantity = MarginQuantity::kTolerance;
    const auto [groups, range] = split_assignment(tolerances[i], "--tolerance");
    question.groups = groups;
    read_range(question, range, "--tolerance");
    tolerances.erase(tolerances.begin() + std::ptrdiff_t(i));
  }
  if (is_range(model.alpha)) {
    ++ranges;
    question.quantity = MarginQuantity::kAlpha;
    read_range(question, model.alpha, "--alpha");
    model.alpha.clear();
  }
  if (!size.scale.empty()) {
    ++ranges;
    question.quantity = MarginQuantity::kScale;
    read_range(question, size.scale, "--scale");
  }
  if (!size.parameter.empty()) {
    ++ranges;
    question.quantity = MarginQuantity::kParameter;
    const auto [name, range] = split_assignment(size.parameter, "--grow");
    question.groups = name;
    read_range(question, range, "--grow");
  }
  ranges += take_tube(question, model.tubes);
  if (ranges != 1)
    throw UsageError(
        fmt::format("margin: {} options have a range LO:HI, such as 0:0.5 (one number is a value, "
                    "no range); give exactly one: --tolerance GROUP=LO:HI, --alpha LO:HI, --scale "
                    "LO:HI, --grow p=LO:HI or --tube p=LO:HI",
                    ranges));
  return question;
}

MarginRequest::MarginRequest(Request nominal, const MarginQuestion& question)
    : nominal_(std::move(nominal)), question_(question) {
  auto& conditions = nominal_.model.must_be_defined;
  append(conditions, question.low.must_be_defined);
  if (question.high) append(conditions, question.high->must_be_defined);
  require_growth();
}

void MarginRequest::require_growth() const {
  const bool is_path = nominal_.motion.trajectory != nullptr;
  if (question_.quantity == MarginQuantity::kScale && is_path)
    throw UsageError("--scale: a motion along way-points has no ranges; use --tube p=LO:HI");
  // A bound adds its parameter to those of the pieces.
  const bool is_added = std::ranges::any_of(
      nominal_.motion.parameters, [this](const auto& p) { return p.name == question_.groups; });
  if (question_.quantity == MarginQuantity::kParameter && is_path && !is_added)
    throw UsageError("--grow: a motion along way-points has no ranges; use --tube p=LO:HI");
  if (question_.quantity == MarginQuantity::kScale) require_box_variety(nominal_);
  if (question_.quantity == MarginQuantity::kParameter) {
    Request request = nominal_;
    require_parameter(request, question_);
  }
  if (question_.quantity == MarginQuantity::kTube) require_plain_tube();
  const bool ranges_grow = question_.quantity == MarginQuantity::kScale ||
                           question_.quantity == MarginQuantity::kParameter;
  // A question that has left the limits before anything grows may leave them.
  if (ranges_grow && !question_.beyond_limits && !nominal_.model.limits.empty() &&
      !find_excursion(nominal_.model, nominal_.motion))
    require_limits();
  if (question_.quantity == MarginQuantity::kAlpha &&
      nominal_.model.matrix.rows() != nominal_.model.matrix.cols())
    throw UsageError(
        "--alpha: the matrix is not square, so it has no determinant; use --tolerance, --scale or "
        "--grow");
}

/// Ranges that grow do not leave the limits of the joints, unless the question says that they may.
void MarginRequest::require_limits() const {
  const char* const option = question_.quantity == MarginQuantity::kScale ? "--scale" : "--grow";
  if (!question_.high) {
    const bool is_free = question_.quantity == MarginQuantity::kParameter &&
                         std::ranges::none_of(nominal_.model.pose, [this](const auto& p) {
                           return p.name == question_.groups;
                         });
    if (is_free) return;
    throw UsageError(std::string(option) +
                     ": the joints of this robot have limits, and LO: has no end; write LO:HI, or "
                     "leave the limits by --beyond-limits");
  }
  const Request grown = grown_to(*question_.high);
  if (const auto found = find_excursion(grown.model, grown.motion))
    throw UsageError(std::string(option) + ": at " + question_.high->text + ", " + found->sentence +
                     "; write a smaller HI, or leave the limits by --beyond-limits");
}

/// Values between the ends are decimals, which are in the unit of the pose parameter.
void MarginRequest::require_plain_tube() const {
  const std::vector<ex> unit = grown_to(decimal_value(1)).motion.error;
  const std::vector<ex> nominal = nominal_.motion.error;
  for (const auto* end : {&question_.low, question_.high ? &*question_.high : &question_.low}) {
    const std::vector<ex> errors = grown_to(*end).motion.error;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const bool grows = nominal.empty() || !errors[i].is_equal(nominal[i]);
      if (grows && !errors[i].is_zero() && !(errors[i] - end->exact * unit[i]).expand().is_zero())
        throw UsageError("--tube: '" + end->text +
                         "' has a unit; write LO:HI as numbers in the unit of the pose parameter");
    }
  }
}

Request MarginRequest::at(const MarginValue& value) const {
  Request request = grown_to(value);
  return question_.about ? question_.about(request) : request;
}

CertifiedMotion MarginRequest::certified_at(const MarginValue& value) const {
  if (question_.certified) return question_.certified(grown_to(value));
  return {at(value), is_regular()};
}

std::set<std::string> MarginRequest::with_control_errors() const {
  const Request formed = grown_to(forming_value(question_));
  std::set<std::string> names;
  for (std::size_t i = 0; i < formed.motion.error.size(); ++i)
    if (!formed.motion.error[i].is_zero()) names.insert(formed.model.pose[i].name);
  return names;
}

Request grown(const Request& nominal, const MarginQuestion& question, const MarginValue& value) {
  Request request = nominal;
  switch (question.quantity) {
    case MarginQuantity::kTolerance:
      from_option("--tolerance",
                  [&] { set_tolerance(request.model, question.groups, value.exact); });
      break;
    case MarginQuantity::kAlpha:
      from_option("--alpha", [&] { set_alpha(request.motion, value.exact); });
      break;
    case MarginQuantity::kScale:
      scale_ranges(request.motion, value.exact);
      break;
    case MarginQuantity::kParameter:
      set_parameter(request.motion, question, value.exact);
      break;
    case MarginQuantity::kTube:
      from_option("--tube",
                  [&] { set_tube(request.model, request.motion, question.groups + value.text); });
      break;
  }
  return request;
}

Request before_growth(const Request& nominal, const MarginQuestion& question) {
  return grows_from_0(question) ? grown(nominal, question, decimal_value(0)) : nominal;
}

void MarginRequest::replan(PreparedSearch& p, const MarginValue& value) const {
  const Request request = at(value);
  std::vector<Variable> variables = p.stages->formulation().variables;
  for (Variable& variable : variables)
    variable.range = range_at(request.model, request.motion, variable);
  if (question_.quantity == MarginQuantity::kTube)
    set_errors(variables, request, grown_to(forming_value(question_)));
  p.variety = enclose_variety(request.model, request.motion, variables);
  p.is_replanned = true;
}

std::string unit_of_values(const Request& request, const MarginQuestion& question) {
  const auto is_named = [names = ',' + question.groups](const std::string& name) {
    // Tubes end with an equals sign; none names all parameters.
    return names == "," || names.find(',' + name + ',') != std::string::npos ||
           names.ends_with(',' + name) || names.ends_with(',' + name + '=');
  };
  std::set<std::string> units;
  if (question.quantity == MarginQuantity::kTolerance)
    for (const GeometryParameter& g : request.model.geometry)
      if (is_named(g.group) || is_named(g.name))
        units.insert(g.takes_degrees ? "deg"
                                     : unit_of_constant(request.model.drawing.get(), g.name));
  if (question.quantity == MarginQuantity::kTube)
    for (const PoseParameter& p : request.model.pose)
      if (is_named(p.name)) units.insert(p.unit);
  if (question.quantity == MarginQuantity::kParameter)
    for (const MotionParameter& p : request.motion.parameters)
      if (is_named(p.name)) units.insert(p.unit);
  return units.size() == 1 && *units.begin() != "1" ? *units.begin() : "";
}

void take_unit(MarginQuestion& question, const Request& request) {
  question.unit = unit_of_values(request, question);
  if (!is_in_degrees(question.unit) || question.quantity == MarginQuantity::kTube) return;
  const bool grows = question.quantity == MarginQuantity::kParameter;
  for (MarginValue* value : {&question.low, question.high ? &*question.high : nullptr})
    if (value)
      *value = read_value(value->text, grows ? "--grow" : "--tolerance", NumberUnit::kDegrees);
}

std::string describe_growing_range(const Request& nominal, const MarginQuestion& question) {
  Motion motion = nominal.motion;
  const MotionParameter& p = *find_parameter(motion, question.groups);
  const std::string low =
      question.is_two_sided ? "-v" : shortest_text_in(enclose_constant(p.range.lo, p.name));
  return fmt::format(
      "{} {}{}, v grows", p.name,
      !question.is_two_sided && is_size(motion, p) ? "= v" : fmt::format("in [{}, v]", low),
      unit_suffix(p.unit));
}

std::string describe_quantity(const MarginQuestion& question) {
  switch (question.quantity) {
    case MarginQuantity::kTolerance:
      return "tolerance of " + question.groups;
    case MarginQuantity::kAlpha:
      return "alpha";
    case MarginQuantity::kScale:
      return "scale of the motion's ranges";
    case MarginQuantity::kParameter:
      return "range of " + question.groups;
    case MarginQuantity::kTube:
      return question.groups.empty()
                 ? "control error of every pose parameter"
                 : "control error of " + question.groups.substr(0, question.groups.size() - 1);
  }
  return "";
}

}  // namespace regulus::detail
