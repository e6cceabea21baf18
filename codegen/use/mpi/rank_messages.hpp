// SPDX-License-Identifier: GPL-3.0-or-later
// The messages between rank 0 and the others, around those of a search.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "runtime/cluster/bytes.hpp"

namespace regulus::detail {

/// A message that belongs to one of several searches, and to one thread of a rank.
struct ForSearch {
  std::uint32_t search = 0;
  std::uint32_t slot = 0;
  std::string_view bytes;
};

[[nodiscard]] inline std::string write_for_search(std::uint32_t search, std::uint32_t slot,
                                                  std::string_view bytes) {
  cluster::ByteWriter writer;
  writer.put(search);
  writer.put(slot);
  writer.append(bytes);
  return writer.take();
}

/// The result refers to the text.
[[nodiscard]] inline ForSearch read_for_search(std::string_view text) {
  cluster::ByteReader reader(text);
  ForSearch message;
  message.search = reader.take<std::uint32_t>();
  message.slot = reader.take<std::uint32_t>();
  message.bytes = reader.rest();
  return message;
}

/// A rank that is ready names the number of its threads.
[[nodiscard]] inline std::string write_ready(unsigned threads) {
  cluster::ByteWriter writer;
  writer.put(threads);
  return writer.take();
}

[[nodiscard]] inline unsigned read_ready(std::string_view text) {
  return cluster::ByteReader(text).take<unsigned>();
}

}  // namespace regulus::detail
