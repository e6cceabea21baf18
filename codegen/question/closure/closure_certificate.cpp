// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closure_certificate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/answer/certificate/certificate_question.hpp"

namespace regulus {
namespace {

std::string tube_words(const BranchTube& tube) {
  std::string words = "tube";
  for (const auto* list : {&tube.at, &tube.center, &tube.slopes, &tube.radius})
    for (const double x : *list) words += fmt::format(" {:a}", x);
  return words;
}

/// The splits come in the order of the numbers that they make.
void write_tree(ProofFile& file, const BranchTree& tree) {
  std::vector<BoxId> splits;
  for (BoxId box = 0; box + 1 < 2 * tree.leaves().size(); ++box)
    if (tree.node(box).variable != BranchTree::kNone) splits.push_back(box);
  std::ranges::sort(splits, {}, [&](BoxId box) { return tree.node(box).lower; });
  for (const BoxId box : splits) {
    const BranchTree::Node& node = tree.node(box);
    file.split({box, std::uint32_t(node.variable), node.at, node.lower});
  }
  for (const BranchLeaf& leaf : tree.leaves())
    file.leaf(leaf.at.id, leaf.tube ? tube_words(*leaf.tube).c_str() : format::kOutsideLeaf);
}

}  // namespace

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
    file->set_shard_size(placing.shard_size);
    file->begin(question.head(false));
    write_tree(*file, result.branch.tree);
    with_file_errors([&] { file->complete(); });
    put_in_place(file, placing);
  });
  if (status.obstacle().empty()) status.set_written();
  return status;
}

}  // namespace regulus
