// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs in shards written by hand, as FORMAT.md says: an index and hashes that agree with whatever
// the shards say.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "runtime/files/sha256.hpp"
#include "runtime/proof/format.hpp"
#include "tests/support/certificate_texts.hpp"

namespace regulus::detail::test {

struct HandmadeShard {
  std::string open;   ///< lines from `next` on
  std::string lines;  ///< after `proof`
  unsigned leaves = 0;
};

class HandmadeShards {
 public:
  /// Without `proof`, with the first line of a certificate in one file.
  explicit HandmadeShards(const std::string& question)
      : question_(question.substr(question.find('\n') + 1) + "proof\n") {}

  std::vector<HandmadeShard> shards;
  std::string value;  ///< the line between `proof` and the shards, of a bound that is attained

  [[nodiscard]] std::string question_hash() const { return sha256(question_); }
  [[nodiscard]] std::string text_of(std::size_t shard) const {
    const HandmadeShard& s = shards[shard];
    return std::string(format::kShardMagic) + "\nquestion " + question_hash() + "\nshard " +
           std::to_string(shard + 1) + '\n' + s.open + "proof\n" + s.lines + "end " +
           std::to_string(s.leaves) + '\n';
  }
  [[nodiscard]] std::string index() const {
    std::string text = std::string(format::kIndexMagic) + '\n' + question_ + value;
    unsigned leaves = 0;
    for (std::size_t i = 0; i < shards.size(); ++i) {
      text += "shard " + std::to_string(i + 1) + ' ' + std::to_string(shards[i].leaves) + ' ' +
              sha256(text_of(i)) + '\n';
      leaves += shards[i].leaves;
    }
    return text + "end " + std::to_string(leaves) + '\n';
  }
  /// Writes everything and verifies it.
  [[nodiscard]] verifier::Verification verify_in(const std::string& path,
                                                 verifier::Options options = {}) const {
    std::filesystem::create_directories(path + format::kShardsEnding);
    for (std::size_t i = 0; i < shards.size(); ++i)
      std::ofstream(format::shard_file(path, i + 1), std::ios::binary) << text_of(i);
    options.path = path;
    return verify_text(index(), options);
  }

 private:
  std::string question_;
};

}  // namespace regulus::detail::test
