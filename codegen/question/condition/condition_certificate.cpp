// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/condition_certificate.hpp"

#include <fmt/format.h>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/question/bound/bound_certificate.hpp"
#include "codegen/question/way/trajectory_certificate.hpp"
#include "runtime/proof/format.hpp"

namespace regulus::detail {

ConditionCertificate::ConditionCertificate(const std::string& path, const Request& request,
                                           const Component& component,
                                           const std::set<std::string>& uncertain,
                                           const ProofPlacing& placing)
    : proofs_(path, placing, "no bound was proved", "no pose shows it", "upper", "attained"),
      request_(request),
      component_(component),
      uncertain_(uncertain) {
  if (request.motion.trajectory) pieces_.emplace(request.motion.trajectory->pieces.size());
}

Observer* ConditionCertificate::observer() noexcept {
  if (!proofs_.are_wanted()) return nullptr;
  return pieces_ ? static_cast<Observer*>(&*pieces_) : &tree_;
}

CertifiedAbout ConditionCertificate::about(const GiNaC::ex& number) const {
  Bordered itself;
  itself.is_reciprocal = number.is_zero();
  return [this, itself, number](const Request& request, const std::set<std::string>& uncertain) {
    return certified_bound(request, component_, itself, number, uncertain);
  };
}

CertifiedQuestion ConditionCertificate::on_piece(std::size_t piece, const CertifiedAbout& about,
                                                 const std::set<std::string>& uncertain) const {
  return about(pieces_ ? piece_request(request_, piece) : request_, uncertain);
}

bool ConditionCertificate::is_refused(const CertifiedQuestion& question, bool is_singular) {
  const std::string obstacle = certificate_obstacle(question, is_singular);
  if (obstacle.empty()) return false;
  proofs_.set_no_safe(obstacle);
  proofs_.set_no_singular(obstacle);
  return true;
}

void ConditionCertificate::prove(const BoundEnd& end) {
  if (!proofs_.are_wanted()) return;
  const CertifiedAbout about = this->about(end.exact);
  const CertifiedQuestion one = on_piece(0, about, uncertain_);
  if (is_refused(one, false)) return;
  const auto complete = [&] {
    return pieces_ ? proof_of_pieces(proofs_.safe_file(),
                                     trajectory_question(request_, uncertain_, about).head(false),
                                     pieces_->trees(), certificate_word)
                   : proof_of_tree(one.head(false));
  };
  proofs_.write_safe(complete, "below " + rounded_text(end, RoundTo::kAbove));
}

std::shared_ptr<ProofFile> ConditionCertificate::proof_of_tree(const std::string& head) const {
  return with_file_errors([&] {
    auto proof = std::make_shared<ProofFile>(proofs_.safe_file());
    proof->begin(head);
    tree_.write_to(*proof, certificate_word);
    proof->complete();
    return proof;
  });
}

void ConditionCertificate::attain(const BoundEnd& end, const ConditionPlace& place) {
  if (!proofs_.are_wanted()) return;
  const CertifiedQuestion question = on_piece(place.piece, about(end.exact), uncertain_);
  if (is_refused(question, true)) return;
  std::string witness = fmt::format("reason {}\npoint 0", format::kRatio);
  for (const Interval& x : place.variables) witness += ' ' + coordinate_text(x);
  proofs_.write_singular(question.head(true), witness + "\nend\n",
                         "attains " + rounded_text(end, RoundTo::kBelow));
}

void ConditionCertificate::note_ratio() {
  proofs_.set_no_safe(
      "it is the ratio of the bounds of sigma-max and sigma-min, which have one each");
}

void ConditionCertificate::show_singular(const ConditionPlace& place) {
  const GiNaC::matrix& matrix = request_.model.matrix;
  Result result;
  result.verdict = Verdict::kSingularity;
  result.reason = matrix.rows() == matrix.cols() ? Reason::kSmallDeterminant : Reason::kLostRank;
  result.witness.emplace().points.push_back({place.variables, {}, {}, {}, {}});
  show_singular(result, uncertain_, place.piece);
}

void ConditionCertificate::show_singular(const Result& result,
                                         const std::set<std::string>& uncertain,
                                         std::size_t piece) {
  if (!proofs_.are_wanted()) return;
  const CertifiedQuestion question = on_piece(piece, about(0), uncertain);
  if (is_refused(question, true)) return;
  proofs_.write_singular(question.head(true), witness_lines(result), "the matrix is singular");
}

}  // namespace regulus::detail
