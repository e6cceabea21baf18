// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/closure_certificate.hpp"

#include <fmt/format.h>

#include "codegen/answer/certificate/certificate_question.hpp"

namespace regulus {
namespace {

std::string tube_words(const BranchTube& tube) {
  std::string words = "tube";
  for (const auto* list : {&tube.at, &tube.center, &tube.slopes, &tube.radius})
    for (const double x : *list) words += fmt::format(" {:a}", x);
  return words;
}

void write_tree(ProofFile& file, const BranchTree& tree) {
  for (const Split& split : tree.splits()) file.split(split);
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
