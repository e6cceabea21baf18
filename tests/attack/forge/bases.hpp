// SPDX-License-Identifier: GPL-3.0-or-later
// Genuine certificates: a model file and the command that proves something about it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace regulus::detail::attack {

struct Base {
  const char* name;
  const char* model;               ///< a file of models/, or a text
  std::vector<std::string> words;  ///< of the command; the model comes after the first
  const char* waypoints = "";      ///< the text of the file `way.csv` or `way.ngc`
  const char* waypoints_name = "";
  std::uint64_t shard_size = 0;  ///< in bytes, of a proof that is cut into shards
};

/// Each line of FORMAT.md and each kind of claim is in one of them.
[[nodiscard]] const std::vector<Base>& bases();

}  // namespace regulus::detail::attack
