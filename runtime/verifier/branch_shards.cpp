// SPDX-License-Identifier: Apache-2.0
// Whoever proves a leaf has its box and its tube, and needs no other leaf. Links need the tubes of
// neighbours, which may be in different shards. So one process reads the lines of all shards here, as a
// reader of one file would, from box 0 on. The boxes that wait where a shard begins, and the digest of
// its lines, are those with which its leaves were proved: so each box and tube here is that of a leaf
// that is proved, also if another process has proved it, or a file has changed meanwhile.
#include "runtime/verifier/branch_shards.hpp"

#include <optional>

#include "runtime/verifier/branch_tree.hpp"

namespace regulus::verifier {
namespace {

class ShardLinker {
 public:
  ShardLinker(const ProvedShards& shards, const Options& options, WorkClock& clock,
              Verification& result)
      : shards_(shards), options_(options), clock_(clock), result_(result) {}

  void link() {
    begin_tree(0);
    for (std::size_t i = 0; i < shards_.listed.size(); ++i)
      read(shards_.listed[i], shards_.proofs[i]);
    if (tree_ + 1 != shards_.trees.count) throw Rejection("there are pieces without a tree");
    end_tree();
  }

 private:
  void begin_tree(std::size_t tree) {
    tree_ = tree;
    const TreeQuestion about = shards_.trees.about(tree);
    question_ = &about.question;
    outer_ = about.variety.outer;
    open_ = {};
    open_.boxes.emplace(0, outer_);
    branch_.emplace(about.question, about.variety, options_, clock_);
  }

  /// Links the tubes of the tree, also with those of the tree before it.
  void end_tree() {
    if (!open_.boxes.empty()) throw Rejection("there are boxes without a leaf");
    branch_->check(shards_.index, result_, before_ ? &*before_ : nullptr);
    if (branch_->starts_in_set()) result_.note.clear();
    before_ = branch_->take_boxes();
  }

  void read(const ListedShard& listed, const ShardProof& proof) {
    std::optional<ShardFile> file;
    detail::Sha256 digest;
    in_shard(listed, [&] {
      file.emplace(format::shard_file(options_.path, listed.number), listed, shards_.trees.sha256);
      if (shards_.trees.is_piecewise) static_cast<void>(file->read_piece(shards_.trees.count));
      static_cast<void>(file->read_open(outer_));
      if (state_text(tree_, open_) != proof.before)
        throw Rejection("it does not begin where the shard before it ends");
      file->lines().digest_into(digest);
    });
    while (begins_tree_after_lines(listed, file->lines())) {
      end_tree();
      begin_tree(tree_ + 1);
    }
    in_shard(listed, [&] {
      if (digest.text() != proof.lines)
        throw Rejection("its lines are not those whose leaves were proved");
    });
  }

  /// Reads the lines of one tree, up to the end of the shard or to the line `tree`.
  bool begins_tree_after_lines(const ListedShard& listed, Lines& lines) {
    branch_->begin_shard({listed.number, listed.line});
    in_shard(listed, [&] {
      static_cast<void>(TreeReader(lines, *question_, open_, nullptr, clock_, &*branch_).read());
    });
    return shards_.trees.is_piecewise && lines.text() == "tree" && tree_ + 1 < shards_.trees.count;
  }

  /// A message about a file names its shard.
  template <class Action>
  void in_shard(const ListedShard& listed, const Action& action) {
    const std::string here = "shard " + std::to_string(listed.number) + ": ";
    shards_.index.name_line(listed.line);
    try {
      action();
    } catch (const Rejection& why) {
      throw Rejection(here + why.what());
    } catch (const Unfinished& why) {
      throw Unfinished(here + why.what());
    }
    shards_.index.name_line(0);
  }

  const ProvedShards& shards_;
  const Options& options_;
  WorkClock& clock_;
  Verification& result_;
  std::size_t tree_ = 0;  ///< that is read, from 0
  Question* question_ = nullptr;
  Box outer_;
  OpenBoxes open_;
  std::optional<BranchTree> branch_;
  std::optional<BranchBoxes> before_;  ///< of the tree before it
};

}  // namespace

void link_shards(const ProvedShards& shards, const Options& options, WorkClock& clock,
                 Verification& result) {
  ShardLinker(shards, options, clock, result).link();
}

}  // namespace regulus::verifier
