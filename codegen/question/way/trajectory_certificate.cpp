// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/trajectory_certificate.hpp"

#include "codegen/answer/certificate/certificate_question.hpp"

namespace regulus::detail {
namespace {

/// Returns the reason why there is no proof; empty if it was written.
std::string write_safe(const std::string& path, const TrajectoryCheck& check,
                       const CertifiedMotion& motion, const ProofPlacing& placing) {
  const auto uncertain = uncertain_names(check.hull.labels);
  std::string obstacle =
      certificate_obstacle(motion.about(piece_request(motion.request, 0), uncertain));
  if (!obstacle.empty()) return obstacle;
  const CertifiedQuestion question = trajectory_question(motion.request, uncertain, motion.about);
  write_pieces(path, question.head(false), check.path.trees, certificate_word, placing);
  return "";
}

std::string write_singular(const std::string& path, const TrajectoryCheck& check,
                           const CertifiedMotion& motion, const ProofPlacing& placing) {
  const DecidingPiece& piece = *check.deciding;
  const CertifiedQuestion question = motion.about(piece_request(motion.request, piece.index),
                                                  uncertain_names(piece.preparation->labels));
  std::string obstacle = certificate_obstacle(question, true);
  if (!obstacle.empty()) return obstacle;
  write_witness(path, question.head(true), witness_lines(piece.result), placing);
  return "";
}

}  // namespace

std::shared_ptr<ProofFile> proof_of_pieces(const std::string& path, const std::string& head,
                                           const std::vector<TreeKept>& trees, LeafWord word) {
  return with_file_errors([&] {
    auto proof = std::make_shared<ProofFile>(path);
    proof->begin(head);
    for (const TreeKept& tree : trees) {
      proof->begin_tree();
      tree.write_to(*proof, word);
    }
    proof->complete();
    return proof;
  });
}

void write_pieces(const std::string& path, const std::string& head,
                  const std::vector<TreeKept>& trees, LeafWord word, const ProofPlacing& placing) {
  put_in_place(proof_of_pieces(path, head, trees, word), placing);
}

ProofStatus certify_trajectory(const std::string& path, const TrajectoryCheck& check,
                               const ProofPlacing& placing) {
  return certify_trajectory(path, check, {check.request, is_regular()}, placing);
}

ProofStatus certify_trajectory(const std::string& path, const TrajectoryCheck& check,
                               const CertifiedMotion& motion, const ProofPlacing& placing) {
  ProofStatus status(path);
  if (!status.is_wanted()) return status;
  if (check.verdict == Verdict::kPossibleProblem)
    status.set_obstacle(kNothingClaimed);
  else
    status.attempt([&] {
      status.set_obstacle(check.verdict == Verdict::kNoSingularity
                              ? write_safe(path, check, motion, placing)
                              : write_singular(path, check, motion, placing));
    });
  if (status.obstacle().empty()) status.set_written();
  return status;
}

}  // namespace regulus::detail
