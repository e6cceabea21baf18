// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "codegen/kernel/formulation/form_candidates.hpp"
#include "codegen/kernel/symbolic/print.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/mechanism/singular_factors.hpp"

namespace regulus::detail {
namespace {

bool is_operation(const Node& node) {
  return node.op != Op::kConstant && node.op != Op::kNumberPi && node.op != Op::kInput &&
         node.op != Op::kPoint;
}

std::string shortened(const std::string& text, std::size_t longest) {
  if (text.size() <= longest) return text;
  const std::size_t cut = text.size() - longest;
  return text.substr(0, longest) + fmt::format(" … ({} characters more)", cut);
}

std::string shortened(const Expression& e, std::size_t longest) {
  const std::uint64_t size = printed_size(e);
  if (size > 4 * longest) return fmt::format("({} symbols and operations)", size);
  return shortened(to_string(e), longest);
}

std::string to_text(const Occurrences& occurrences) {
  std::string text;
  for (const auto& [name, count] : occurrences)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, count);
  return text.empty() ? "none" : text;
}

Occurrences added_up(const std::vector<EntryStatistics>& entries,
                     Occurrences EntryStatistics::*which) {
  Occurrences result;
  for (const EntryStatistics& entry : entries)
    for (const auto& [name, count] : entry.*which) result[name] += count;
  return result;
}

std::uint64_t count_of(const Occurrences& occurrences, const std::string& name) {
  const auto found = occurrences.find(name);
  return found == occurrences.end() ? 0 : found->second;
}

class Explainer {
 public:
  Explainer(const Model& model, const Motion& motion, const ExplainOptions& options)
      : f_(formulate(model, motion, options.formulation)),
        module_(lower(f_)),
        options_(options),
        factors_(singular_factors(model)),
        candidates_(f_, options.formulation.rewriting) {
    form_matrix_of_product();
    if (!options.kernel) return;
    kernel_ = formulate(model, motion, *options.kernel);
    module_ = lower(*kernel_);
  }

  Explanation explanation() {
    if (options_.part == ExplainPart::kAll)
      everything();
    else if (options_.part == ExplainPart::kMatrix)
      matrix();
    else
      occurrence_table();
    return {std::move(text_), f_.scaling};
  }

 private:
  void everything() {
    heading();
    matrix();
    if (!f_.scaling.empty()) scaling();
    if (f_.column_trials) column_operations(*f_.column_trials);
    left_entries();
    if (!f_.right_product.empty()) right_entries();
    if (!f_.determinant.empty()) closed_form();
    occurrence_table();
    functions();
  }

  template <class... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    text_ += fmt::format(format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }

  void heading() {
    line("{}: A is {}×{}, {} variables", f_.model, f_.rows, f_.columns, f_.variables.size());
    for (const Variable& v : f_.variables)
      if (v.kind != VariableKind::kMotion)
        line("  {} is {}", v.name,
             v.kind == VariableKind::kGeometry ? "uncertain geometry" : "a control error");
    for (const Expression& e : f_.must_be_defined)
      line("  defined only where {} is", shortened(e, options_.longest));
    line("");
  }

  void matrix() {
    line("The matrix A");
    for (int i = 0; i < f_.rows; ++i)
      for (int j = 0; j < f_.columns; ++j)
        line("  A({},{}) = {}", i + 1, j + 1,
             shortened(f_.natural_matrix[at(i, j, f_.columns)], options_.longest));
    line("");
    singularities();
  }

  void singularities() {
    if (factors_.empty()) return;
    line("Singular where one of these factors of the determinant is zero");
    for (const SingularFactor& factor : factors_) line("  {:<10}{}", factor.name, factor.text);
    line("");
  }

  void exponents(const char* name, const std::vector<int>& exponents) {
    std::string text;
    for (std::size_t i = 0; i < exponents.size(); ++i)
      text += fmt::format("{}{} 2^{}", i == 0 ? "" : ", ", i + 1, exponents[i]);
    line("  {}  {}", name, text);
  }

  void scaling() {
    line("Rows and columns times powers of two, since their scales are far apart");
    line("  A stands for R·A·C below; its rank and the sign of its determinant are those of A");
    exponents("R, of row   ", f_.scaling.rows);
    exponents("C, of column", f_.scaling.columns);
    if (f_.rows == f_.columns) line("  det R·A·C = 2^{} det A", f_.scaling.determinant_exponent());
    line("");
  }

