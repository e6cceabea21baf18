// SPDX-License-Identifier: Apache-2.0
// The lines of all shards, one after the other, are the proof of a certificate in one file. Each
// shard begins with the boxes that wait before its first line. The reader knows those that wait
// after its last line: they must be the boxes with which the next shard begins. The first shard
// begins with box 0, and after the last one no box waits. So the leaves of all shards tile box 0,
// in whatever order and by whomever the shards are read. The hashes only tell which file is wrong.
//
// The state between two lines also has the number of the tree. It begins with the first, ends with
// the last, and grows by one at each line `tree`, where no box waits. So every tree tiles its box 0.
//
// The leaves of a branch are linked when all are proved: branch_shards.hpp.
#include "runtime/verifier/shards.hpp"

#include <optional>

#include "runtime/verifier/branch_shards.hpp"
#include "runtime/verifier/shard_file.hpp"

namespace regulus::verifier {
namespace {

class ShardsChecker {
 public:
  ShardsChecker(Lines& lines, const ShardedTrees& trees, const Options& options,
                Verification& result)
      : lines_(lines),
        trees_(trees),
        options_(with_total_progress(options)),
        result_(result),
        clock_(options_, of_shard_) {}

  void check() {
    if (options_.path.empty()) throw Unfinished("the shards of an index need its path");
    listed_ = read_listed(lines_, {"end", "leaves", "LEAVES"});
    result_.shards = listed_.size();
    proofs_of_shards_.resize(listed_.size());
    prove_own_part();
    if (options_.parts > 1) options_.exchange(proofs_of_shards_);
    join();
  }

 private:
  /// The tree whose lines are read.
  struct Tree {
    Tree(std::size_t at, const TreeQuestion& question, const Options& options, WorkClock& clock,
         Verification& counts)
        : number(at),
          about(question),
          proofs(about.question, about.variety, options, clock, counts) {}

    std::size_t number;
    TreeQuestion about;
    LeafProofs proofs;
  };

  Tree& tree_at(std::size_t number) {
    if (tree_ && tree_->number == number) return *tree_;
    tree_.reset();  // before its question goes
    return tree_.emplace(number, trees_.about(number), options_, clock_, of_shard_);
  }

  OpenBoxes root_of(std::size_t tree) {
    OpenBoxes root;
    root.boxes.emplace(0, tree_at(tree).about.variety.outer);
    return root;
  }

  /// Counts all shards, not the current one alone.
  Options with_total_progress(Options options) {
    if (!options.progress) return options;
    options.progress = [this, tell = options.progress](const Verification&) {
      Verification total = result_;
      total.leaves += of_shard_.leaves;
      total.boxes += of_shard_.boxes;
      tell(total);
    };
    return options;
  }

  /// Stops at the first shard that is not proved, or if there are too many boxes: the shards after
  /// it do not matter any more.
  void prove_own_part() {
    for (std::size_t i = options_.part; i < listed_.size(); i += options_.parts) {
      ShardProof& proof = proofs_of_shards_[i];
      try {
        prove(listed_[i], proof);
        proof.is_proved = true;
      } catch (const Unfinished& why) {
        proof.reason = why.what();
      } catch (const std::runtime_error& why) {
        proof.is_rejected = true;
        proof.reason = why.what();
      }
      result_.leaves += of_shard_.leaves;
      result_.boxes += of_shard_.boxes;
      of_shard_ = {};
      if (!proof.is_proved || result_.boxes > options_.max_boxes) return;
    }
  }

  void prove(const ListedShard& listed, ShardProof& proof) {
    ShardFile file(format::shard_file(options_.path, listed.number), listed, trees_.sha256);
    try {
      std::size_t tree = trees_.is_piecewise ? file.read_piece(trees_.count) : 0;
      OpenBoxes open = file.read_open(tree_at(tree).about.variety.outer);
      proof.before = state_text(tree, open);
      detail::Sha256 digest;
      if (is_branch()) file.lines().digest_into(digest);
      while (read_tree(file.lines(), tree, open, proof)) open = root_of(++tree);
      if (proof.leaves != listed.leaves)
        throw Rejection("the index gives another number of leaves");
      proof.after = state_text(tree, open);
      proof.question = trees_.sha256;
      if (is_branch()) proof.lines = digest.text();
      proof.paved = of_shard_.paved;
    } catch (const Rejection& why) {
      throw Rejection("line " + std::to_string(file.lines().number()) + ": " + why.what());
    } catch (const Unfinished& why) {
      throw Unfinished("line " + std::to_string(file.lines().number()) + ": " + why.what());
    }
  }

