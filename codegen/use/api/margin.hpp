// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus margin` for a program: the largest tolerance, threshold or size that is safe, or at which
// a force, an error or a speed keeps a limit.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "codegen/question/engine/options.hpp"
#include "codegen/question/quantity/quantity.hpp"
#include "codegen/use/api/question.hpp"

namespace regulus {

/// One of `tolerance`, `alpha`, `scale`, `parameter` and `tube` is a range "LO:HI", or "LO:" if the upper end
/// must be found; the others are empty. With a `quantity` and a `limit` the bracket is that of the
/// limit, which has no `alpha`.
struct MarginOptions {
  SearchOptions search = for_a_minute();
  std::string tolerance;  ///< "base,platform=0:0.2"
  std::string alpha;
  std::string scale;             ///< of the ranges of a box variety about their middles
  std::string parameter;         ///< "p=0:10": p is in [its declared low end, v]
  std::string gap = "0.01";      ///< the bracket is closed when (b - a)/b is at most this
  QuantityOptions quantity{};    ///< what must keep `limit`; empty: no singularity
  std::string limit{};           ///< every value is below it (a least value: above); empty: none
  std::string certificate{};     ///< FILE of the proofs FILE.safe and FILE.singular; empty: none
  std::uint64_t shard_size = 0;  ///< of each proof, as for check()
  std::string tube{};            ///< "x,y=0:0.1": control errors; "0:0.1": of all pose parameters

  [[nodiscard]] static SearchOptions for_a_minute() {
    SearchOptions options;
    options.time_limit = 60;
    return options;
  }
};

/// The proof of one end of a bracket.
struct CertifiedEnd {
  std::string component;       ///< "leg 3"; empty if the quantity has only one
  bool is_safe = true;         ///< of the values that are safe; otherwise of the witness
  std::string certificate;     ///< its file; empty: none
  std::string no_certificate;  ///< why there is none
};

struct MarginFinding {
  /// The exact values of the ends, as `regulus check` takes them. At `safe` and below there is no
  /// singularity, or the limit is kept; there is a witness of a singularity at `singular`, or of a
  /// value beyond the limit at `exceeded`.
  std::optional<std::string> safe, singular, exceeded;
  bool closed = false;  ///< as narrow as requested, or the whole range is safe
  std::string bracket;  ///< "SAFE UP TO 0.119 cm, NOT AT 0.134 cm", "WITHIN UP TO …, EXCEEDED AT …"
  std::string report;                      ///< the lines that precede the bracket on a terminal
  std::string json;                        ///< the report that --json prints
  std::vector<CertifiedEnd> certificates;  ///< two for each component, if they were wanted
};

/// Threads and errors as check().
[[nodiscard]] MarginFinding margin(const Question& question, const MarginOptions& options,
                                   const std::atomic<bool>* interrupt = nullptr);

}  // namespace regulus
