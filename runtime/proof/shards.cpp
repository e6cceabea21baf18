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

namespace regulus::detail {
namespace {

constexpr const char* kBeginsTree = "tree";

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

void require_few(std::size_t shards) {
  if (shards > format::kMostShards)
    throw std::runtime_error("be cut into more than " + std::to_string(format::kMostShards) +
                             " shards; use a larger --shard-size");
}

class ShardCutter {
 public:
  ShardCutter(const std::string& certificate, std::string folder, std::uint64_t size)
      : folder_(std::move(folder)),
        size_(size),
        file_(certificate, std::ios::binary),
        tubes_(certificate, std::ios::binary) {
    read_head();
    read_tree();
  }

  /// Returns the index.
  [[nodiscard]] std::string write() {
    for (std::size_t shard = 1; !is_done(); ++shard) {
      require_few(shard);
      write_shard(shard);
    }
    return index_ + "end " + std::to_string(leaves_) + '\n';
  }

 private:
  void read_head();
  void read_tree();
  [[nodiscard]] bool read_line(std::string& line);
  [[nodiscard]] std::string rule_of(const ProofTree::Node& leaf);
  [[nodiscard]] bool is_done() const { return waiting_.empty() && !has_more_trees_; }
  void write_shard(std::size_t shard);
  [[nodiscard]] std::string head(std::size_t shard) const;
  [[nodiscard]] std::string take_next();

  const std::string folder_;
  const std::uint64_t size_;
  std::ifstream file_, tubes_;
  std::uint64_t offset_ = 0;  ///< of the next line of file_, in bytes
  std::string index_, question_;
  bool has_more_trees_ = false;  ///< after the current one
  std::size_t piece_ = 0;        ///< whose tree is the current one; 0: the motion has no pieces
  ProofTree tree_;
  std::vector<Waiting> waiting_;  ///< the next box is the last one
  std::uint64_t next_ = 1, leaves_ = 0;
};

void ShardCutter::read_head() {
  Sha256 question;
  std::string line;
  static_cast<void>(read_line(line));
  index_ = std::string(format::kIndexMagic) + '\n';
  for (bool more = true; more && read_line(line); more = line != "proof") {
    index_ += line + '\n';
    question.add(line + '\n');
  }
  question_ = question.text();
  if (file_.peek() == format::kValue[0] && read_line(line)) index_ += line + '\n';
  if (file_.peek() == kBeginsTree[0] && read_line(line)) piece_ = 1;
}

bool ShardCutter::read_line(std::string& line) {
  if (!std::getline(file_, line)) return false;
  offset_ += line.size() + 1;
  return true;
}

/// Reads the next tree, whose box 0 waits then.
void ShardCutter::read_tree() {
  tree_ = {};
  next_ = 1;
  waiting_.push_back({0, 0, {}});
  std::string line;
  for (std::uint64_t offset = offset_; read_line(line); offset = offset_) {
    has_more_trees_ = line == kBeginsTree;
    if (has_more_trees_ || !tree_.add(line, offset)) return;
  }
  throw std::runtime_error("be read again");
}

std::string ShardCutter::head(std::size_t shard) const {
  std::string text = std::string(format::kShardMagic) + "\nquestion " + question_ + "\nshard " +
                     std::to_string(shard) + '\n';
  if (piece_ > 0) text += "piece " + std::to_string(piece_) + '\n';
  text += "next " + std::to_string(next_) + '\n';
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

/// Returns what the line of a leaf says after the number of its box.
std::string ShardCutter::rule_of(const ProofTree::Node& leaf) {
  if (const std::string* rule = tree_.rule(leaf)) return *rule;
  std::string line;
  tubes_.seekg(static_cast<std::streamoff>(leaf.offset));
  if (!std::getline(tubes_, line)) throw std::runtime_error("be read again");
  return line.substr(line.find(' ', 2) + 1);
}

/// Returns the line of the next box, whose halves wait then; after the last box of a tree the line
/// that begins the next one.
std::string ShardCutter::take_next() {
  if (waiting_.empty()) {
    read_tree();
    ++piece_;
    return kBeginsTree + std::string("\n");
  }
  Waiting box = std::move(waiting_.back());
  waiting_.pop_back();
  const ProofTree::Node& node = tree_.node(box.searched);
  const std::string id = std::to_string(box.id);
  if (node.lower == 0) {
    ++leaves_;
    return "l " + id + ' ' + rule_of(node) + '\n';
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
  } while (!is_done() && file.size() < size_);
  const std::string leaves = std::to_string(leaves_ - leaves_before);
  file.put("end " + leaves + '\n');
  index_ += "shard " + std::to_string(shard) + ' ' + leaves + ' ' + file.close() + '\n';
}

/// Returns the index.
std::string cut_places(const std::string& certificate, const std::string& folder,
                       std::uint64_t size) {
  std::ifstream file(certificate, std::ios::binary);
  std::string line, index = std::string(format::kPlacesIndexMagic) + '\n';
  std::getline(file, line);
  bool more = bool(std::getline(file, line));
  for (std::size_t shard = 1; more && line.starts_with(format::kPlace); ++shard) {
    require_few(shard);
    ShardOutput output(folder + '/' + std::to_string(shard));
    output.put(std::string(format::kPlacesShardMagic) + "\nshard " + std::to_string(shard) + '\n');
    std::size_t places = 0;
    do {
      ++places;
      do output.put(line + '\n');
      while ((more = bool(std::getline(file, line))) && !line.starts_with(format::kPlace) &&
             !line.starts_with(format::kPlaces));
    } while (more && line.starts_with(format::kPlace) && output.size() < size);
    output.put(format::kPlaces + std::to_string(places) + '\n');
    index += "shard " + std::to_string(shard) + ' ' + std::to_string(places) + ' ' +
             output.close() + '\n';
  }
  if (!more) throw std::runtime_error("be read again");
  return index + line + '\n';
}

template <class Cut>
std::string in_folder(const std::string& path, const Cut& cut) try {
  TemporaryFolder folder(path + format::kShardsEnding);
  std::string index = cut(folder.path());
  folder.put_in_place_durably(path + format::kShardsEnding);
  return index;
} catch (const std::system_error& error) {
  throw std::runtime_error("be cut: " + path + format::kShardsEnding + " cannot " + error.what());
}

}  // namespace

std::string write_shards(const std::string& certificate, const std::string& path,
                         std::uint64_t size) {
  return in_folder(path, [&](const std::string& folder) {
    return ShardCutter(certificate, folder, size).write();
  });
}

std::string write_shards_of_places(const std::string& certificate, const std::string& path,
                                   std::uint64_t size) {
  return in_folder(
      path, [&](const std::string& folder) { return cut_places(certificate, folder, size); });
}

}  // namespace regulus::detail
