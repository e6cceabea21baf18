// SPDX-License-Identifier: Apache-2.0
// Writes a certificate (FORMAT.md) while the search runs.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "runtime/problem/observer.hpp"

namespace regulus {

/// The texts of a certificate about the question.
struct CertifiedQuestion {
  std::string text;            ///< FORMAT.md, "The question": lines from `model` to `constraint`
  std::string no_singularity;  ///< the claim, for either verdict
  std::string singularity;
};

/// Returns the word of FORMAT.md for a rule. For a rule without one, no certificate is valid.
[[nodiscard]] const char* certificate_word(Rule rule) noexcept;

/// Writes splits and leaves to a file beside the requested one, as they come; finish() renames it.
/// Otherwise no file remains, unless the search is to continue later.
class CertificateWriter final : public Observer {
 public:
  /// Throws std::runtime_error if no file can be made there.
  CertificateWriter(std::string path, CertifiedQuestion question);

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
  /// An unfinished proof that is not continued is renamed to partial_file(path).old. Throws
  /// std::runtime_error also if the file is shorter than that, or of another user.
  CertificateWriter(std::string path, CertifiedQuestion question, Partial partial);
  /// A proof of NO SINGULARITY that has more bytes is cut into shards of about this size.
  void set_shard_size(std::uint64_t bytes) noexcept { shard_size_ = bytes; }
  ~CertificateWriter() override;

  void on_start(const Problem& problem, const Settings& settings) noexcept override;
  void on_split(const OpenBox& box, const Split& split) noexcept override;
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;

  /// Throws std::runtime_error if something could not be written; the file at `path` is then
  /// unchanged.
  ///
  /// Ensures   false for POSSIBLE PROBLEM, which claims nothing: no file is written.
  [[nodiscard]] bool finish(const Result& result);
  /// The two steps of finish(): the complete file has its temporary name until put_in_place().
  [[nodiscard]] bool complete(const Result& result);
  void put_in_place();

  /// Makes the text so far safe on the disk and returns its length; nullopt if that fails.
  [[nodiscard]] std::optional<std::uint64_t> sync() noexcept;
  /// The search will not be continued: the destructor removes the file.
  void discard() noexcept { stays_ = false; }

  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  void open(int descriptor, const char* what);
  void continue_at(std::uint64_t bytes);
  void put_index_in_place();
  void write_head(const char* verdict, const std::string& claim);
  void write_witness(const Result& result);
  void write_point(const WitnessPoint& point, const char* sign);
  void put(const std::string& text) noexcept;
  void note_written(int count) noexcept;
  void check(bool done, const char* what) const;

  std::string path_, temporary_;
  CertifiedQuestion question_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t leaves_ = 0;
  std::uint64_t shard_size_ = 0;  ///< 0: the proof stays in one file
  bool is_safe_ = false;          ///< of a complete file: it proves NO SINGULARITY
  bool in_place_ = false;
  bool stays_ = false;      ///< after the destructor
  bool continues_ = false;  ///< a file that already has its head
  bool failed_ = false;     ///< a part of the file is missing
};

}  // namespace regulus
