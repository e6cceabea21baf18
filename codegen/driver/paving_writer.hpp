// SPDX-License-Identifier: GPL-3.0-or-later
// A paving as JSON lines: a header, one object for each box as soon as it is known, a summary.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "regulus/codegen/driver/interrupt.hpp"
#include "regulus/codegen/driver/paving_options.hpp"
#include "regulus/codegen/driver/undefined.hpp"
#include "regulus/search/paving.hpp"

namespace regulus::codegen {

class PavingWriter final : public Observer {
 public:
  /// Writes the header. `interrupt` is asked for an end when a line cannot be written.
  PavingWriter(std::ostream& out, const Preparation& preparation, const PavingOptions& options,
               InterruptGuard& interrupt);

  void on_leaf(const OpenBox& box, Rule rule, const Proof& proof) noexcept override;
  void on_open(const OpenBox& box) noexcept override;

  /// Writes the last line. Throws FileError if this or any line before it could not be written.
  void finish(const nlohmann::ordered_json& summary, const std::string& file);

 private:
  void write(const nlohmann::ordered_json& line);
  template <class Line>
  void write_safely(Line line) noexcept;
  [[nodiscard]] nlohmann::ordered_json leaf(const OpenBox& box, Rule rule,
                                            const Proof& proof) const;

  std::ostream& out_;
  const Preparation& preparation_;
  InterruptGuard& interrupt_;
  Definedness definedness_;
  const bool encloses_determinants_;
  bool failed_ = false;
};

}  // namespace regulus::codegen
