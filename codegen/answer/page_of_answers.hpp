// SPDX-License-Identifier: GPL-3.0-or-later
// The page of one answer or of several about the same motion.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "codegen/answer/answer.hpp"
#include "codegen/answer/asked.hpp"
#include "codegen/answer/page/page_data.hpp"
#include "codegen/answer/page/page_template.hpp"
#include "codegen/answer/services.hpp"

namespace regulus::detail {

/// A proof or a paving beyond this size stays out of a page.
inline constexpr std::size_t kLongestProof = std::size_t{4} << 20;

/// What a page shows of one answer.
struct ShownAnswer {
  std::string kind;               ///< of Asked: "check", "paving", "margin", "bound", "load", …
  std::string headline;           ///< "NO SINGULARITY"
  std::string text;               ///< the report for people
  nlohmann::ordered_json report;  ///< the report for programs
  std::string certificate{};      ///< of a check or of solutions: the file of the proof
  std::string no_certificate{};   ///< why
  std::string table{};            ///< of solutions: the file of their places; empty: there is none
  nlohmann::ordered_json paving{};  ///< of a paving: its header, its tree, or its stretches
};

/// Returns the word of ShownAnswer::kind.
[[nodiscard]] const char* kind_of(const Asked& asked);

/// Says what the answers of a page are about.
enum class PageSubject {
  kMotion,
  kPlaces  ///< of solutions: it has no ranges to draw
};

/// Returns the subject of a question, and of a word of kind_of().
[[nodiscard]] PageSubject subject_of(const Asked& asked);
[[nodiscard]] PageSubject subject_of(std::string_view kind);

class PageOfAnswers {
 public:
  /// Reads the model. `typed`: the command that makes the page, for its reader.
  ///
  /// Throws    InputError and FileError for the model.
  PageOfAnswers(PageTemplate page, const ModelOptions& model, const std::string& typed,
                PageSubject subject = PageSubject::kMotion);
  ~PageOfAnswers();

  /// The first answer gives the page its headline; a check or a paving that follows, a bound or a
  /// margin is shown beside it.
  ///
  /// Throws    FileError if the certificate cannot be read; UsageError for a paving that is too long.
  void add(ShownAnswer answer);

  /// True of a [closure].
  [[nodiscard]] bool is_about_branch() const;

  /// Writes the page, without the folders of files. Returns its size in bytes. Throws FileError.
  std::size_t write(const std::string& file) const;

 private:
  void take_proof(const std::string& file);

  PageTemplate template_;
  LocalPaths paths_;
  std::unique_ptr<const Request> request_;  ///< null of places
  PageData data_;
};

/// Asks, and shows the answer: a check with its proof, a paving with its boxes, solutions with the lines
/// that are told of them.
[[nodiscard]] std::unique_ptr<Answer> ask_for_page(const Asked& asked, const Services& services,
                                                   PageOfAnswers& page);

}  // namespace regulus::detail
