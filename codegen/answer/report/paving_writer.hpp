// SPDX-License-Identifier: GPL-3.0-or-later
// A paving as JSON lines: a header, one object for each box as soon as it is known, a summary.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "codegen/answer/report/paving_options.hpp"
#include "codegen/question/analysis/undefined.hpp"
#include "runtime/search/leaf_claims.hpp"

namespace regulus::detail {

class PavingWriter final : public Observer {
 public:
  /// Writes the header. `ask_for_end` is called if a line cannot be written.
  PavingWriter(std::ostream& out, const PreparedSearch& preparation, const PavingOptions& options,
               std::function<void()> ask_for_end);

  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;
  void on_open(const OpenBox& box) noexcept override;

  /// Writes the last line. Throws FileError if a line is missing for another reason than that which
  /// the stream has.
  void finish(const nlohmann::ordered_json& summary, const std::string& file);

 private:
  void write(const nlohmann::ordered_json& line);
  template <class Line>
  void write_safely(Line line) noexcept;
  [[nodiscard]] nlohmann::ordered_json leaf(const OpenBox& box, Rule rule, const Proof& proof);

  std::ostream& out_;
  const PreparedSearch& preparation_;
  std::function<void()> ask_for_end_;
  LeafClaims claims_;
  Definedness definedness_;
  const bool encloses_determinants_;
  bool failed_ = false;
};

}  // namespace regulus::detail
