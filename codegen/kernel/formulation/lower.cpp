// SPDX-License-Identifier: GPL-3.0-or-later
#include <unordered_set>
#include <utility>

#include "codegen/kernel/formulation/formulation.hpp"
#include "codegen/kernel/program/enclose.hpp"
#include "codegen/kernel/symbolic/lowering.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

struct Shape {
  const char* name;    // the field of regulus_kernel
  const char* symbol;  // for comments
  int rows;
  int columns;
  bool uses_points;
};

/// The copies of the first row or column: each has entries of K that are `step` places further on.
struct Copies {
  std::size_t times = 1;
  std::size_t step = 0;
};

/// Returns the conditions that the outputs do not evaluate as sub-expressions.
Expressions missing_conditions(const Expressions& outputs, const Expressions& conditions,
                               WorkMeter& meter) {
  if (conditions.empty()) return {};
  std::unordered_set<Expression, ExpressionHash> present;
  std::vector<Expression> stack = outputs;
  while (!stack.empty()) {
    const Expression e = std::move(stack.back());
    stack.pop_back();
    if (!present.insert(e).second) continue;
    meter.spend(1);
    stack.insert(stack.end(), e.operands().begin(), e.operands().end());
  }
  Expressions missing;
  for (const Expression& condition : conditions)
    if (present.count(condition) == 0) missing.push_back(condition);
  return missing;
}

std::string occurrence_text(const EntryStatistics& entry) {
  std::string text;
  for (const auto& [name, count] : entry.rewritten) {
    text += (text.empty() ? "" : ", ") + name + " " + std::to_string(count);
    const auto natural = entry.natural.find(name);
    if (natural != entry.natural.end() && natural->second != count)
      text += " (natural " + std::to_string(natural->second) + ")";
  }
  return text.empty() ? "none" : text;
}

/// "(K·A)[0][1]: horner. Occurrences: x 1 (natural 6)", indices from 0 as in the emitted code.
std::vector<std::string> comments(const Shape& shape, const std::vector<EntryStatistics>& entries) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::size_t columns = static_cast<std::size_t>(shape.columns);
    result.push_back(std::string(shape.symbol) + "[" + std::to_string(i / columns) + "][" +
                     std::to_string(i % columns) + "]: " + entries[i].passes +
                     ". Occurrences: " + occurrence_text(entries[i]));
  }
  return result;
}

std::string title(const Shape& shape, const std::vector<EntryStatistics>& entries) {
  Occurrences natural, rewritten;
  for (const EntryStatistics& entry : entries) {
    for (const auto& [name, count] : entry.natural) natural[name] += count;
    for (const auto& [name, count] : entry.rewritten) rewritten[name] += count;
  }
  std::string text = std::string(shape.symbol) + ", rewritten (T-RO 2007, §III-B1)";
  if (entries.empty()) return text;
  text += ": " + std::to_string(total(rewritten)) + " occurrences of variables";
  if (!natural.empty()) text += ", " + std::to_string(total(natural)) + " as written";
  return text;
}

class ModuleBuilder {
 public:
  ModuleBuilder(const Formulation& formulation, const FormingWatch* watch)
      : f_(formulation), meter_(WorkMeter::kNoLimit, watch, WorkStage::kLowering) {
    module_.model = f_.model;
    module_.motion = f_.motion;
    for (const Variable& v : f_.variables) {
      module_.variables.push_back(v.name);
      if (v.kind == VariableKind::kMotion) ++module_.motion_variables;
    }
    module_.rows = f_.rows;
    module_.columns = f_.columns;
    module_.constraints = static_cast<int>(f_.constraints.size());
    module_.pose_parameters = static_cast<int>(f_.pose.size());
    for (int i = 1; i <= f_.columns; ++i)
      for (int j = 1; j <= f_.rows; ++j) points_.push_back(point_name(i, j));
  }

  void add(const Shape& shape, const Expressions& outputs, const Expressions& conditions) {
    add(shape, {outputs, outputs.size()}, Copies(), conditions);
  }

  void add(const Shape& shape, const ProductForms& outputs, Copies copies,
           const Expressions& conditions) {
    if (outputs.empty()) return;
    Lowering lowering(module_.variables, shape.uses_points ? points_ : std::vector<std::string>(),
                      &meter_);
    Expressions missing = missing_conditions(outputs.first, conditions, meter_);
    for (std::size_t begin = 0; begin < outputs.first.size(); begin += outputs.block) {
      std::vector<NodeId> block;
      for (std::size_t i = begin; i < begin + outputs.block; ++i)
        block.push_back(
            lowering.output_where_defined(outputs.first[i], std::exchange(missing, {})));
      for (std::size_t copy = 1; copy < copies.times; ++copy)
        for (const NodeId node : block)
          lowering.output_moved(node, static_cast<std::uint32_t>(copy * copies.step));
    }
    const auto found = f_.statistics.find(shape.name);
    const std::vector<EntryStatistics> entries =
        found == f_.statistics.end() ? std::vector<EntryStatistics>() : found->second;
    Function function;
    function.name = shape.name;
    function.title = title(shape, entries);
    function.program = std::move(lowering).finish();
    function.rows = shape.rows;
    function.columns = shape.columns;
    function.output_comments = comments(shape, entries);
    module_.functions.push_back(std::move(function));
  }

  /// Adds rows of K·A.
  void add(const Shape& shape, const ProductForms& outputs, const Expressions& conditions) {
    add(shape, outputs, {std::size_t(f_.columns), std::size_t(f_.rows)}, conditions);
  }

