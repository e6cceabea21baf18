// SPDX-License-Identifier: Apache-2.0
#include "runtime/files/sha256.hpp"

#include <cstddef>
#include <cstdint>

#include "runtime/files/sha256_blocks.hpp"

namespace regulus::detail {
namespace {

using sha256_blocks::kBlockBytes;

/// The last, incomplete block, a 1 bit, zeros, and the length in bits: one block or two.
std::string padded_tail(std::string_view tail, std::uint64_t total_bytes) {
  std::string padded(tail);
  padded += '\x80';
  while (padded.size() % kBlockBytes != kBlockBytes - 8) padded += '\0';
  for (int shift = 56; shift >= 0; shift -= 8)
    padded += static_cast<char>(total_bytes * 8 >> shift & 0xff);
  return padded;
}

void compress(sha256_blocks::State& hash, std::string_view blocks) {
  static const bool kHasInstructions = sha256_blocks::has_instructions();
  kHasInstructions ? sha256_blocks::compress_by_instructions(hash, blocks)
                   : sha256_blocks::compress_portably(hash, blocks);
}

}  // namespace

void Sha256::add(std::string_view bytes) {
  total_ += bytes.size();
  if (!tail_.empty()) {
    const std::string_view first = bytes.substr(0, kBlockBytes - tail_.size());
    tail_ += first;
    bytes.remove_prefix(first.size());
    if (tail_.size() < kBlockBytes) return;
    compress(hash_, tail_);
  }
  const std::size_t whole = bytes.size() - bytes.size() % kBlockBytes;
  compress(hash_, bytes.substr(0, whole));
  tail_ = bytes.substr(whole);
}

std::string Sha256::text() const {
  sha256_blocks::State hash = hash_;
  compress(hash, padded_tail(tail_, total_));
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint32_t word : hash)
    for (int shift = 28; shift >= 0; shift -= 4) text += kDigits[word >> shift & 0xf];
  return text;
}

std::string sha256(std::string_view bytes) {
  Sha256 digest;
  digest.add(bytes);
  return digest.text();
}

}  // namespace regulus::detail
