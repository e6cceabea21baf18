// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/waypoints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "runtime/verifier/algebra.hpp"
#include "runtime/verifier/derivative.hpp"
#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/input_file.hpp"
#include "runtime/verifier/model/equality.hpp"
#include "runtime/verifier/model/model_comparison.hpp"
#include "runtime/verifier/model/model_expression.hpp"
#include "runtime/verifier/model/place_table.hpp"
#include "runtime/verifier/model/spline.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 28;
/// The slopes of a spline may differ by this part of the largest.
constexpr double kSlopePrecision = 1e-9;

/// A length in micrometres, or an angle in degrees or in radians.
struct Unit {
  std::string_view name;
  long micrometres;
};
constexpr std::array<Unit, 7> kLengthUnits = {{{"m", 1'000'000},
                                               {"dm", 100'000},
                                               {"cm", 10'000},
                                               {"mm", 1'000},
                                               {"um", 1},
                                               {"µm", 1},
                                               {"in", 25'400}}};

long length_of(const std::string& unit) {
  const auto found = std::find_if(kLengthUnits.begin(), kLengthUnits.end(),
                                  [&unit](const Unit& known) { return known.name == unit; });
  return found == kLengthUnits.end() ? 0 : found->micrometres;
}

bool names_degrees(const std::string& unit) { return unit == "deg" || unit == "°"; }
bool is_angle(const std::string& unit) { return unit == "rad" || names_degrees(unit); }

NodeId whole(Graph& graph, long value) { return graph.number(std::to_string(value)); }

/// True if the expressions are equal for all values of the variables. Throws Unfinished.
bool is_equal(Question& q, NodeId a, NodeId b) {
  switch (equality(q, a, b)) {
    case Equality::kEqual:
      return true;
    case Equality::kDifferent:
      return false;
    case Equality::kUnknown:
      break;
  }
  throw Unfinished("algebra does not decide if a piece is that of the way-points");
}

double approx(const Rational& x) { return fmpq_get_d(x.get()); }

double approx(const std::string& decimal) {
  Graph graph;
  const auto value = exact_value(graph, number_of_toml(decimal, graph));
  if (!value) throw Unfinished("a way-point has a number without a value");
  return approx(*value);
}

/// Returns an expression with a number in the place of every variable.
NodeId at(Question& q, NodeId root, long value) {
  std::map<NodeId, NodeId> known;
  for (const NodeId id : ingredients(q.graph, {root})) {
    const Node node = q.graph.nodes()[std::size_t(id)];
    NodeId result = id;
    if (node.op == Op::kVariable) result = whole(q.graph, value);
    if (operands(node.op) == 1) result = q.graph.add(node.op, known.at(node.a), node.b);
    if (operands(node.op) == 2) result = q.graph.add(node.op, known.at(node.a), known.at(node.b));
    known.emplace(id, result);
  }
  return known.at(root);
}

bool is_program(const std::string& file) {
  for (const char* ending : {".gcode", ".nc", ".ngc", ".tap", ".gc"})
    if (file.ends_with(ending)) return true;
  return false;
}

const std::string* text_at(const WrittenValues& model, const std::string& place) {
  const auto found = model.find(place);
  return found == model.end() ? nullptr : &found->second.text;
}

}  // namespace

std::string factor_of_column(const WaypointTable::Column& column, const std::string& unit) {
  const std::string& given = column.unit;
  if (given.empty() || given == unit || (names_degrees(given) && names_degrees(unit))) return "";
  if (names_degrees(given) && unit == "rad") return "pi/180";
  if (given == "rad" && names_degrees(unit)) return "180/pi";
  if (length_of(given) == 0 || length_of(unit) == 0)
    throw Unfinished("the unit '" + given + "' of the way-points is not that of the model, '" +
                     unit + "'");
  return std::to_string(length_of(given)) + '/' + std::to_string(length_of(unit));
}

WaypointComparison::WaypointComparison(const WrittenValues& model, const std::string& motion,
                                       const std::string& model_name, const std::string& file)
    : model_(model), file_(file) {
  const std::string place = "motion." + motion + '.';
  if (const std::string* written = text_at(model, place + "interpolation"))
    interpolation_ = *written;
  if (file_.empty()) file_ = table_of_motion(model, motion, model_name);
  if (file_.empty()) return;
  std::string text;
  try {
    text = read_text(file_, kMostBytes);
  } catch (const std::runtime_error& why) {
    throw Unfinished(std::string("the way-points cannot be read: ") + why.what());
  }
  read(text);
}

void WaypointComparison::read(const std::string& text) {
  is_program_ = is_program(file_);
  if (is_program_) {
    moves_ = read_program(text);
    for (const char* name : {"x", "y", "z"}) column_.emplace_back(name, 0);
    return;
  }
  table_ = read_waypoint_table(text);
  if (table_.rows.size() < 2) throw Unfinished("the way-points have fewer than two rows");
  find_columns();
}

void WaypointComparison::find_columns() {
  for (std::size_t c = 0; c < table_.columns.size(); ++c) {
    if (column(table_.columns[c].name) != nullptr)
      throw Unfinished("two columns of the way-points have one name");
    column_.emplace_back(table_.columns[c].name, c);
  }
}

const std::size_t* WaypointComparison::column(const std::string& name) const {
  for (const auto& [known, number] : column_)
    if (known == name) return &number;
  return nullptr;
}

/// Returns the unit of the parameter in the model, as far as a factor needs it.
std::string WaypointComparison::unit_of_model(const std::string& parameter) const {
  if (const std::string* unit = text_at(model_, "pose." + parameter)) return *unit;
  const bool is_turned = !is_program_ && is_angle(table_.columns[*column(parameter)].unit);
  for (const char* table : {"gough", "legs", "serial"})
    if (const std::string* unit =
            text_at(model_, std::string(table) + (is_turned ? ".angle_unit" : ".unit")))
      return *unit;
  return is_turned ? "rad" : "";
}

/// Returns a number of the table in the unit of the model.
NodeId WaypointComparison::scaled(Graph& graph, NodeId number, const std::string& parameter) const {
  const WaypointTable::Column& given = table_.columns[*column(parameter)];
  if (given.unit.empty()) return number;
  const std::string factor = factor_of_column(given, unit_of_model(parameter));
  if (factor.empty()) return number;
  const NameMeaning no_names = [](std::string_view) { return kNoNode; };
  int depth = 0;
  return graph.add(Op::kMultiply, number,
                   parse_model_expression(factor, no_names, graph, depth, {}, false));
}

NodeId WaypointComparison::cell(Graph& graph, std::size_t row, const std::string& parameter) const {
  const std::string& text = table_.rows[row].cells[*column(parameter)];
  return scaled(graph, number_of_toml(text, graph), parameter);
}

/// Returns the slope per segment: the derivative times the time of the segment.
NodeId WaypointComparison::slope(Graph& graph, std::size_t row,
                                 const std::string& parameter) const {
  const std::size_t* derivative = column("d" + parameter);
  if (derivative == nullptr) throw Unfinished("the way-points have no column d" + parameter);
  return scaled(graph, number_of_toml(table_.rows[row].cells[*derivative], graph), parameter);
}

/// Returns nullptr if segment k takes the time from k to k + 1.
const std::size_t* WaypointComparison::time_column(const Question& q) const {
  const std::size_t* time = nullptr;
  for (const char* name : {"time", "t"})
    if (column(name) != nullptr && !q.stated.contains(std::string("pose ") + name))
      time = column(name);
  return time;
}

NodeId WaypointComparison::duration(Question& q, std::size_t piece) const {
  const std::size_t* time = time_column(q);
  if (time == nullptr) return whole(q.graph, 1);
  return q.graph.add(Op::kSubtract, number_of_toml(table_.rows[piece + 1].cells[*time], q.graph),
                     number_of_toml(table_.rows[piece].cells[*time], q.graph));
}

/// Returns Hermite's cubic between two rows; the slopes are per segment.
NodeId WaypointComparison::hermite(Question& q, std::size_t piece, const std::string& parameter,
                                   NodeId first_slope, NodeId last_slope) const {
  Graph& graph = q.graph;
  const auto plus = [&graph](NodeId a, NodeId b) { return graph.add(Op::kAdd, a, b); };
  const auto minus = [&graph](NodeId a, NodeId b) { return graph.add(Op::kSubtract, a, b); };
  const auto times = [&graph](NodeId a, NodeId b) { return graph.add(Op::kMultiply, a, b); };
  const NodeId s = graph.add(Op::kVariable, 0);
  const NodeId first = cell(graph, piece, parameter), last = cell(graph, piece + 1, parameter);
  const NodeId rise = minus(last, first);
  const NodeId square =
      minus(minus(times(whole(graph, 3), rise), times(whole(graph, 2), first_slope)), last_slope);
  const NodeId cube = minus(plus(first_slope, last_slope), times(whole(graph, 2), rise));
  return plus(first, times(s, plus(first_slope, times(s, plus(square, times(s, cube))))));
}

/// For straight segments and given derivatives.
NodeId WaypointComparison::expected(Question& q, std::size_t piece,
                                    const std::string& parameter) const {
  Graph& graph = q.graph;
  if (interpolation_ == "linear") {
    const NodeId first = cell(graph, piece, parameter), last = cell(graph, piece + 1, parameter);
    const NodeId rise = graph.add(Op::kSubtract, last, first);
    return graph.add(Op::kAdd, first, graph.add(Op::kMultiply, rise, graph.add(Op::kVariable, 0)));
  }
  if (time_column(q) == nullptr) throw Unfinished("the way-points have no times");
  const NodeId step = duration(q, piece);
  return hermite(q, piece, parameter,
                 graph.add(Op::kMultiply, step, slope(graph, piece, parameter)),
                 graph.add(Op::kMultiply, step, slope(graph, piece + 1, parameter)));
}

NodeId WaypointComparison::place_of_program(Graph& graph, std::size_t piece,
                                            const std::string& parameter) const {
  const std::string unit = unit_of_model(parameter);
  if (length_of(unit) == 0)
    throw Unfinished("the unit of " + parameter + " in the model, '" + unit + "', is no length");
  const NodeId place = place_on_move(graph, moves_[piece], std::size_t(parameter[0] - 'x'));
  const Rational factor = Rational(length_of("mm")) / Rational(length_of(unit));
  return graph.add(Op::kMultiply, graph.number(factor), place);
}

const std::vector<double>& WaypointComparison::spline_slopes(const Question& q,
                                                             const std::string& parameter) const {
  const auto known = slopes_.find(parameter);
  if (known != slopes_.end()) return known->second;
  const std::size_t* time = time_column(q);
  std::vector<double> times, values;
  for (const WaypointTable::Row& row : table_.rows) {
    times.push_back(time == nullptr ? double(times.size()) : approx(row.cells[*time]));
    values.push_back(approx(row.cells[*column(parameter)]));
  }
  return slopes_.emplace(parameter, approx_spline_slopes(times, values)).first->second;
}

/// The trajectory has rounded slopes. A piece is compared exactly with the cubic that has its own
/// slopes at the ends, and these with the slopes of the spline.
bool WaypointComparison::is_spline(Question& q, std::size_t piece,
                                   const std::string& parameter) const {
  Graph& graph = q.graph;
  const NodeId stated = q.stated.at("pose " + parameter).node;
  const NodeId derivative = Differentiator(graph, 0).of(stated);
  const std::vector<double>& slopes = spline_slopes(q, parameter);
  double largest = 0;
  for (const double slope : slopes) largest = std::max(largest, std::fabs(slope));
  const NodeId step = duration(q, piece);
  const NodeId unit = graph.add(Op::kMultiply, step, scaled(graph, whole(graph, 1), parameter));
  std::array<NodeId, 2> of_segment{};
  for (const std::size_t end : {0, 1}) {
    of_segment[end] = derivative == kNoNode ? whole(graph, 0) : at(q, derivative, long(end));
    const auto slope = exact_value(graph, graph.add(Op::kDivide, of_segment[end], unit));
    if (!slope) return false;
    if (!(std::fabs(approx(*slope) - slopes[piece + end]) <= kSlopePrecision * largest))
      return false;
  }
  return is_equal(q, stated, hermite(q, piece, parameter, of_segment[0], of_segment[1]));
}

bool WaypointComparison::agrees(Question& q, std::size_t piece,
                                const std::string& parameter) const {
  const NodeId stated = q.stated.at("pose " + parameter).node;
  if (is_program_) return is_equal(q, stated, place_of_program(q.graph, piece, parameter));
  if (interpolation_ == "cubic") return is_spline(q, piece, parameter);
  return is_equal(q, stated, expected(q, piece, parameter));
}

std::string WaypointComparison::describe_lines(std::size_t piece) const {
  if (is_program_) return "move of line " + std::to_string(moves_[piece].line);
  return "way from line " + std::to_string(table_.rows[piece].line) + " to line " +
         std::to_string(table_.rows[piece + 1].line);
}

std::size_t WaypointComparison::compare(Question& q, std::size_t piece) const {
  const bool is_along_s = !q.variables.empty() && q.variables[0].kind == VariableKind::kParameter &&
                          is_equal(q, q.variables[0].lo, whole(q.graph, 0)) &&
                          is_equal(q, q.variables[0].hi, whole(q.graph, 1));
  if (!is_along_s) throw OtherModel("the parameter of a piece does not go from 0 to 1");
  if (const std::string other = other_parameter(q, piece); !other.empty())
    throw OtherModel("the certificate is not about " + file_ + ": its piece " +
                     std::to_string(piece + 1) + " is not the " + describe_lines(piece) +
                     ", where " + other + " differs");
  return std::size_t(std::count_if(column_.begin(), column_.end(), [&q](const auto& c) {
    return q.stated.contains("pose " + c.first);
  }));
}

std::string WaypointComparison::other_parameter(Question& q, std::size_t piece) const {
  for (const auto& [name, number] : column_)
    if (q.stated.contains("pose " + name) && !agrees(q, piece, name)) return name;
  return "";
}

void WaypointComparison::require_some_piece(Question& q) const {
  std::optional<Unfinished> undecided;
  for (std::size_t k = 0; k < pieces(); ++k) try {
      if (other_parameter(q, k).empty()) return static_cast<void>(compare(q, k));
    } catch (const Unfinished& why) {
      undecided = why;
    }
  if (undecided) throw Unfinished(*undecided);
  throw OtherModel("the certificate is not about " + file_ +
                   (is_program_ ? ": its piece is none of the moves"
                                : ": its piece is not the way between two lines"));
}

std::vector<std::string> WaypointComparison::compared_keys(const Question& q) const {
  const std::string& s = q.variables.front().name;
  std::vector<std::string> keys{"lower " + s, "upper " + s};
  for (const auto& [name, number] : column_) keys.push_back("pose " + name);
  return keys;
}

}  // namespace regulus::verifier