  template <class Derivatives>
  void add_derivatives(const Shape& shape, const Derivatives& derivatives) {
    if (derivatives.forms.empty()) return;
    add(shape, derivatives.forms, f_.must_be_defined);
    module_.functions.back().derivatives = derivatives.places;
  }

  void add_expansion() {
    if (!f_.expansion) return;
    const ExpansionForms& x = *f_.expansion;
    const int n = f_.columns;
    const auto count = [](const auto& d) { return static_cast<int>(d.places.size()); };
    Expansion& expansion = module_.expansion.emplace();
    expansion.row_of_variable = x.row_of_variable;
    expansion.ball_of_variable = x.ball_of_variable;
    expansion.product = x.product.empty() ? "left_product" : "nominal_product";
    expansion.first = x.product.empty() ? "left_derivatives" : "nominal_first";
    for (const Expression& value : x.nominal) expansion.nominal.push_back(enclose_value(value));
    add({"nominal_product", "(K·A)", n, n, true}, x.product, f_.must_be_defined);
    add_derivatives({"nominal_first", "∂(K·A)", count(x.first), 1, true}, x.first);
    add_derivatives({"expansion_second", "∂²(K·A)", count(x.second), 1, true}, x.second);
    add_derivatives({"row_first", "∂A", count(x.row_first), 1, false}, x.row_first);
    add_derivatives({"row_second", "∂²A", count(x.row_second), 1, false}, x.row_second);
    for (Function& function : module_.functions)
      if (function.name == "left_derivatives") function.derivatives = all_derivatives();
    if (x.product.empty()) return;
    if (x.first.forms.empty()) expansion.first.clear();
  }

  Module take() { return std::move(module_); }

 private:
  static Interval enclose_value(const Expression& value) {
    Lowering lowering({}, {});
    lowering.output(value);
    const std::optional<Interval> enclosure = enclose(std::move(lowering).finish());
    if (!enclosure)
      throw InputError::statement("", 0, "the value of an uncertain quantity is not finite",
                                  "write a constant expression that is defined and finite");
    return *enclosure;
  }

  /// Returns the outputs of left_derivatives in their order.
  [[nodiscard]] std::vector<DerivativeIndex> all_derivatives() const {
    std::vector<DerivativeIndex> all;
    for (int v = 0; v < static_cast<int>(f_.variables.size()); ++v)
      for (int i = 0; i < f_.columns; ++i)
        for (int j = 0; j < f_.columns; ++j) all.push_back({i, j, v});
    return all;
  }

  const Formulation& f_;
  WorkMeter meter_;
  Module module_;
  std::vector<std::string> points_;
};

}  // namespace

Program lower_outputs(const Formulation& f, const Expressions& outputs) {
  std::vector<std::string> names;
  for (const Variable& variable : f.variables) names.push_back(variable.name);
  Lowering lowering(names, {});
  for (const Expression& output : outputs) lowering.output(output);
  return std::move(lowering).finish();
}

Module lower(const Formulation& f, const FormingWatch* watch) {
  ModuleBuilder builder(f, watch);
  const int variables = static_cast<int>(f.variables.size());
  const int constraints = static_cast<int>(f.constraints.size());
  const int pose = static_cast<int>(f.pose.size());
  const int m = f.rows, n = f.columns;
  builder.add({"matrix", "A", m, n, false}, f.matrix, f.must_be_defined);
  builder.add({"matrix_derivatives", "∂A", variables * m, n, false}, f.matrix_derivatives,
              f.must_be_defined);
  builder.add({"left_product", "(K·A)", n, n, true}, f.left_product, f.must_be_defined);
  builder.add({"left_derivatives", "∂(K·A)", variables * n, n, true}, f.left_derivatives,
              f.must_be_defined);
  builder.add({"right_product", "(A·K)", m, m, true}, f.right_product, {std::size_t(m), 1},
              f.must_be_defined);
  builder.add({"row_scale", "scale", 1, 1, false}, f.row_scale, {});
  builder.add({"constraint", "H", constraints, 1, false}, f.constraints, f.motion_must_be_defined);
  builder.add({"pose", "X", pose, 1, false}, f.pose, f.motion_must_be_defined);
  builder.add({"determinant", "det A", 1, 1, false}, f.determinant, f.must_be_defined);
  builder.add({"determinant_derivatives", "∂ det A", variables, 1, false},
              f.determinant_derivatives, f.must_be_defined);
  builder.add_expansion();
  return builder.take();
}

Module undefined_kernel(const Formulation& shape, int constraints, int pose_parameters) {
  Module module = ModuleBuilder(shape, nullptr).take();
  module.constraints = constraints;
  module.pose_parameters = pose_parameters;
  const auto add = [&](const char* name, int rows, int columns) {
    if (rows == 0) return;
    ProgramBuilder builder(module.variables, {});
    const NodeId undefined = builder.divide(builder.constant(1), builder.constant(0));
    for (int i = 0; i < rows * columns; ++i) builder.output(undefined);
    Function function;
    function.name = name;
    function.program = std::move(builder).finish();
    function.rows = rows;
    function.columns = columns;
    module.functions.push_back(std::move(function));
  };
  add("matrix", shape.rows, shape.columns);
  add("left_product", shape.columns, shape.columns);
  add("constraint", constraints, 1);
  add("pose", pose_parameters, 1);
  return module;
}

}  // namespace regulus::detail
