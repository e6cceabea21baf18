// SPDX-License-Identifier: Apache-2.0
// The only writer of certificates (FORMAT.md). A claim gives it its head and its words.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/problem/observer.hpp"

namespace regulus {

/// A file that appears under its name only when it is complete. Until then it is beside the
/// requested one; it is removed unless it is finished, or the search is to continue later.
class ProofFile {
 public:
  /// Throws std::runtime_error if no file can be made there.
  explicit ProofFile(std::string path);

  /// For a search that may be continued: writes to partial_file(path), which stays there until
  /// finish() or discard().
  [[nodiscard]] static std::string partial_file(const std::string& path) {
    return path + ".partial";
  }
  struct Partial {
    /// Continue after this many bytes of it, with so many leaves; absent: from the beginning.
    std::optional<std::uint64_t> length;
    std::uint64_t leaves = 0;
  };
  /// Throws std::runtime_error also if the file is shorter than that.
  ProofFile(std::string path, Partial partial);
  ~ProofFile();
  ProofFile(ProofFile&&) = default;
  ProofFile(const ProofFile&) = delete;
  ProofFile& operator=(const ProofFile&) = delete;
  ProofFile& operator=(ProofFile&&) = delete;

  /// A proof with trees that has more bytes is cut into shards of about this size; 0: it is not.
  void set_shard_size(std::uint64_t bytes) noexcept { shard_size_ = bytes; }

  // A failure to write is noted; finish() and sync() report it.

  /// Writes the head: a certificate up to its line `proof`. A file that is continued has it.
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

  /// Makes the text so far safe on the disk and returns its length; nullopt if that fails.
  [[nodiscard]] std::optional<std::uint64_t> sync() noexcept;
  /// The search will not be continued: the destructor removes the file.
  void discard() noexcept { stays_ = false; }

  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  void put(std::string_view text) noexcept;
  void note_written(int count) noexcept;
  void check(bool done, const char* what) const;
  void open(int descriptor, const char* what);
  void continue_at(std::uint64_t bytes);
  void make_safe();
  void put_index_in_place();
  [[nodiscard]] bool must_be_cut() const;

  std::string path_, temporary_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t leaves_ = 0;
  std::uint64_t shard_size_ = 0;
  bool has_trees_ = true;  ///< and no witness
  bool in_place_ = false;
  bool stays_ = false;      ///< after the destructor
  bool continues_ = false;  ///< a file that already has its head
  bool failed_ = false;     ///< a part of the file is missing
};

}  // namespace regulus
