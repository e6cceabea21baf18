// SPDX-License-Identifier: GPL-3.0-or-later
// The answer to a question: told once, whatever the question is.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "codegen/answer/facts.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/exit_code.hpp"

namespace regulus::detail {

/// What an answer says, for a program that knows no more.
enum class Word {
  kProved,   ///< NO SINGULARITY, a limit that is kept, a bracket as narrow as wanted
  kRefuted,  ///< SINGULARITY, a limit that is exceeded, no bound at all
  kOpen      ///< nothing
};

/// Returns the exit code of a command with this answer.
[[nodiscard]] constexpr ExitCode exit_code_of(Word word) noexcept {
  return word == Word::kProved    ? kNoSingularity
         : word == Word::kRefuted ? kSingularity
                                  : kPossibleProblem;
}

class Answer {
 public:
  Answer() = default;
  Answer(const Answer&) = delete;
  Answer& operator=(const Answer&) = delete;
  virtual ~Answer() = default;

  [[nodiscard]] virtual Word word() const = 0;
  /// Returns "NO SINGULARITY" or "BETWEEN 21.12 AND 21.29 N (leg 3)"; of a datasheet its table.
  [[nodiscard]] virtual std::string headline() const = 0;
  /// Tells the claim, the witness and the numbers. The lines that Services::on_line has told are not
  /// among them.
  virtual void tell(Facts& facts) const = 0;
  /// Returns the lines for people that precede the headline.
  [[nodiscard]] std::string text() const {
    return text_of_facts([this](Facts& facts) { tell(facts); });
  }
  /// Returns the lines about files that were written beside it, or could not be.
  [[nodiscard]] virtual std::string about_files() const { return ""; }
  /// Returns the report for programs.
  [[nodiscard]] nlohmann::ordered_json json() const {
    return report_of_facts([this](Facts& facts) { tell(facts); });
  }
  /// Returns why no file of a proof was written that was wanted; empty if one was, if none was wanted,
  /// and if the reason is among `lost`.
  [[nodiscard]] virtual std::string missing_proof() const { return ""; }
  /// Returns lines that people must see with any other output; usually empty.
  [[nodiscard]] virtual std::string warning() const { return ""; }

  /// Why files that were wanted are missing, as sentences. The answer holds without them.
  std::vector<std::string> lost;
  /// Runs what writes a file after the search. Returns false if it threw FileError.
  template <class Write>
  bool write_beside(const Write& write) {
    try {
      write();
      return true;
    } catch (const FileError& why) {
      lost.emplace_back(why.what());
      return false;
    }
  }

  /// The work that outlives the answer.
  struct Rest {
    bool is_at_work = false;  ///< a thread still works; only the end of the process ends it
    std::string note;         ///< a line for people, or empty
  };
  /// Waits for work that serves a later run, until it ends or `interrupted` becomes true. Call it
  /// when the answer is printed.
  [[nodiscard]] virtual Rest wait_for_rest(const std::atomic<bool>& /*interrupted*/) { return {}; }
};

}  // namespace regulus::detail
