// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/warm_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "codegen/question/engine/options_key.hpp"

namespace regulus {
namespace {

using Json = nlohmann::json;

/// Increase it if the meaning of the text of a warm start changes.
constexpr int kFormat = 8;

/// The path of the file does not matter: its text is in the key.
void add(KeyParts& parts, const ModelOptions& options) {
  // All members are named: a new one does not compile until it is in the key.
  const auto& [path, motion, ranges, tolerances, alpha, waypoints, tubes, text, asked,
               separates_reach, beyond_limits, warn] = options;
  static_cast<void>(path);
  static_cast<void>(warn);
  static_cast<void>(text);
  parts.add(motion);
  parts.add(ranges);
  parts.add(tolerances);
  parts.add(alpha);
  parts.add(waypoints);
  parts.add(tubes);
  parts.add(asked);
  parts.add(separates_reach);
  parts.add(beyond_limits);
}

std::string hexadecimal(double bound) { return fmt::format("{:a}", bound); }

/// Throws    std::invalid_argument unless the whole text is one number.
double read_bound(const std::string& text) {
  std::string_view digits = text;
  const bool negative = digits.starts_with('-');
  digits.remove_prefix(negative ? 1 : 0);
  const bool prefixed = digits.starts_with("0x");
  digits.remove_prefix(prefixed ? 2 : 0);
  double bound = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), bound, std::chars_format::hex);
  if (!prefixed || error != std::errc() || end != digits.data() + digits.size())
    throw std::invalid_argument("no bound");
  return negative ? -bound : bound;
}

bool is_key(std::string_view text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

Json json_of(const Interval& x) { return {hexadecimal(x.lo), hexadecimal(x.hi)}; }

Interval interval_of(const Json& json) {
  const double lo = read_bound(json.at(0)), hi = read_bound(json.at(1));
  if (json.size() != 2 || !(lo <= hi)) throw std::invalid_argument("no interval");
  return {lo, hi};
}

Json json_of(const ReportLabels& subject) {
  Json pose = Json::array(), twist = Json::array();
  for (const PoseLabel& p : subject.pose) pose.push_back({p.name, p.unit});
  for (const TwistComponent& t : subject.twist)
    twist.push_back({static_cast<int>(t.kind), t.name, t.unit});
  return {{"model", subject.model},
          {"sha256", subject.model_sha256},
          {"motion", subject.motion},
          {"matrix_kind", static_cast<int>(subject.matrix_kind)},
          {"matrix_notes", subject.matrix_notes},
          {"rows", subject.rows},
          {"columns", subject.columns},
          {"where", subject.where},
          {"constraints", subject.constraints},
          {"reach", subject.reach},
          {"determinant_exponent", subject.determinant_exponent},
          {"detail", static_cast<int>(subject.detail)},
          {"pose", pose},
          {"twist", twist}};
}

/// Throws    std::invalid_argument unless the value is a valid number of rows, variables or kinds.
int count_of(const Json& json) {
  constexpr Json::number_unsigned_t kMost = 1 << 20;
  const auto* number = json.get_ptr<const Json::number_unsigned_t*>();
  if (number == nullptr || *number > kMost) throw std::invalid_argument("no count");
  return static_cast<int>(*number);
}

MatrixKind matrix_kind_of(const Json& json) {
  const int kind = count_of(json);
  if (kind > static_cast<int>(MatrixKind::kForwardTransposed))
    throw std::invalid_argument("no kind of matrix");
  return MatrixKind(kind);
}

/// Throws    std::invalid_argument unless the value is a valid exponent of a determinant.
int exponent_of(const Json& json) {
  constexpr Json::number_integer_t kMost = 10'000'000;
  if (!json.is_number_integer() || json > kMost || json < -kMost)
    throw std::invalid_argument("no exponent");
  return json.get<int>();
}

ReportLabels report_labels(const Json& json) {
  ReportLabels subject;
  subject.model = json.at("model");
  subject.model_sha256 = json.at("sha256");
  subject.motion = json.at("motion");
  subject.matrix_kind = matrix_kind_of(json.at("matrix_kind"));
  subject.matrix_notes = json.at("matrix_notes").get<std::vector<std::string>>();
  subject.rows = count_of(json.at("rows"));
  subject.columns = count_of(json.at("columns"));
  subject.where = json.at("where");
  subject.constraints = std::size_t(count_of(json.at("constraints")));
  subject.reach = std::size_t(count_of(json.at("reach")));
  if (subject.reach > subject.constraints) throw std::invalid_argument("no such constraints");
  subject.determinant_exponent = exponent_of(json.at("determinant_exponent"));
  subject.detail = FormDetail(count_of(json.at("detail")));
  for (const Json& p : json.at("pose")) subject.pose.push_back({p.at(0), p.at(1)});
  for (const Json& t : json.at("twist"))
    subject.twist.push_back({TwistComponent::Kind(count_of(t.at(0))), t.at(1), t.at(2)});
  return subject;
}

Json json_of(const VariableLabel& label, const Interval& outer,
             const std::optional<Interval>& inner) {
  return {{"name", label.name},
          {"unit", label.unit},
          {"kind", static_cast<int>(label.kind)},
          {"idle", label.is_idle},
          {"group", label.group},
          {"ball", label.in_ball},
          {"outer", json_of(outer)},
          {"inner", inner ? json_of(*inner) : Json(nullptr)}};
}

/// Writes four numbers for each node, all in one list.
Json json_of(const BallProgram& program) {
  Json nodes = Json::array(), constants = Json::array();
  for (const Node& node : program.nodes)
    for (const std::uint32_t number :
         {static_cast<std::uint32_t>(node.op), node.a, node.b, node.index})
      nodes.push_back(number);
  for (const FlintRational& constant : program.constants) constants.push_back(constant.text());
  return {{"inputs", program.inputs},
          {"nodes", nodes},
          {"constants", constants},
          {"outputs", program.outputs}};
}

BallProgram program_of(const Json& json) {
  BallProgram program;
  program.inputs = std::size_t(count_of(json.at("inputs")));
  const Json& nodes = json.at("nodes");
  const auto number = [&nodes](std::size_t i) { return std::uint32_t(count_of(nodes.at(i))); };
  for (std::size_t i = 0; i < nodes.size(); i += 4) {
    if (number(i) > std::uint32_t(Op::kAbs)) throw std::invalid_argument("no operation");
    program.nodes.push_back({Op(number(i)), number(i + 1), number(i + 2), number(i + 3)});
  }
  for (const Json& constant : json.at("constants"))
    program.constants.push_back(FlintRational::read(constant).value());
  for (const Json& output : json.at("outputs")) program.outputs.push_back(NodeId(count_of(output)));
  return program;
}

/// True if the matrix is that of the problem, in its variables.
bool fits(const BallProgram& matrix, const WarmStart& problem) {
  const ReportLabels& s = problem.labels;
  return s.rows == s.columns && matrix.inputs == s.variables.size() &&
         matrix.outputs.size() == std::size_t(s.rows) * std::size_t(s.columns) &&
         is_consistent(matrix);
}

void read_variable(const Json& json, WarmStart& problem) {
  problem.labels.variables.push_back(
      {json.at("name"), json.at("unit"), VariableKind(count_of(json.at("kind"))),
       json.at("idle").get<bool>(), json.at("group"), json.at("ball").get<bool>()});
  problem.variety.outer.push_back(interval_of(json.at("outer")));
  auto& inner = problem.variety.inner.emplace_back();
  if (!json.at("inner").is_null()) inner = interval_of(json.at("inner"));
}

}  // namespace

