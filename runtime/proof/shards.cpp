// SPDX-License-Identifier: Apache-2.0
#include "runtime/proof/shards.hpp"

#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "runtime/files/atomic_file.hpp"
#include "runtime/files/sha256.hpp"
#include "runtime/files/temporary.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/proof/proof_tree.hpp"

namespace regulus {
namespace {

/// A box that waits.
struct Waiting {
  struct Ends {
    std::optional<double> lower, upper;  ///< nullopt: that of box 0
  };
  std::uint64_t searched;           ///< its number in the search
  std::uint64_t id;                 ///< its number in preorder
  std::map<unsigned, Ends> ranges;  ///< of the variables that were split
};

void put(std::string& text, const std::optional<double>& end) {
  char number[40];
  std::snprintf(number, sizeof number, "%a", end.value_or(0.0));
  text += ' ';
  text += end ? number : format::kEndOfRoot;
}

/// A file that is written in parts, with its length and hash.
class ShardOutput {
 public:
  explicit ShardOutput(const std::string& path) : file_(path) {}

  void put(std::string_view text) {
    part_ += text;
    size_ += text.size();
    if (part_.size() >= kPart) flush();
  }
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  /// Returns the SHA-256.
  [[nodiscard]] std::string close() {
    flush();
    file_.put_in_place_durably();
    return digest_.text();
  }

 private:
  static constexpr std::size_t kPart = std::size_t{1} << 20;

  void flush() {
    file_.write(part_);
    digest_.add(part_);
    part_.clear();
  }

  AtomicFile file_;
  Sha256 digest_;
  std::string part_;
  std::uint64_t size_ = 0;
};

class ShardCutter {
 public:
  ShardCutter(const std::string& certificate, std::string folder, std::uint64_t size)
      : folder_(std::move(folder)), size_(size) {
    read(certificate);
    waiting_.push_back({0, 0, {}});
  }

  /// Returns the index.
  [[nodiscard]] std::string write() {
    for (std::size_t shard = 1; !waiting_.empty(); ++shard) {
      if (shard > format::kMostShards)
        throw std::runtime_error("be cut into more than " + std::to_string(format::kMostShards) +
                                 " shards; use a larger --shard-size");
      write_shard(shard);
    }
    return index_ + "end " + std::to_string(leaves_) + '\n';
  }

 private:
  void read(const std::string& certificate);
  void write_shard(std::size_t shard);
  [[nodiscard]] std::string head(std::size_t shard) const;
  [[nodiscard]] std::string take_next();

  const std::string folder_;
  const std::uint64_t size_;
  std::string index_, question_;
  ProofTree tree_;
  std::vector<Waiting> waiting_;  ///< the next box is the last one
  std::uint64_t next_ = 1, leaves_ = 0;
};

void ShardCutter::read(const std::string& certificate) {
  std::ifstream file(certificate, std::ios::binary);
  Sha256 question;
  std::string line;
  std::getline(file, line);
  index_ = std::string(format::kIndexMagic) + '\n';
  for (bool more = true; more && std::getline(file, line); more = line != "proof") {
    index_ += line + '\n';
    question.add(line + '\n');
  }
  question_ = question.text();
  while (std::getline(file, line))
    if (!tree_.add(line)) return;
  throw std::runtime_error("be read again");
}

std::string ShardCutter::head(std::size_t shard) const {
  std::string text = std::string(format::kShardMagic) + "\nquestion " + question_ + "\nshard " +
                     std::to_string(shard) + "\nnext " + std::to_string(next_) + '\n';
  for (std::size_t i = waiting_.size(); i-- > 0;) {
    text += "open " + std::to_string(waiting_[i].id);
    for (const auto& [variable, ends] : waiting_[i].ranges) {
      text += ' ' + std::to_string(variable);
      put(text, ends.lower);
      put(text, ends.upper);
    }
    text += '\n';
  }
  return text + "proof\n";
}

/// Returns the line of the next box, whose halves wait then.
std::string ShardCutter::take_next() {
  Waiting box = std::move(waiting_.back());
  waiting_.pop_back();
  const ProofTree::Node& node = tree_.node(box.searched);
  const std::string id = std::to_string(box.id);
  if (node.lower == 0) {
    ++leaves_;
    return "l " + id + ' ' + tree_.rule(node) + '\n';
  }
  Waiting upper{node.lower + std::uint64_t{1}, next_ + 1, box.ranges};
  upper.ranges[node.variable].lower = node.at;
  waiting_.push_back(std::move(upper));
  box.ranges[node.variable].upper = node.at;
  waiting_.push_back({node.lower, next_, std::move(box.ranges)});
  next_ += 2;
  char at[40];
  std::snprintf(at, sizeof at, "%a", node.at);
  return "s " + id + ' ' + std::to_string(node.variable) + ' ' + at + '\n';
}

void ShardCutter::write_shard(std::size_t shard) {
  ShardOutput file(folder_ + '/' + std::to_string(shard));
  const std::uint64_t leaves_before = leaves_;
  file.put(head(shard));
  do {
    file.put(take_next());
  } while (!waiting_.empty() && file.size() < size_);
  const std::string leaves = std::to_string(leaves_ - leaves_before);
  file.put("end " + leaves + '\n');
  index_ += "shard " + std::to_string(shard) + ' ' + leaves + ' ' + file.close() + '\n';
}

}  // namespace

std::string write_shards(const std::string& certificate, const std::string& path,
                         std::uint64_t size) try {
  TemporaryFolder folder(path + format::kShardsEnding);
  std::string index = ShardCutter(certificate, folder.path(), size).write();
  folder.put_in_place_durably(path + format::kShardsEnding);
  return index;
} catch (const std::system_error& error) {
  throw std::runtime_error("be cut: " + path + format::kShardsEnding + " cannot " + error.what());
}

}  // namespace regulus
