// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/value_certificate.hpp"

#include <fmt/format.h>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/load_question.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/question/closure/closure_certificate.hpp"
#include "codegen/question/closure/singular_values.hpp"
#include "codegen/question/quantity/inverse_in_one_unit.hpp"
#include "codegen/question/quantity/quantity_traits.hpp"

namespace regulus {
namespace {

using GiNaC::ex;

/// The lines about a quantity over a branch, and its words.
struct ValueLines {
  std::string text;
  format::ClaimedBound words;
};

class ValueText {
 public:
  ValueText(const Model& model, const Component& component) : model_(model), c_(component) {
    words_.is_of_closure = true;
  }

  ValueLines lines(const ex& bound) && {
    const ClosureTraits& traits = closure_traits_of(c_.kind);
    put("quantity", words_.quantity = traits_of(c_.kind).certified);
    put("side", words_.side = side());
    if (traits.components == ComponentsOf::kRows)
      put("row", words_.row = std::to_string(c_.row + 1));
    if (traits.components == ComponentsOf::kFreedoms)
      put("column", words_.columns = std::to_string(c_.column + 1));
    if (c_.set != nullptr) {
      put("load", words_.set = c_.set->name);
      text_ += vector_lines(*c_.set);
    }
    if (traits.data == NeededData::kMotorErrors) put_each("motor-error", model_.actuators.error);
    if (traits.data == NeededData::kMotorSpeeds) put_each("motor-speed", model_.actuators.speed);
    if (traits.data == NeededData::kLoadAndStiffness)
      put_each("stiffness", model_.actuators.stiffness);
    if (c_.kind == QuantityKind::kCondition || SingularValues::are_of(c_.kind))
      put_each("factor", column_scales(model_));
    put("bound", words_.bound = expression_text(bound));
    return {std::move(text_), std::move(words_)};
  }

 private:
  [[nodiscard]] const char* side() const {
    if (traits_of(c_.kind).is_always_least) return format::kLeast;
    if (c_.is_absolute) return format::kAbsolute;
    return c_.sign < 0 ? format::kLeast : format::kLargest;
  }
  void put(const std::string& key, const std::string& value) { text_ += key + ' ' + value + '\n'; }
  void put_each(const std::string& key, const std::vector<ex>& values) {
    for (const ex& value : values) put(key, expression_text(value));
  }

  const Model& model_;
  const Component& c_;
  format::ClaimedBound words_;
  std::string text_;
};

ValueLines lines_of_limits(const Model& model, const VectorSet& load) {
  ValueLines lines;
  lines.words.is_of_closure = true;
  lines.words.quantity = format::kForceLimits;
  lines.words.set = load.name;
  lines.text = std::string("quantity ") + format::kForceLimits + '\n' + load_lines(model, load);
  return lines;
}

CertifiedQuestion question_of(const PreparedClosure& prepared, const ValueLines& lines) {
  const std::set<std::string> uncertain = uncertain_names(prepared.preparation.labels);
  CertifiedQuestion question = certified_question(prepared.request, uncertain);
  question.text += lines.text;
  const format::ClaimedSet set = claimed_set(prepared.request, uncertain);
  question.no_singularity = format::describe_bound_claim(set, lines.words, false);
  question.singularity = format::describe_bound_claim(set, lines.words, true);
  return question;
}

/// Returns `value X …`: the place of an attained end.
std::string value_line(std::span<const Interval> place) {
  std::string line = format::kValue;
  for (const Interval& x : place)
    line += is_thin(x) ? fmt::format(" {:a}", x.lo) : fmt::format(" {}", format::kOnlyValue);
  return line + '\n';
}

/// Throws FileError.
void write_value(const std::string& path, const CertifiedQuestion& question, const BranchTree& tree,
                 PlaceOfValue place, const ProofPlacing& placing) {
  const auto file = with_file_errors([&] { return std::make_shared<ProofFile>(path); });
  file->begin(question.head(place.has_value()) + (place ? value_line(*place) : ""));
  write_tree(*file, tree);
  with_file_errors([&] { file->complete(); });
  put_in_place(file, placing);
}

}  // namespace

ProofStatus certify_forces(const std::string& path, const PreparedClosure& prepared,
                           const VectorSet& load, const BranchTree& tree, PlaceOfValue place,
                           const ProofPlacing& placing) {
  ProofStatus status(path);
  if (!status.is_wanted()) return status;
  const CertifiedQuestion question =
      question_of(prepared, lines_of_limits(prepared.request.model, load));
  status.set_obstacle(certificate_obstacle(question, place.has_value()));
  if (!status.obstacle().empty()) return status;
  status.attempt([&] { write_value(path, question, tree, place, placing); });
  if (status.obstacle().empty()) status.set_written();
  return status;
}

void certify_value(EndProofs& proofs, const PreparedClosure& prepared, const Component& component,
                   const ex& bound, const BranchTree& tree, PlaceOfValue place) {
  if (!proofs.are_wanted()) return;
  const bool is_attained = place.has_value();
  const auto refuse = [&](const std::string& why) {
    is_attained ? proofs.set_no_singular(why) : proofs.set_no_safe(why);
  };
  const CertifiedQuestion question =
      question_of(prepared, ValueText(prepared.request.model, component).lines(bound));
  if (const std::string why = certificate_obstacle(question, is_attained); !why.empty())
    return refuse(why);
  try {
    write_value(is_attained ? proofs.singular_file() : proofs.safe_file(), question, tree, place,
                {proofs.placing().held, 0});
    const std::string number = formula_text(bound);
    if (is_attained)
      proofs.set_singular("attains " + number);
    else
      proofs.set_safe("keeps " + number);
  } catch (const FileError& why) {
    is_attained ? proofs.lose_singular(why.what()) : proofs.lose_safe(why.what());
  }
}

}  // namespace regulus
