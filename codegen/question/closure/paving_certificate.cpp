// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/paving_certificate.hpp"

#include <algorithm>

#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/question/closure/branch_threshold.hpp"
#include "codegen/question/closure/closure_certificate.hpp"

namespace regulus::detail {
namespace {

constexpr const char* kNothingCertain = "the branch is certain on no box";

bool has_tubes(const PavedTree& tree) {
  return std::ranges::any_of(tree.words, [](const char* word) { return format::has_tube(word); });
}

}  // namespace

PavedTree PavedTree::of(const ClosureResult& piece) {
  PavedTree paved{&piece.branch.tree};
  const std::vector<BranchLeaf>& leaves = piece.branch.tree.leaves();
  const std::vector<char>& on_branch = piece.links.on_branch;
  for (std::size_t i = 0; i < leaves.size(); ++i)
    paved.words.push_back(i < on_branch.size() && on_branch[i] != 0 ? format::kTubeLeaf
                          : leaves[i].is_outside                    ? format::kOutsideLeaf
                                                                    : format::kUndecidedLeaf);
  return paved;
}

Claim PavedTree::claim_of(std::size_t leaf) const {
  const std::string_view word = words[leaf];
  if (word == format::kOutsideLeaf || tree->leaves()[leaf].is_outside) return Claim::kOutside;
  if (word == format::kInfeasibleLeaf) return Claim::kSingular;
  return word == (has_threshold ? format::kFeasibleLeaf : format::kTubeLeaf) ? Claim::kFree
                                                                             : Claim::kUndecided;
}

std::vector<PavedTree> paved_trees(std::span<const ClosureResult> pieces,
                                   const std::optional<ThresholdFinding>& threshold) {
  std::vector<PavedTree> trees;
  if (threshold)
    for (const BranchPaving& piece : threshold->paved)
      trees.push_back({&piece.tree, piece.words, true});
  else
    for (const ClosureResult& piece : pieces) trees.push_back(PavedTree::of(piece));
  return trees;
}

ProofStatus certify_paved(const std::string& path, const Request& request,
                          const ReportLabels& labels, const std::vector<PavedTree>& trees,
                          const CertifiedAbout& about, const ProofPlacing& placing) {
  ProofStatus status(path);
  if (!status.is_wanted()) return status;
  const bool has_pieces = request.motion.trajectory != nullptr;
  const std::set<std::string> uncertain = uncertain_names(labels);
  const auto head_of = [](const CertifiedQuestion& question) {
    return head_text(format::kPaving, question.paving, question.text);
  };
  if (trees.empty() || !has_tubes(trees.front()))
    status.set_obstacle(kNothingCertain);
  else
    status.set_obstacle(obstacle_of_head(
        head_of(about(has_pieces ? piece_request(request, 0) : request, uncertain))));
  if (!status.obstacle().empty()) return status;
  status.attempt([&] {
    const auto file = with_file_errors([&] { return std::make_shared<ProofFile>(path); });
    file->begin(head_of(has_pieces ? trajectory_question(request, uncertain, about)
                                   : about(request, uncertain)));
    for (const PavedTree& paved : trees) {
      if (has_pieces) file->begin_tree();
      if (paved.tree != nullptr && !paved.words.empty())
        write_tree(*file, *paved.tree, paved.words);
      else
        file->leaf(0, format::kUndecidedLeaf);
    }
    with_file_errors([&] { file->complete(); });
    put_in_place(file, placing);
  });
  if (status.obstacle().empty()) status.set_written();
  return status;
}

ProofStatus certify_paving(const std::string& path, const PreparedClosure& prepared,
                           const ClosureFinding& found, const ProofPlacing& placing) {
  if (found.threshold)
    return certify_threshold(path, pieces_of(prepared, found.searched), *found.threshold, placing);
  if (found.searched.is_proved()) return certify_branch(path, prepared, found.searched, placing);
  return certify_paved(path, prepared.request, prepared.preparation.labels,
                       {PavedTree::of(found.searched)}, is_regular(), placing);
}

ProofStatus certify_paving(const std::string& path, const PreparedWay& prepared,
                           const WayFinding& found, const ProofPlacing& placing) {
  if (found.threshold)
    return certify_threshold(path, pieces_of(prepared, found), *found.threshold, placing);
  if (found.is_proved()) return certify_way(path, prepared, found, placing);
  std::vector<PavedTree> trees = paved_trees(found.pieces, {});
  trees.resize(prepared.pieces());
  return certify_paved(path, prepared.request, prepared.common.preparation.labels, trees,
                       is_regular(), placing);
}

}  // namespace regulus::detail
