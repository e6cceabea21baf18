// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closure_certificate.hpp"

#include <fmt/format.h>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/answer/certificate/piece_question.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/closure/branch_threshold.hpp"

namespace regulus::detail {
namespace {

/// A reader with other roundings finds the configuration within so many of its radii.
constexpr double kRoomOfReader = 0x1p10;

std::string numbers(const std::vector<double>& list) {
  std::string words;
  for (const double x : list) words += fmt::format(" {:a}", x);
  return words;
}

std::string tube_numbers(const BranchTube& tube) {
  return numbers(tube.at) + numbers(tube.center) + numbers(tube.slopes) + numbers(tube.radius);
}

/// Returns the lines of the proof that a branch reaches a singular configuration.
std::string fold_lines(const PreparedClosure& prepared, const FoldPath& path) {
  std::string text = fmt::format("reason {}\n{}", format::kFold, format::kTowards);
  const std::size_t parameters = prepared.shape.parameters;
  for (std::size_t k = 0; k < prepared.shape.variables; ++k) {
    const bool stays = !prepared.problem.inner[k] || (k >= parameters && path.uncertain.empty());
    text += stays ? fmt::format(" {}", format::kStays)
                  : numbers({k < parameters ? path.towards[k] : path.uncertain[k - parameters]});
  }
  text += '\n';
  for (const CurveArc& arc : path.arcs)
    text += fmt::format("{} {} {:a} : {:a}{}\n", format::kArc, arc.coordinate, arc.range.lo,
                        arc.range.hi, tube_numbers(arc.tube));
  std::vector<double> radius = path.end.radius;
  for (double& r : radius) r *= kRoomOfReader;
  return text + format::kFold + numbers(path.end.center) + numbers(radius) + numbers(path.normal) +
         "\nend\n";
}

/// Returns a request with the first pieces of its trajectory.
Request first_pieces(const Request& request, std::size_t pieces) {
  auto trajectory = std::make_shared<Trajectory>(*request.motion.trajectory);
  trajectory->pieces.erase(trajectory->pieces.begin() + std::ptrdiff_t(pieces),
                           trajectory->pieces.end());
  Request result = request;
  result.motion.trajectory = std::move(trajectory);
  return result;
}

std::string leaf_word(const BranchLeaf& leaf) {
  return leaf.tube ? format::kTubeLeaf + tube_numbers(*leaf.tube)
                   : std::string(format::kOutsideLeaf);
}

/// Writes the pieces up to a singular configuration: the trees of those before, and the way to it.
void write_later_fold(const std::string& path, const PreparedWay& prepared, const WayFinding& found,
                      const ProofPlacing& placing) {
  const PieceWithoutBranch& last = *found.deciding;
  std::string proof;
  for (std::size_t k = 0; k < last.index; ++k) {
    const BranchTree& tree = found.pieces[k].branch.tree;
    proof += "tree\n";
    for (const Split& split : tree.splits())
      proof += fmt::format("s {} {} {:a}\n", split.parent, split.variable, split.at);
    for (const BranchLeaf& leaf : tree.leaves())
      proof += fmt::format("l {} {}\n", leaf.at.id, leaf_word(leaf));
  }
  const CertifiedQuestion question =
      trajectory_question(first_pieces(prepared.request, last.index + 1),
                          uncertain_names(prepared.common.preparation.labels));
  write_witness(path, question.head(true), proof + fold_lines(*last.alone, last.fold->path),
                placing);
}

}  // namespace

void write_tree(ProofFile& file, const BranchTree& tree, std::span<const char* const> words) {
  for (const Split& split : tree.splits()) file.split(split);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const BranchLeaf& leaf = tree.leaves()[i];
    std::string text = words[i];
    if (format::has_tube(text)) text += tube_numbers(*leaf.tube);
    file.leaf(leaf.at.id, text.c_str());
  }
}

void write_tree(ProofFile& file, const BranchTree& tree) {
  std::vector<const char*> words;
  for (const BranchLeaf& leaf : tree.leaves())
    words.push_back(leaf.tube ? format::kTubeLeaf : format::kOutsideLeaf);
  write_tree(file, tree, words);
}

ProofStatus certify_fold(const std::string& path, const PreparedClosure& prepared, const Fold& fold,
                         const ProofPlacing& placing) {
  ProofStatus status(path);
  if (!status.is_wanted()) return status;
  status.attempt([&] {
    const CertifiedQuestion question =
        certified_question(prepared.request, uncertain_names(prepared.preparation.labels));
    status.set_obstacle(certificate_obstacle(question, true));
    if (!status.obstacle().empty()) return;
    write_witness(path, question.head(true), fold_lines(prepared, fold.path), placing);
  });
  if (status.obstacle().empty()) status.set_written();
  return status;
}

ProofStatus certify_way(const std::string& path, const PreparedWay& prepared,
                        const WayFinding& found, const ProofPlacing& placing) {
  const bool is_refuted = found.is_refuted();
  if (found.threshold && !is_refuted)
    return certify_threshold(path, pieces_of(prepared, found), *found.threshold, placing);
  if (is_refuted && found.deciding->index == 0)
    return certify_fold(path, *found.deciding->alone, *found.deciding->fold, placing);
  ProofStatus status(path);
  if (!status.is_wanted()) return status;
  if (found.deciding && !is_refuted) {
    status.set_obstacle(kNothingClaimed);
    return status;
  }
  status.attempt([&] {
    const auto uncertain = uncertain_names(prepared.common.preparation.labels);
    status.set_obstacle(
        certificate_obstacle(certified_question(piece_request(prepared.request, 0), uncertain)));
    if (!status.obstacle().empty()) return;
    if (is_refuted) return write_later_fold(path, prepared, found, placing);
    const CertifiedQuestion question = trajectory_question(prepared.request, uncertain);
    const auto file = with_file_errors([&] { return std::make_shared<ProofFile>(path); });
    file->begin(question.head(false));
    for (const ClosureResult& piece : found.pieces) {
      file->begin_tree();
      write_tree(*file, piece.branch.tree);
    }
    with_file_errors([&] { file->complete(); });
    put_in_place(file, placing);
  });
  if (status.obstacle().empty()) status.set_written();
  return status;
}

ProofStatus certify_check(const std::string& path, const PreparedClosure& prepared,
                          const ClosureFinding& found, const ProofPlacing& placing) {
  if (found.is_refuted()) return certify_fold(path, prepared, *found.reached(), placing);
  if (!found.threshold) return certify_branch(path, prepared, found.searched, placing);
  return certify_threshold(path, pieces_of(prepared, found.searched), *found.threshold, placing);
}

ProofStatus certify_branch(const std::string& path, const PreparedClosure& prepared,
                           const ClosureResult& result, const ProofPlacing& placing) {
  ProofStatus status(path);
  if (!status.is_wanted()) return status;
  if (!result.is_proved()) {
    status.set_obstacle(kNothingClaimed);
    return status;
  }
  status.attempt([&] {
    const CertifiedQuestion question =
        certified_question(prepared.request, uncertain_names(prepared.preparation.labels));
    status.set_obstacle(certificate_obstacle(question));
    if (!status.obstacle().empty()) return;
    const auto file = with_file_errors([&] { return std::make_shared<ProofFile>(path); });
    file->begin(question.head(false));
    write_tree(*file, result.branch.tree);
    with_file_errors([&] { file->complete(); });
    put_in_place(file, placing);
  });
  if (status.obstacle().empty()) status.set_written();
  return status;
}

}  // namespace regulus::detail
