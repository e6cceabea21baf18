// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/model_edit.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "codegen/model/degrees.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/file/model_file.hpp"
#include "codegen/model/file/source_lines.hpp"
#include "codegen/model/file/toml_limits.hpp"
#include "codegen/model/file/written.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

toml::table document(const std::string& text) try {
  require_toml_limits(text, "");
  return toml::parse(text);
} catch (const toml::parse_error& error) {
  throw InputError("", static_cast<int>(error.source().begin.line), "text that is not TOML",
                   "TOML 1.0");
}

std::string replaced(const std::string& text, const toml::node* node, const std::string& what,
                     const std::string& expression) {
  if (node == nullptr || !(node->is_string() || node->is_number()))
    throw InputError::statement("", 0, "the model file has no expression for " + what,
                                "edit changes the whole text", what);
  const auto [begin, end, path] = node->source();
  const SourceLines lines(text);
  return text.substr(0, lines.offset(begin.line, begin.column)) +
         written(std::string_view(expression)) + text.substr(lines.offset(end.line, end.column));
}

using GiNaC::ex;

std::string quoted(const ex& value) { return written(std::string_view(formula_text(value))); }

/// The lines of [geometry] and [let] for the anchors. Coordinates of a ball are a list.
class Anchors {
 public:
  /// `own`: the constants that the file itself declares come first.
  Anchors(const Model& model, std::size_t own) : model_(model) {
    for (std::size_t i = own; i < model.geometry.size(); ++i) {
      const GeometryParameter& g = model.geometry[i];
      if (g.ball < 0)
        geometry_ += g.name + " = { value = " + quoted(g.value) +
                     ", tolerance = " + quoted(g.tolerance) + group(g.group);
      else if (model.balls[std::size_t(g.ball)].members.front() == i)
        add_ball(model.balls[std::size_t(g.ball)]);
    }
  }

  [[nodiscard]] const std::string& geometry() const { return geometry_; }
  [[nodiscard]] const std::string& let() const { return let_; }

 private:
  static std::string group(const std::string& name) { return ", group = \"" + name + "\" }\n"; }

  void add_ball(const ToleranceBall& ball) {
    const std::string name = "anchor_" + model_.geometry[ball.members.front()].name;
    std::string values;
    for (std::size_t i = 0; i < ball.members.size(); ++i) {
      const GeometryParameter& g = model_.geometry[ball.members[i]];
      values += (i > 0 ? ", " : "") + quoted(g.value);
      let_ += g.name + " = \"" + name + '_' + std::to_string(i + 1) + "\"\n";
    }
    geometry_ +=
        name + " = { value = [" + values + "], radius = " + quoted(ball.radius) + group(ball.group);
  }

  const Model& model_;
  std::string geometry_, let_;
};

/// Pose parameters in degrees stand for angles in expressions of a file.
std::string entry(const Model& model, const ex& value) {
  GiNaC::exmap angles;
  for (const PoseParameter& p : model.pose)
    if (is_in_degrees(p.unit)) angles[p.symbol] = p.symbol / one_degree();
  return quoted(value.subs(angles, GiNaC::subs_options::no_pattern));
}

std::string pose_and_matrix(const Model& model) {
  std::string text = "[pose]\n";
  for (const PoseParameter& p : model.pose) text += p.name + " = \"" + p.unit + "\"\n";
  text += "\n[matrix]\ntwist = [";
  for (const TwistComponent& t : model.twist) text += '"' + t.name + "\", ";
  text += "]\nrows = [\n";
  for (unsigned i = 0; i < model.matrix.rows(); ++i) {
    text += "  [";
    for (unsigned j = 0; j < model.matrix.cols(); ++j)
      text += entry(model, model.matrix(i, j)) + (j + 1 < model.matrix.cols() ? ", " : "],\n");
  }
  text += "]\nrow_scale = [\n";
  for (const ex& scale : model.row_scale) text += "  " + entry(model, scale) + ",\n";
  return text + "]\n";
}

[[noreturn]] void refuse(const std::string& table) {
  throw InputError::statement("", 0, table + " has no line of its own",
                              "edit changes the whole text", "");
}