  void format_operation(const std::vector<AppliedOperation>& operations) {
    for (const AppliedOperation& o : operations)
      line("    column {} += {} · column {}", o.target + 1,
           shortened(o.multiplier, options_.longest), o.source + 1);
  }

  void column_operations(const ColumnTrials& trials) {
    line("Column operations of determinant 1: A·V in place of A");
    if (!trials.complete) line("  A has too many terms to look at all operations");
    if (trials.tried.empty()) return line("  none saves a term\n");
    line("  tried: they leave {} terms of {}", trials.terms_after, trials.terms_before);
    format_operation(trials.tried);
    if (trials.radius_of_all == 0) {
      line("  not compared: {}\n", trials.halvings == 0 ? "A is likely to be certified as it is"
                                                        : "no bounds of A were found");
      return;
    }
    line("  radius of the bounds, below 1 they certify; boxes after {} halvings of the motion",
         trials.halvings);
    line("    {:.3f} of A, {:.3f} of A·V, {:.3f} of A·V with half of each multiplier",
         trials.radius, trials.radius_of_all, trials.radius_of_half);
    line("  kept: {}", trials.kept.empty() ? "none; K·A below is of the model's A"
                                           : "these; A stands for A·V in K·A below");
    format_operation(trials.kept);
    line("");
  }

  /// A of K·A as written: the model's matrix, scaled, after the column operations that were kept.
  void form_matrix_of_product() {
    for (int i = 0; i < f_.rows; ++i)
      for (int j = 0; j < f_.columns; ++j)
        matrix_.push_back(f_.scaling.apply(f_.natural_matrix[at(i, j, f_.columns)], i, j));
    if (!f_.column_trials) return;
    changed_ = matrix_;
    for (const AppliedOperation& o : f_.column_trials->kept)
      for (int i = 0; i < f_.rows; ++i) {
        Expression& target = changed_[at(i, o.target, f_.columns)];
        target = target + o.multiplier * changed_[at(i, o.source, f_.columns)];
      }
  }

  [[nodiscard]] static std::string width_text(const std::optional<double>& width) {
    return width ? fmt::format("{:.4g}", *width) : "-";
  }

  void entry(const std::string& name, const Expression& natural, const Expression& form,
             const EntryStatistics& statistics) {
    line("  {}", name);
    line("    form 1, as written: {}", shortened(natural, options_.longest));
    line("      occurrences: {}", to_text(count_occurrences(natural)));
    line("    form 2, {}: {}", statistics.passes, shortened(form, options_.longest));
    line("      occurrences: {}", to_text(statistics.rewritten));
    line("    compared, with the width over the motion and K of its middle");
    bool listed = false;
    for (const FormCandidate& c : candidates_.of(natural)) {
      line("      {:<32} width {:>10}, {} occurrences{}", c.passes, width_text(c.width),
           total(c.occurrences), c.passes == statistics.passes ? ": kept" : "");
      listed = listed || c.passes == statistics.passes;
    }
    if (!listed)
      line("      {:<32} width {:>10}, {} occurrences: kept", statistics.passes,
           width_text(candidates_.width(form)), total(statistics.rewritten));
  }

  void left_entries() {
    line("K·A, K known when the kernel runs (T-RO 2007, §III-B1){}",
         options_.all_entries ? "" : "; the other rows have the same forms in other entries of K");
    const std::vector<EntryStatistics>& statistics = f_.statistics.at("left_product");
    for (int i = 0; i < (options_.all_entries ? f_.columns : 1); ++i)
      for (int c = 0; c < f_.columns; ++c) {
        Expressions natural;
        for (int j = 0; j < f_.rows; ++j)
          natural.push_back(point(point_name(i + 1, j + 1)) *
                            (changed_.empty() ? matrix_ : changed_)[at(j, c, f_.columns)]);
        const std::size_t k = at(i, c, f_.columns);
        entry(fmt::format("(K·A)({},{})", i + 1, c + 1), sum(std::move(natural)),
              in_row(f_.left_product.first[std::size_t(c)], i + 1), statistics[k]);
      }
    line("");
  }

  void right_entries() {
    line("A·K{}", options_.all_entries
                      ? ""
                      : "; the other columns have the same forms in other entries of K");
    const std::vector<EntryStatistics>& statistics = f_.statistics.at("right_product");
    for (int r = 0; r < f_.rows; ++r)
      for (int c = 0; c < (options_.all_entries ? f_.rows : 1); ++c) {
        Expressions natural;
        for (int j = 0; j < f_.columns; ++j)
          natural.push_back(point(point_name(j + 1, c + 1)) * matrix_[at(r, j, f_.columns)]);
        const std::size_t k = at(r, c, f_.rows);
        entry(fmt::format("(A·K)({},{})", r + 1, c + 1), sum(std::move(natural)),
              in_column(f_.right_product.first[std::size_t(r)], c + 1), statistics[k]);
      }
    line("");
  }

