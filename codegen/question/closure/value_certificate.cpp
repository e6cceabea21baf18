// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/value_certificate.hpp"

#include <fmt/format.h>

#include "codegen/answer/certificate/certificate_expression_writer.hpp"
#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/load_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/question/closure/closure_certificate.hpp"
#include "codegen/question/closure/singular_values.hpp"
#include "codegen/question/quantity/inverse_in_one_unit.hpp"
#include "codegen/question/quantity/quantity_traits.hpp"

namespace regulus::detail {
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

/// Returns the question about a motion over ranges, or the common one of all pieces.
CertifiedAbout about(const ValueLines& lines) {
  return [&lines](const Request& request, const std::set<std::string>& uncertain) {
    CertifiedQuestion question = certified_question(request, uncertain);
    question.text += lines.text;
    const format::ClaimedSet set = claimed_set(request, uncertain);
    question.no_singularity = format::describe_bound_claim(set, lines.words, false);
    question.singularity = format::describe_bound_claim(set, lines.words, true);
    if (lines.words.quantity == format::kForceLimits)
      question.paving = format::describe_branch_paving(set, lines.words.set);
    return question;
  };
}

/// Writes the proof of one end of a value.
class ValueProof {
 public:
  ValueProof(const ProvedPieces& branch, CertifiedAbout about,
             const std::optional<PlaceOfValue>& place)
      : branch_(branch),
        about_(std::move(about)),
        place_(place),
        uncertain_(uncertain_names(branch.labels)) {}

  /// Returns why the verifier could not read it; empty if it can.
  [[nodiscard]] std::string obstacle() const {
    const Request& request = branch_.request;
    return certificate_obstacle(
        about_(has_pieces() ? piece_request(request, 0) : request, uncertain_), place_.has_value());
  }

  /// Throws FileError.
  void write(const std::string& path, const ProofPlacing& placing) const {
    const CertifiedQuestion question =
        has_pieces() ? trajectory_question(branch_.request, uncertain_, about_)
                     : about_(branch_.request, uncertain_);
    const auto file = with_file_errors([&] { return std::make_shared<ProofFile>(path); });
    file->begin(question.head(place_.has_value()) + (place_ ? value_line() : ""));
    for (const BranchTree* const tree : branch_.trees) {
      if (has_pieces()) file->begin_tree();
      write_tree(*file, *tree);
    }
    with_file_errors([&] { file->complete(); });
    put_in_place(file, placing);
  }

 private:
  [[nodiscard]] bool has_pieces() const { return branch_.request.motion.trajectory != nullptr; }

  /// Returns `value X …`: the place of an attained end; along way-points `value PIECE X …`.
  [[nodiscard]] std::string value_line() const {
    std::string line = format::kValue;
    if (has_pieces()) line += fmt::format(" {}", place_->piece + 1);
    for (const Interval& x : place_->at)
      line += is_thin(x) ? fmt::format(" {:a}", x.lo) : fmt::format(" {}", format::kOnlyValue);
    return line + '\n';
  }

  const ProvedPieces& branch_;
  const CertifiedAbout about_;
  const std::optional<PlaceOfValue>& place_;
  const std::set<std::string> uncertain_;
};

ProofStatus certify(const std::string& path, const ProvedPieces& branch,
                    const CertifiedAbout& about, const std::optional<PlaceOfValue>& place,
                    const ProofPlacing& placing) {
  ProofStatus status(path);
  if (!status.is_wanted()) return status;
  const ValueProof proof(branch, about, place);
  status.set_obstacle(proof.obstacle());
  if (!status.obstacle().empty()) return status;
  status.attempt([&] { proof.write(path, placing); });
  if (status.obstacle().empty()) status.set_written();
  return status;
}

}  // namespace

ProofStatus certify_forces(const std::string& path, const ProvedPieces& branch,
                           const VectorSet& load, const std::optional<PlaceOfValue>& place,
                           const ProofPlacing& placing) {
  const ValueLines lines = lines_of_limits(branch.request.model, load);
  return certify(path, branch, about(lines), place, placing);
}

ProofStatus certify_exceeded(const std::string& path, const ProvedPieces& branch,
                             const std::optional<PlaceOfValue>& place,
                             const ProofPlacing& placing) {
  return certify(path, branch, is_regular(), place, placing);
}

ProofStatus certify_paved_forces(const std::string& path, const ProvedPieces& branch,
                                 const VectorSet& load, const std::vector<PavedTree>& trees,
                                 const ProofPlacing& placing) {
  const ValueLines lines = lines_of_limits(branch.request.model, load);
  return certify_paved(path, branch.request, branch.labels, trees, about(lines), placing);
}

void certify_value(EndProofs& proofs, const ProvedPieces& branch, const Component& component,
                   const ex& bound, const std::optional<PlaceOfValue>& place) {
  if (!proofs.are_wanted()) return;
  const bool is_attained = place.has_value();
  const ValueLines lines = ValueText(branch.request.model, component).lines(bound);
  const ValueProof proof(branch, about(lines), place);
  if (const std::string why = proof.obstacle(); !why.empty())
    return is_attained ? proofs.set_no_singular(why) : proofs.set_no_safe(why);
  try {
    proof.write(is_attained ? proofs.singular_file() : proofs.safe_file(), proofs.placing());
    const std::string number = formula_text(bound);
    if (is_attained)
      proofs.set_singular("attains " + number);
    else
      proofs.set_safe("keeps " + number);
  } catch (const FileError& why) {
    is_attained ? proofs.lose_singular(why.what()) : proofs.lose_safe(why.what());
  }
}

}  // namespace regulus::detail