/// Puts lines below the line of a table's name, or makes the table.
void add_to_table(std::vector<std::string>& lines, const toml::table& document,
                  const std::string& table, const std::string& more) {
  const std::string header = "[" + table + "]";
  if (!document.contains(table)) {
    lines.push_back(header + "\n" + more);
    return;
  }
  const auto at = std::ranges::find_if(
      lines, [&](const std::string& line) { return line.starts_with(header); });
  if (at == lines.end()) refuse(header);
  *at += (at->ends_with('\n') ? "" : "\n") + more;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    lines.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return lines;
}

/// Names the edit in [matrix]: it need not be the matrix of the robot any more. Other tables describe
/// robots, whatever their numbers are.
std::string with_name_of(const std::string& edit, const std::string& text) {
  const toml::table model = document(text);
  if (!model.contains("matrix")) return text;
  const toml::node_view<const toml::node> known = model["matrix"]["edited"];
  if (const std::optional<std::string> names = known.value<std::string>()) {
    const bool is_named = (", " + *names + ", ").find(", " + edit + ", ") != std::string::npos;
    return is_named ? text : replaced(text, known.node(), "the key edited", *names + ", " + edit);
  }
  std::vector<std::string> lines = lines_of(text);
  add_to_table(lines, model, "matrix", "edited = " + written(std::string_view(edit)) + "\n");
  std::string result;
  for (const std::string& line : lines) result += line;
  return result;
}

/// The constants that the file itself declares.
std::size_t own_constants(const toml::table& document) {
  std::size_t count = 0;
  if (const toml::table* geometry = document["geometry"].as_table())
    for (const auto& [key, node] : *geometry) {
      const toml::node* value = node.is_table() ? node.as_table()->get("value") : &node;
      count += value != nullptr && value->is_array() ? value->as_array()->size() : 1;
    }
  return count;
}

}  // namespace

std::string with_entry(const std::string& text, int i, int j, const std::string& expression) {
  const toml::table model = document(text);
  const std::string what = "the entry " + std::to_string(i) + " " + std::to_string(j);
  const toml::node* node = nullptr;
  if (i >= 1 && j >= 1)
    node = model["matrix"]["rows"][static_cast<std::size_t>(i) - 1][static_cast<std::size_t>(j) - 1]
               .node();
  const std::string name = "entry (" + std::to_string(i) + "," + std::to_string(j) + ")";
  return with_name_of(name, replaced(text, node, what, expression));
}

std::string with_let(const std::string& text, const std::string& name,
                     const std::string& expression) {
  const toml::table model = document(text);
  return with_name_of("let " + name, replaced(text, model["let"][name].node(),
                                              "the sub-expression " + in_quotes(name), expression));
}

std::vector<std::string> let_names(const std::string& text) {
  const toml::table model = document(text);
  std::vector<std::string> names;
  if (const toml::table* let = model["let"].as_table())
    for (const auto& [key, node] : *let) names.emplace_back(key.str());
  return names;
}

bool is_gough(const std::string& text) { return document(text).contains("gough"); }

std::string with_matrix_of_gough(const std::string& text) {
  const Model model = parse_model(text, "");
  const toml::table file = document(text);
  std::vector<std::string> lines = lines_of(text);
  const toml::table& gough = *file["gough"].as_table();
  const std::size_t first = gough.source().begin.line;
  std::size_t last = first;
  for (const auto& [key, node] : gough) last = std::max<std::size_t>(last, node.source().end.line);
  if (first == 0 || !lines.at(first - 1).starts_with("[gough]")) refuse("[gough]");
  for (std::size_t line = first; line <= last; ++line) lines[line - 1].clear();
  lines[first - 1] = pose_and_matrix(model);
  const Anchors anchors(model, own_constants(file));
  if (!lines.back().empty() && !lines.back().ends_with('\n')) lines.back() += '\n';
  add_to_table(lines, file, "geometry", anchors.geometry());
  if (!anchors.let().empty()) add_to_table(lines, file, "let", anchors.let());
  std::string result;
  for (const std::string& line : lines) result += line;
  return result;
}

}  // namespace regulus::detail