std::string warm_start_key(std::string_view model_text, const ModelOptions& model,
                           const FormulationOptions& functions, Isa isa, std::string_view program,
                           std::string_view compiler) {
  KeyParts parts;
  parts.add("prepared problem");
  parts.add(kFormat);
  parts.add(program);
  parts.add(compiler);
  parts.add(name(isa));
  parts.add(model_text);
  add(parts, model);
  add(parts, functions);
  return parts.key();
}

std::string to_text(const WarmStart& problem) {
  Json json = json_of(problem.labels);
  json["format"] = kFormat;
  json["program"] = problem.program_key;
  json["identity"] = problem.identity;
  json["alpha"] = json_of(problem.variety.alpha);
  json["matrix"] = problem.matrix ? json_of(*problem.matrix) : Json(nullptr);
  Json& variables = json["variables"] = Json::array();
  for (std::size_t k = 0; k < problem.labels.variables.size(); ++k)
    variables.push_back(json_of(problem.labels.variables[k], problem.variety.outer.at(k),
                                problem.variety.inner.at(k)));
  return json.dump();
}

std::optional<WarmStart> read_warm_start(std::string_view text) try {
  const Json json = Json::parse(text);
  WarmStart problem;
  problem.labels = report_labels(json);
  problem.program_key = json.at("program");
  problem.identity = json.at("identity");
  if (json.at("format") != kFormat || !is_key(problem.program_key)) return std::nullopt;
  problem.variety.alpha = interval_of(json.at("alpha"));
  for (const Json& variable : json.at("variables")) read_variable(variable, problem);
  if (!json.at("matrix").is_null()) problem.matrix = program_of(json.at("matrix"));
  if (problem.matrix ? !fits(*problem.matrix, problem)
                     : problem.labels.rows == problem.labels.columns)
    return std::nullopt;
  if (to_text(problem) != text) return std::nullopt;
  return problem;
} catch (const std::exception&) {
  return std::nullopt;
}

bool fits(const WarmStart& problem, const machine::PackKernel& program) noexcept {
  const ReportLabels& s = problem.labels;
  const auto motion = std::ranges::count(s.variables, VariableKind::kMotion, &VariableLabel::kind);
  return program.identity == problem.identity && program.variables == s.variables.size() &&
         program.motion_variables == unsigned(motion) && program.rows == unsigned(s.rows) &&
         program.columns == unsigned(s.columns) && program.constraints == s.constraints &&
         program.pose_parameters == s.pose.size();
}

}  // namespace regulus
