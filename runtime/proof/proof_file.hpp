// SPDX-License-Identifier: Apache-2.0
// The only writer of certificates (FORMAT.md). A claim gives it its head and its words.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "runtime/problem/observer.hpp"

namespace regulus {

/// A file that appears under its name only when it is complete. Until then it is beside the
/// requested one; it is removed unless it is finished.
class ProofFile {
 public:
  /// Throws std::runtime_error if no file can be made there.
  explicit ProofFile(std::string path);

  ~ProofFile();
  ProofFile(ProofFile&&) = default;
  ProofFile(const ProofFile&) = delete;
  ProofFile& operator=(const ProofFile&) = delete;
  ProofFile& operator=(ProofFile&&) = delete;

  /// A proof with trees, or about places of a table, that has more bytes is cut into shards of about
  /// this size; 0: it is not.
  void set_shard_size(std::uint64_t bytes) noexcept { shard_size_ = bytes; }

  // A failure to write is noted; finish() reports it.

  /// Writes the head: a certificate up to its line `proof`.
  void begin(std::string_view head) noexcept;
  /// Writes the line that begins the tree of a piece.
  void begin_tree() noexcept;
  void split(const Split& split) noexcept;
  /// `word`: of FORMAT.md, for the rule of the leaf.
  void leaf(BoxId box, const char* word) noexcept;

  // These throw std::runtime_error if something could not be written; the file at `path` is then
  // unchanged.

  /// Ends the tree, or the last of the trees. The proof is complete, and waits for put_in_place().
  void complete();
  /// Writes another head in place of all that was written, and the lines of a witness. The same.
  void complete_with(std::string_view head, std::string_view witness);
  void put_in_place();
  void finish() { complete(), put_in_place(); }
  void finish_with(std::string_view head, std::string_view witness) {
    complete_with(head, witness), put_in_place();
  }

  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  void put(std::string_view text) noexcept;
  void note_written(int count) noexcept;
  void check(bool done, const char* what) const;
  void open(int descriptor);
  void make_safe();
  void put_index_in_place();
  [[nodiscard]] bool must_be_cut() const;

  std::string path_, temporary_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t leaves_ = 0;
  std::uint64_t shard_size_ = 0;
  bool has_trees_ = true;  ///< and no witness
  bool has_places_ = false;
  bool in_place_ = false;
  bool failed_ = false;  ///< a part of the file is missing
};

}  // namespace regulus