  void closed_form() {
    line("det A in closed form: {} terms were multiplied out", f_.determinant_terms);
    line("  {}", shortened(f_.determinant[0], options_.longest));
    line("    occurrences: {}", to_text(count_occurrences(f_.determinant)));
    line("");
  }

  void occurrence_table() {
    line("Occurrences of each variable, as written → rewritten");
    line("  {:<16}{:>16}{:>16}{:>16}", "", "A", "K·A", "A·K");
    std::map<std::string, std::pair<Occurrences, Occurrences>> totals;
    for (const auto& [function, entries] : f_.statistics)
      totals[function] = {added_up(entries, &EntryStatistics::natural),
                          added_up(entries, &EntryStatistics::rewritten)};
    for (const Variable& v : f_.variables) {
      std::string row = fmt::format("  {:<16}", v.name);
      for (const char* function : {"matrix", "left_product", "right_product"}) {
        const auto found = totals.find(function);
        row += fmt::format("{:>16}",
                           found == totals.end()
                               ? "-"
                               : fmt::format("{} → {}", count_of(found->second.first, v.name),
                                             count_of(found->second.second, v.name)));
      }
      line("{}", row);
    }
    line("");
  }

  void functions() {
    line("Functions of the kernel{}", kernel_ ? " that a check with this method calls" : "");
    const auto& statistics = (kernel_ ? *kernel_ : f_).statistics;
    for (const Function& function : module_.functions) {
      const auto operations =
          std::count_if(function.program.nodes.begin(), function.program.nodes.end(), is_operation);
      std::map<std::string, int> passes;
      for (const EntryStatistics& entry : statistics.at(function.name)) ++passes[entry.passes];
      std::string chosen;
      for (const auto& [name, count] : passes)
        chosen += fmt::format("{}{} {}", chosen.empty() ? "" : ", ", name, count);
      line("  {:<18}{:>5} outputs {:>6} operations  forms: {}", function.name,
           function.program.outputs.size(), operations, chosen);
    }
  }

  static std::size_t at(int row, int column, int columns) {
    return static_cast<std::size_t>(row * columns + column);
  }

  Formulation f_;
  Module module_;
  const ExplainOptions options_;
  const std::vector<SingularFactor> factors_;
  std::optional<Formulation> kernel_;
  Expressions matrix_, changed_;
  FormCandidates candidates_;
  std::string text_;
};

/// The matrix of equations, with the unknowns as further variables: for its forms alone.
Model with_unknowns_as_pose(Model model) {
  model.pose.insert(model.pose.end(), model.closure->unknowns.begin(),
                    model.closure->unknowns.end());
  model.closure.reset();
  return model;
}

std::string equations_text(const Closure& closure, std::size_t longest) {
  std::string text = "The equations, each 0; A has their derivatives by the unknowns";
  for (const PoseParameter& unknown : closure.unknowns)
    text += (&unknown == closure.unknowns.data() ? " " : ", ") + unknown.name;
  for (std::size_t i = 0; i < closure.equations.size(); ++i)
    text += fmt::format("\n  F({}) = {}", i + 1,
                        shortened(formula_text(closure.equations[i]), longest));
  return text + "\n\n";
}

}  // namespace

Explanation explain(const Model& model, const Motion& motion, const ExplainOptions& options) {
  if (model.closure) return explain(model, options);
  return Explainer(model, motion, options).explanation();
}

Explanation explain(const Model& model, const ExplainOptions& options) {
  ExplainOptions unscaled = options;
  unscaled.formulation.scaling = false;
  if (!model.closure) return explain(model, pose_as_motion(model), unscaled);
  Explanation explained = explain(with_unknowns_as_pose(model), options);
  if (options.part != ExplainPart::kOccurrences)
    explained.text.insert(0, equations_text(*model.closure, options.longest));
  return explained;
}

Motion pose_as_motion(const Model& model) {
  Motion motion;
  for (const PoseParameter& p : model.pose) {
    motion.parameters.push_back({p.symbol, p.name, p.unit, {0, 0}});
    motion.pose.push_back(p.symbol);
    motion.error.push_back(0);
  }
  return motion;
}

}  // namespace regulus::detail
