// SPDX-License-Identifier: GPL-3.0-or-later
// Agreement of all ranks before a search: they must have the same build, words and model.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/use/mpi/communicator.hpp"
#include "runtime/kernel/isa.hpp"

namespace regulus::detail {

/// The first message of rank 0 to the others: its own words and the text of the model, whatever
/// they were started with; or that there is nothing to do.
struct Start {
  std::optional<int> exit_code;
  std::vector<std::string> words;  ///< of the command line
  std::string model;
  bool shares_places = false;  ///< of solve: each rank solves some of many places
};
[[nodiscard]] std::string write_start(const Start& start);
[[nodiscard]] Start read_start_text(std::string_view text);

struct RankIdentity {
  std::string host;
  std::string build;
  Isa best_isa = Isa::kPortable;
};

struct Agreement {
  Isa isa = Isa::kPortable;  ///< the best that all ranks have
  std::string refusal;       ///< the rank that cannot take part, and why; empty: all can
};

/// All ranks call it together. Compares the builds of the ranks, and finds the instruction set;
/// `wanted` is required from all. On rank 0 it fills in `ranks`.
[[nodiscard]] Agreement agree(Communicator& communicator, std::optional<Isa> wanted,
                              std::vector<RankIdentity>& ranks);

/// The decision of rank 0.
[[nodiscard]] Agreement compare(const std::vector<RankIdentity>& ranks, std::optional<Isa> wanted);

}  // namespace regulus::detail
