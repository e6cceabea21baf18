// SPDX-License-Identifier: GPL-3.0-or-later
// What the option --certificate gave: a file, or the reason why there is none.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "codegen/answer/facts.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/held_files.hpp"
#include "runtime/proof/proof_file.hpp"

namespace regulus::detail {

inline constexpr const char* kNothingClaimed =
    "POSSIBLE PROBLEM claims nothing that could be proved";

// Why an end of a bracket has no proof.
inline constexpr const char* kNoSafeProof = "no safe value was found";
inline constexpr const char* kNoSingularProof = "no singularity was found";

/// Reports a failure of a ProofFile as a FileError.
template <class Action>
auto with_file_errors(const Action& action) {
  try {
    return action();
  } catch (const std::runtime_error& error) {
    throw FileError(error.what());
  }
}

/// How a complete proof is put in its place.
struct ProofPlacing {
  HeldFiles* held = nullptr;     ///< it waits there for the end of its run; null: it does not wait
  std::uint64_t shard_size = 0;  ///< as ProofFile::set_shard_size
};

/// Throws FileError.
void put_in_place(std::shared_ptr<ProofFile> proof, const ProofPlacing& placing);

/// Writes the proof of a verdict that has a witness, and puts it in its place. Throws FileError.
void write_witness(const std::string& path, const std::string& head, const std::string& witness,
                   const ProofPlacing& placing);

/// The proof of a verdict.
class ProofStatus {
 public:
  /// An empty `path` means that none is wanted.
  explicit ProofStatus(std::string path = "") : path_(std::move(path)) {}

  [[nodiscard]] bool is_wanted() const noexcept { return !path_.empty(); }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] bool is_written() const noexcept { return is_written_; }
  /// Returns the reason why there is none; empty if there is one, or none is wanted.
  [[nodiscard]] const std::string& obstacle() const noexcept { return obstacle_; }

  /// `note`: why the verifier may not finish; empty if no reason is known.
  void set_written(std::string note = "");
  void set_obstacle(std::string obstacle) { obstacle_ = std::move(obstacle); }
  /// Runs what writes the proof; a FileError becomes the obstacle.
  template <class Write>
  void attempt(const Write& write) {
    try {
      write();
    } catch (const FileError& why) {
      is_lost_ = true;
      is_written_ = false;
      obstacle_ = why.what();
    }
  }
  /// True if a file, and not the verdict, is the obstacle.
  [[nodiscard]] bool is_lost() const noexcept { return is_lost_; }

  /// Returns lines of the report; empty if no certificate was wanted.
  [[nodiscard]] std::string line() const;
  /// Tells programs `certificate`, the file or null, `certificate_obstacle`, the reason why there is
  /// none, and `certificate_note`; the same in the one entry of `proof`. Nothing if none was wanted.
  void tell(Facts& facts) const;

 private:
  std::string path_, obstacle_, note_;
  bool is_written_ = false, is_lost_ = false;
};

/// The proof of one end of a bracket. `words` say what it proves; without a file, why there is none.
struct EndProof {
  std::string file;
  std::string words;
  std::string lost{};  ///< why the last proof of this end could not be written; empty: it was
};

/// The proofs of both ends of a bracket: FILE.safe and FILE.singular.
class EndProofs {
 public:
  EndProofs() = default;
  /// An empty `path` means that none are wanted. `no_safe`, `no_singular`: why an end has no proof, as
  /// long as none is written. Throws FileError if a file cannot be created there: a search may take
  /// long.
  EndProofs(std::string path, const ProofPlacing& placing, std::string no_safe,
            std::string no_singular, const char* safe_name = "safe",
            const char* singular_name = "singular");

  /// Returns the files of `path`; none if it is empty.
  [[nodiscard]] static std::vector<OutputFile> files(const std::string& path);

  [[nodiscard]] bool are_wanted() const noexcept { return !path_.empty(); }
  [[nodiscard]] const EndProof& safe() const noexcept { return safe_; }
  [[nodiscard]] const EndProof& singular() const noexcept { return singular_; }
  [[nodiscard]] std::string safe_file() const;
  [[nodiscard]] std::string singular_file() const;

  [[nodiscard]] const ProofPlacing& placing() const noexcept { return placing_; }

  /// The file of an end has been written.
  void set_safe(std::string words) { safe_ = {safe_file(), std::move(words)}; }
  void set_singular(std::string words) { singular_ = {singular_file(), std::move(words)}; }
  /// Completes the file of an end and puts it in its place, or notes why this failed. `complete` may
  /// throw FileError.
  void write_safe(const std::function<std::shared_ptr<ProofFile>()>& complete, std::string words);
  void write_singular(const std::string& head, const std::string& witness, std::string words);
  /// Notes what became of the proof of a value that was decided: `value` is its text.
  void note(bool is_safe, const ProofStatus& written, const std::string& value);
  /// A proof of an end could not be written.
  void lose_safe(std::string why) { lose(safe_, std::move(why)); }
  void lose_singular(std::string why) { lose(singular_, std::move(why)); }
  /// Notes the files that are not in their places, after the run has ended with this failure.
  void note_missing_files(const std::string& why);
  /// Takes the file of an end, or why there is none, from an earlier run for the same files.
  void keep_safe(const EndProofs& earlier) { safe_ = earlier.safe_; }
  void keep_singular(const EndProofs& earlier) { singular_ = earlier.singular_; }
  /// Returns why proofs could not be written, as sentences.
  [[nodiscard]] std::vector<std::string> lost() const;

  /// An end has no proof; one that was written before stays.
  void set_no_safe(std::string why);
  void set_no_singular(std::string why);

  /// Returns a line of the report for each end; empty if none was wanted.
  [[nodiscard]] std::string lines() const;
  /// Tells programs `certificates`, with the file of each end or null, and `certificate_obstacles`,
  /// with the reason for each end without a file. Nothing if none was wanted.
  void tell_files(Facts& facts) const;
  /// Tells the same, and `proof`.
  void tell(Facts& facts) const;
  /// Adds an entry for each end to the list `proof` of a report.
  void add_to(nlohmann::ordered_json& proofs, const std::string& component = "") const;

 private:
  static void lose(EndProof& end, std::string why);

  std::string path_;
  ProofPlacing placing_;
  EndProof safe_, singular_;
  const char* safe_name_ = "safe";  ///< for people
  const char* singular_name_ = "singular";
};

}  // namespace regulus::detail