  /// Reads the lines of one tree, up to the end of the shard or to the line `tree`; returns true if
  /// another tree follows.
  bool read_tree(Lines& lines, std::size_t number, OpenBoxes& open, ShardProof& proof) {
    Tree& tree = tree_at(number);
    TreeReader reader(lines, tree.about.question, open, &tree.proofs, clock_);
    const Shown shown = reader.read();
    proof.leaves += shown.leaves;
    proof.boxes += shown.boxes;
    proof.has_met_variety |= shown.has_met_variety;
    proof.has_met_point |= shown.has_met_point;
    // The determinants of two pieces may have different signs.
    if (!trees_.is_piecewise) proof.sign = shown.sign;
    if (trees_.is_piecewise && lines.text() == "tree") {
      reader.require_tiling();
      if (number + 1 == trees_.count) throw Rejection("there are more trees than pieces");
      return true;
    }
    reader.require_end_word();
    reader.require_end(proof.leaves);
    return false;
  }

  /// Puts the parts together, in their order.
  void join() {
    Shown shown;
    std::string expected = state_text(0, root_of(0));
    result_.leaves = result_.boxes = 0;
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      const ShardProof& proof = proofs_of_shards_[i];
      lines_.name_line(listed_[i].line);
      const std::string here = "shard " + std::to_string(listed_[i].number) + ": ";
      if (!proof.is_proved && proof.is_rejected) throw Rejection(here + proof.reason);
      if (!proof.is_proved) throw Unfinished(here + proof.reason);
      if (proof.question != trees_.sha256)
        throw Rejection(here + "it was proved for another question");
      if (proof.before != expected)
        throw Rejection(here + "it does not begin where the shard before it ends");
      expected = proof.after;
      add(proof, here, shown);
    }
    if (!expected.starts_with(begin_of_state(trees_.count - 1, 0)))
      throw Rejection("after the last shard there are boxes without a leaf" +
                      std::string(trees_.is_piecewise ? ", or pieces without a tree" : ""));
    lines_.name_line(0);
    require_poses(tree_at(trees_.count - 1).about.question, shown, result_);
    if (!is_branch()) return;
    tree_.reset();
    link_shards({lines_, trees_, listed_, proofs_of_shards_}, options_, clock_, result_);
  }

  /// Once a tree is there: all are about one closure, or none.
  [[nodiscard]] bool is_branch() const { return tree_ && tree_->about.question.closure; }

  void add(const ShardProof& proof, const std::string& here, Shown& shown) {
    result_.leaves += proof.leaves;
    result_.boxes += proof.boxes;
    for (std::size_t i = 0; i < proof.paved.size(); ++i) result_.paved[i] += proof.paved[i];
    if (result_.boxes > options_.max_boxes)
      throw Unfinished(here + "the shards up to this one need more than " +
                       std::to_string(options_.max_boxes) + " boxes");
    if (shown.sign * proof.sign < 0)
      throw Rejection(here +
                      "the determinant has opposite signs at two points of the variety, one of "
                      "them in it");
    if (shown.sign == 0) shown.sign = proof.sign;
    shown.has_met_variety |= proof.has_met_variety;
    shown.has_met_point |= proof.has_met_point;
  }

  Lines& lines_;
  const ShardedTrees& trees_;
  Verification of_shard_;  ///< counts of the current shard
  const Options options_;
  Verification& result_;
  WorkClock clock_;
  std::optional<Tree> tree_;
  std::vector<ListedShard> listed_;
  std::vector<ShardProof> proofs_of_shards_;
};

}  // namespace

void check_shards(Lines& lines, const ShardedTrees& trees, const Options& options,
                  Verification& result) {
  ShardsChecker(lines, trees, options, result).check();
}

}  // namespace regulus::verifier
