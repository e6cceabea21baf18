// SPDX-License-Identifier: Apache-2.0
#include "runtime/files/sha256_blocks.hpp"

#include <bit>
#ifdef __x86_64__
#include <cpuid.h>
#include <immintrin.h>
#endif

namespace regulus::detail::sha256_blocks {
namespace {

// Fractional parts of the cube roots of the first 64 primes (FIPS 180-4, §4.2.2).
alignas(16) constexpr std::array<std::uint32_t, 64> kRound = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

using Schedule = std::array<std::uint32_t, 64>;

std::uint32_t big_endian_word(std::string_view bytes) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word = word << 8 | static_cast<unsigned char>(bytes[i]);
  return word;
}

Schedule message_schedule(std::string_view block) {
  Schedule w{};
  for (std::size_t t = 0; t < 16; ++t) w[t] = big_endian_word(block.substr(4 * t, 4));
  for (std::size_t t = 16; t < 64; ++t) {
    const std::uint32_t s0 = std::rotr(w[t - 15], 7) ^ std::rotr(w[t - 15], 18) ^ w[t - 15] >> 3;
    const std::uint32_t s1 = std::rotr(w[t - 2], 17) ^ std::rotr(w[t - 2], 19) ^ w[t - 2] >> 10;
    w[t] = s1 + w[t - 7] + s0 + w[t - 16];
  }
  return w;
}

void compress_block(State& hash, std::string_view block) {
  const Schedule w = message_schedule(block);
  auto [a, b, c, d, e, f, g, h] = hash;
  for (std::size_t t = 0; t < 64; ++t) {
    const std::uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + kRound[t] + w[t];
    const std::uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const State added = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < hash.size(); ++i) hash[i] += added[i];
}

}  // namespace

void compress_portably(State& hash, std::string_view blocks) {
  for (; !blocks.empty(); blocks.remove_prefix(kBlockBytes))
    compress_block(hash, blocks.substr(0, kBlockBytes));
}

#ifdef __x86_64__

bool has_instructions() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  if (__get_cpuid(1, &a, &b, &c, &d) == 0 || (c & bit_SSE4_1) == 0 || (c & bit_SSSE3) == 0)
    return false;
  constexpr unsigned kSha = 1U << 29;
  return __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b & kSha) != 0;
}

namespace {

#define REGULUS_SHA __attribute__((target("sha,sse4.1,ssse3")))

/// The state as the instructions take it: words (a, b, e, f) and (c, d, g, h), the first one highest.
struct Halves {
  __m128i abef, cdgh;
};

REGULUS_SHA __m128i* words(void* at) { return static_cast<__m128i*>(at); }

REGULUS_SHA Halves load(State& hash) {
  const __m128i cdab = _mm_shuffle_epi32(_mm_loadu_si128(words(hash.data())), 0xb1);
  const __m128i efgh = _mm_shuffle_epi32(_mm_loadu_si128(words(hash.data() + 4)), 0x1b);
  return {_mm_alignr_epi8(cdab, efgh, 8), _mm_blend_epi16(efgh, cdab, 0xf0)};
}

REGULUS_SHA void store(const Halves& state, State& hash) {
  const __m128i feba = _mm_shuffle_epi32(state.abef, 0x1b);
  const __m128i dchg = _mm_shuffle_epi32(state.cdgh, 0xb1);
  _mm_storeu_si128(words(hash.data()), _mm_blend_epi16(feba, dchg, 0xf0));
  _mm_storeu_si128(words(hash.data() + 4), _mm_alignr_epi8(dchg, feba, 8));
}

/// Four rounds with the schedule's words w[4·i], …, w[4·i + 3].
REGULUS_SHA void do_four_rounds(Halves& state, __m128i w, std::size_t i) {
  const auto* const round = reinterpret_cast<const __m128i*>(kRound.data() + 4 * i);
  __m128i sum = _mm_add_epi32(w, _mm_load_si128(round));
  state.cdgh = _mm_sha256rnds2_epu32(state.cdgh, state.abef, sum);
  sum = _mm_shuffle_epi32(sum, 0x0e);
  state.abef = _mm_sha256rnds2_epu32(state.abef, state.cdgh, sum);
}

REGULUS_SHA void compress_block(Halves& state, const char* block) {
  const __m128i big_endian = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
  const Halves before = state;
  __m128i w[4];
  for (std::size_t i = 0; i < 16; ++i) {
    __m128i& next = w[i % 4];
    if (i < 4) {
      const auto* const at = reinterpret_cast<const __m128i*>(block + 16 * i);
      next = _mm_shuffle_epi8(_mm_loadu_si128(at), big_endian);
    } else {
      const __m128i last = w[(i + 3) % 4], earlier = _mm_alignr_epi8(last, w[(i + 2) % 4], 4);
      next = _mm_add_epi32(_mm_sha256msg1_epu32(next, w[(i + 1) % 4]), earlier);
      next = _mm_sha256msg2_epu32(next, last);
    }
    do_four_rounds(state, next, i);
  }
  state.abef = _mm_add_epi32(state.abef, before.abef);
  state.cdgh = _mm_add_epi32(state.cdgh, before.cdgh);
}

}  // namespace

REGULUS_SHA void compress_by_instructions(State& hash, std::string_view blocks) {
  Halves state = load(hash);
  for (; !blocks.empty(); blocks.remove_prefix(kBlockBytes)) compress_block(state, blocks.data());
  store(state, hash);
}

#undef REGULUS_SHA

#else

bool has_instructions() { return false; }
void compress_by_instructions(State& hash, std::string_view blocks) {
  compress_portably(hash, blocks);
}

#endif

}  // namespace regulus::detail::sha256_blocks
