// SPDX-License-Identifier: GPL-3.0-or-later
// The options of `regulus bound` and `regulus datasheet`.
#pragma once

#include <string>

#include "codegen/answer/report/output_options.hpp"
#include "codegen/model/request.hpp"
#include "codegen/question/engine/options.hpp"
#include "codegen/question/quantity/quantity.hpp"

namespace CLI {
class App;
}

namespace regulus::detail {

struct BoundCommand {
  ModelOptions model;
  QuantityOptions quantity;
  SearchOptions search;
  OutputOptions output;
  std::string limit;  ///< empty: find the bracket
  std::string gap = "0.01";
  std::string certificate;       ///< files, without their endings; empty: none
  std::uint64_t shard_size = 0;  ///< of their shards, in bytes; 0: each is one file
  std::string checkpoint;        ///< file; empty: none
};

/// With two words, MODEL and QUANTITY, the motion is the only one of the model.
[[nodiscard]] BoundCommand with_quantity(BoundCommand command);

struct DatasheetCommand {
  ModelOptions model;
  SearchOptions search;
  OutputOptions output;
  std::string gap = "0.01";
  bool markdown = false;
  std::string certificate;       ///< files, without their endings; empty: none
  std::uint64_t shard_size = 0;  ///< of their shards, in bytes; 0: each is one file
  std::string checkpoint;        ///< file; empty: none
};

/// Adds the options that say which components of a quantity are meant.
void add_quantity_options(CLI::App& app, QuantityOptions& options);

/// Adds QUANTITY and the options about it.
void add_bound_options(CLI::App& app, BoundCommand& command);

}  // namespace regulus::detail
