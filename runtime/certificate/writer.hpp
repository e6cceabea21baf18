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

/// What a certificate says about the question, as text.
struct CertifiedQuestion {
  std::string text;            ///< FORMAT.md, "The question": lines from `model` to `constraint`
  std::string no_singularity;  ///< the claim, for either verdict
  std::string singularity;
};

/// Splits and leaves go to a file next to the one that is wanted, as they come; finish() puts it in
/// its place. Nothing is left behind otherwise, unless the search is to go on later.
class CertificateWriter final : public Observer {
 public:
  /// Throws std::runtime_error when no file can be made there.
  CertificateWriter(std::string path, CertifiedQuestion question);

  /// For a search that may be continued: what is written goes to partial_file(path) and stays there
  /// until finish() or discard().
  [[nodiscard]] static std::string partial_file(const std::string& path) {
    return path + ".partial";
  }
  struct Partial {
    /// Go on behind this many bytes of it, with so many leaves; absent: from the beginning.
    std::optional<std::uint64_t> length;
    std::uint64_t leaves = 0;
  };
  /// Throws std::runtime_error also when there is less than that to go on from.
  CertificateWriter(std::string path, CertifiedQuestion question, Partial partial);
  ~CertificateWriter() override;

  void on_start(const Problem& problem, const Settings& settings) noexcept override;
  void on_split(const OpenBox& box, const Split& split) noexcept override;
  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;

  /// Throws std::runtime_error when something could not be written; the file at `path` is then as
  /// it was before.
  ///
  /// Ensures   false for POSSIBLE PROBLEM, which claims nothing: no file is written.
  [[nodiscard]] bool finish(const Result& result);

  /// Makes what was written so far safe on the disk and says how long it is; nullopt: it cannot.
  [[nodiscard]] std::optional<std::uint64_t> sync() noexcept;
  /// Nothing is to be continued: the file goes with this object.
  void discard() noexcept { stays_ = false; }

  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

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
  bool in_place_ = false;
  bool stays_ = false;      ///< when this object is gone
  bool continues_ = false;  ///< a file that has its head
  bool failed_ = false;     ///< something is missing in the file
};

}  // namespace regulus
