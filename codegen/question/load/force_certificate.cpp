// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/force_certificate.hpp"

#include <fmt/format.h>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/question/way/trajectory_certificate.hpp"
#include "runtime/proof/writer.hpp"

namespace regulus::detail {
namespace {

const char* word_of(Rule rule) noexcept {
  switch (rule) {
    case Rule::kHMatrix:
      return format::kFeasibleLeaf;
    case Rule::kWitness:
      return format::kInfeasibleLeaf;
    case Rule::kOutside:
      return format::kOutsideLeaf;
    default:
      return format::kUndecidedLeaf;
  }
}

std::string shortage_lines(const ForceWitness& witness) {
  std::string lines = fmt::format("reason {}\npoint 0", format::kShortage);
  for (const Interval& x : witness.variables) lines += ' ' + coordinate_text(x);
  lines += "\ndirection";
  for (const double y : witness.shortage.direction) lines += fmt::format(" {:a}", y);
  return lines + "\nend\n";
}

std::set<std::string> uncertain_of(const PreparedForces& prepared) {
  return uncertain_names(prepared.preparation.labels);
}

/// Returns the reason why there is no proof; empty if it was written.
std::string write_feasible(const std::string& path, const WayForces& found,
                           const ProofPlacing& placing) {
  const PreparedForces& hull = found.hull;
  const VectorSet& load = choose_load(found.request.model, hull.load);
  std::string obstacle = certificate_obstacle(
      certified_load(piece_request(found.request, 0), uncertain_of(hull), load));
  if (!obstacle.empty()) return obstacle;
  const CertifiedLoad question = certified_load(found.request, uncertain_of(hull), load);
  write_pieces(path, question.head(format::kFeasible), found.trees, word_of, placing);
  return "";
}

std::string write_infeasible(const std::string& path, const PreparedForces& piece,
                             const ForceWitness& witness, const ProofPlacing& placing) {
  const CertifiedLoad question = certified_load(piece.request, uncertain_of(piece), piece.set());
  std::string obstacle = certificate_obstacle(question);
  if (!obstacle.empty()) return obstacle;
  write_witness(path, question.head(format::kInfeasible), shortage_lines(witness), placing);
  return "";
}

}  // namespace

ForceCertificate::ForceCertificate(const std::string& path, const PreparedForces& prepared,
                                   bool paves, std::uint64_t shard_size)
    : paves_(paves), status_(path) {
  if (!status_.is_wanted()) return;
  question_ = certified_load(prepared.request, uncertain_of(prepared), prepared.set());
  status_.set_obstacle(certificate_obstacle(question_));
  if (!status_.obstacle().empty()) return;
  with_file_errors([&] { file_.emplace(path); });
  file_->set_shard_size(shard_size);
  file_->begin(question_.head(paves ? format::kPaving : format::kFeasible));
}

void ForceCertificate::on_split(const OpenBox&, const Split& split) noexcept {
  file_->split(split);
}

void ForceCertificate::on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept {
  file_->leaf(box.id, word_of(rule));
}

void ForceCertificate::finish(const FeasibilityResult& result) {
  if (!file_) return;
  if (paves_ && result.is_empty) return status_.set_obstacle("the constraints exclude every pose");
  if (!paves_ && result.verdict == FeasibilityVerdict::kPossibleProblem)
    return status_.set_obstacle(kNothingClaimed);
  status_.attempt([&] { write(result); });
}

void ForceCertificate::write(const FeasibilityResult& result) {
  with_file_errors([&] {
    if (!paves_ && result.verdict == FeasibilityVerdict::kInfeasible)
      file_->finish_with(question_.head(format::kInfeasible), shortage_lines(*result.witness));
    else
      file_->finish();
  });
  status_.set_written();
}

ProofStatus certify_way_forces(const std::string& path, const WayForces& found,
                               const ProofPlacing& placing) {
  ProofStatus status(path);
  if (!status.is_wanted()) return status;
  if (found.verdict == FeasibilityVerdict::kPossibleProblem)
    status.set_obstacle(kNothingClaimed);
  else
    status.attempt([&] {
      status.set_obstacle(found.verdict == FeasibilityVerdict::kFeasible
                              ? write_feasible(path, found, placing)
                              : write_infeasible(path, *found.deciding->prepared,
                                                 *found.deciding->result.witness, placing));
    });
  if (status.obstacle().empty()) status.set_written();
  return status;
}

}  // namespace regulus::detail
