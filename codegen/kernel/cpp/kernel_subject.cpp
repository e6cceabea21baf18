// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/kernel_subject.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/kernel/cpp/comment.hpp"
#include "codegen/kernel/cpp/literal.hpp"
#include "codegen/kernel/cpp/names.hpp"
#include "codegen/kernel/cpp/words.hpp"
#include "codegen/kernel/formulation/variety.hpp"

namespace regulus::detail {
namespace {

std::vector<Isa> fastest_first(std::vector<Isa> isas) {
  isas.push_back(Isa::kPortable);
  std::sort(isas.begin(), isas.end());
  isas.erase(std::unique(isas.begin(), isas.end()), isas.end());
  return isas;
}

const std::string& checked_name(const std::string& name) {
  if (!is_free_name(name) || name.starts_with("regulus"))
    throw UsageError("--name: found '" + name +
                     "', expected a C identifier that is not reserved and does not start with "
                     "regulus");
  return name;
}

const std::string& checked_namespace(const std::string& name) {
  for (std::size_t start = 0; start <= name.size();) {
    const std::size_t end = std::min(name.find("::", start), name.size());
    const std::string part = name.substr(start, end - start);
    if (!is_free_name(part) || part == "regulus")
      throw UsageError("--namespace: found '" + name +
                       "', expected C++ identifiers joined by :: that are not reserved");
    start = end + 2;
  }
  return name;
}

std::string claim_in_words(const KernelSubject& subject) {
  std::string text = "for every value of the motion parameters within the bounds";
  if (subject.constraints > 0) text += " at which no constraint of the motion is positive";
  if (!subject.uncertain.empty())
    text += ", and every value of the uncertain quantities in their ranges";
  text +=
      fmt::format(", the full {}×{} matrix of the model is defined and has full {}rank",
                  subject.rows, subject.columns, subject.rows == subject.columns ? "" : "column ");
  if (subject.alpha > 0) text += fmt::format(", and |det J^-1| > {:.6g}", subject.alpha);
  return text + ".";
}

std::string uncertain_quantities(const KernelSubject& subject) {
  if (subject.uncertain.empty()) return "Uncertain: nothing; geometry and control are exact.";
  std::string list;
  for (const SubjectQuantity& quantity : subject.uncertain)
    list += (list.empty() ? "" : "; ") + in_words(quantity);
  return "Uncertain, in every check over the whole range: " + list + ".";
}

}  // namespace

KernelSubject kernel_subject(const Request& request, const Formulation& formulation,
                             const GenerateOptions& options) {
  KernelSubject subject;
  subject.name = checked_name(options.name);
  subject.name_space =
      checked_namespace(options.name_space.empty() ? options.name : options.name_space);
  subject.isas = fastest_first(options.isas);
  subject.command = options.command;
  subject.model = formulation.model;
  subject.motion = formulation.motion;
  subject.source = request.model.source;
  subject.rows = formulation.rows;
  subject.columns = formulation.columns;
  subject.constraints = static_cast<int>(formulation.constraints.size());
  const Variety variety = enclose_variety(request.model, request.motion, formulation.variables);
  subject.alpha = variety.alpha.hi;
  NameTable fields;
  for (std::size_t v = 0; v < formulation.variables.size(); ++v) {
    const Variable& variable = formulation.variables[v];
    SubjectQuantity quantity{variable.name, "", variable.unit == "1" ? "" : variable.unit,
                             variety.outer[v]};
    const bool moves = variable.kind == VariableKind::kMotion;
    if (moves) quantity.field = fields.take(free_name(variable.name));
    (moves ? subject.parameters : subject.uncertain).push_back(std::move(quantity));
  }
  if (subject.parameters.empty())
    throw UsageError("the motion " + subject.motion +
                     " has no range, so it has no pieces to check; give one with --range");
  return subject;
}

std::string in_words(const SubjectQuantity& quantity) {
  const Interval& range = quantity.range;
  const std::string unit = quantity.unit.empty() ? "" : " " + quantity.unit;
  if (range.lo == range.hi) return fmt::format("{} = {:.6g}{}", quantity.name, range.lo, unit);
  return fmt::format("{} in [{:.6g}, {:.6g}]{}", quantity.name, range.lo, range.hi, unit);
}

std::string file_head(const KernelSubject& subject) {
  std::string text =
      "// SPDX-License-Identifier: Apache-2.0\n"
      "// Generated: edit the model, not this file.\n";
  text += labelled_comment("Command", subject.command);
  text += labelled_comment("Model", subject.model);
  text += labelled_comment("Motion", subject.motion);
  if (!subject.source.empty()) text += labelled_comment("Source", subject.source);
  return text + labelled_comment("Identity", subject.identity);
}

std::string claim_comment(const KernelSubject& subject) {
  return comment_lines("", "REGULUS_CHECK_NO_SINGULARITY means: " + claim_in_words(subject)) +
         comment_lines("", uncertain_quantities(subject));
}

std::string bound_list(const std::vector<SubjectQuantity>& quantities, double Interval::*bound) {
  std::string text;
  for (const SubjectQuantity& quantity : quantities)
    text += fmt::format("    {},  // {}\n", literal(quantity.range.*bound),
                        comment_text(quantity.name));
  return text;
}

}  // namespace regulus::detail
