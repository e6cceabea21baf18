// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/files/sha256.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "runtime/files/sha256_blocks.hpp"

namespace regulus::detail {
namespace {

TEST(Sha256, GivesThePublishedDigests) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// Digests by coreutils sha256sum; at 55, 56, 63, 64 and 65 bytes the padding changes its form.
TEST(Sha256, PadsCorrectlyAroundTheEndOfABlock) {
  EXPECT_EQ(sha256(std::string(55, 'x')),
            "d5e285683cd4efc02d021a5c62014694958901005d6f71e89e0989fac77e4072");
  EXPECT_EQ(sha256(std::string(56, 'x')),
            "04c26261370ee7541549d16dee320c723e3fd14671e66a099afe0a377c16888e");
  EXPECT_EQ(sha256(std::string(63, 'x')),
            "75220b47218278e656f2013bb8f0c455a25eaf01e86c64924e9d48d89776d6f2");
  EXPECT_EQ(sha256(std::string(64, 'x')),
            "7ce100971f64e7001e8fe5a51973ecdfe1ced42befe7ee8d5fd6219506b5393c");
  EXPECT_EQ(sha256(std::string(65, 'x')),
            "9537c5fdf120482f7d58d25e9ed583f52c02b4e304ea814db1633ad565aed7e9");
}

TEST(Sha256, TakesBytesAboveAsciiAndZeros) {
  EXPECT_EQ(sha256(std::string("\0\xff\x80", 3)),
            "f742b965f156c10374bc23aea96e3a8aff8facd6fc079defeaa30219ad86f211");
}

TEST(Sha256, IsTheSameOfBytesThatComeInPieces) {
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes += static_cast<char>(i * 7);
  for (const std::size_t piece : {1U, 3U, 63U, 64U, 65U, 128U, 999U}) {
    Sha256 digest;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      EXPECT_EQ(digest.text(), sha256(std::string_view(bytes).substr(0, at)));
      digest.add(std::string_view(bytes).substr(at, piece));
    }
    EXPECT_EQ(digest.text(), sha256(bytes)) << piece;
  }
}

TEST(Sha256, IsTheSameWithAndWithoutInstructionsOfTheProcessor) {
  if (!sha256_blocks::has_instructions()) GTEST_SKIP() << "this processor has none";
  std::mt19937 random(5);
  for (std::size_t blocks = 0; blocks < 40; ++blocks) {
    std::string bytes;
    while (bytes.size() < blocks * sha256_blocks::kBlockBytes)
      bytes += static_cast<char>(random() & 0xffU);
    sha256_blocks::State portable;
    for (std::uint32_t& word : portable) word = random();
    sha256_blocks::State instructed = portable;
    sha256_blocks::compress_portably(portable, bytes);
    sha256_blocks::compress_by_instructions(instructed, bytes);
    EXPECT_EQ(instructed, portable) << blocks;
  }
}

}  // namespace
}  // namespace regulus::detail
