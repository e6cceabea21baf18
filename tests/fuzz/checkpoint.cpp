// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes are a checkpoint of the question or a CheckpointError. They get a valid checksum, since
// otherwise nothing would pass it.
#include "runtime/checkpoint/checkpoint.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace regulus;
  const CheckpointedQuestion question{std::string(64, 'a'), 2, {{0, 1}, {-1, 1}, {-0.5, 0.5}}};
  std::string text(reinterpret_cast<const char*>(data), size);
  text += end_of_checkpoint(text);
  try {
    const Checkpoint checkpoint = read_checkpoint(text, question);
    for (const OpenBox& box : checkpoint.open())
      for (std::size_t k = 0; k < 3; ++k)
        if (!certain_subset(box.box[k], question.ranges[k])) std::abort();
  } catch (const CheckpointError&) {
  }
  return 0;
}
