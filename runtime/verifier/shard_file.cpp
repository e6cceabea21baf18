// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/shard_file.hpp"

#include "runtime/files/sha256.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

constexpr std::uint64_t kPartOfShard = std::uint64_t{1} << 16;

std::string digest_of(const std::string& path) {
  InputFile bytes(path);
  std::string part(kPartOfShard, '\0');
  detail::Sha256 digest;
  for (std::streamsize count;
       (count = bytes.sgetn(part.data(), std::streamsize(kPartOfShard))) > 0;)
    digest.add(std::string_view(part).substr(0, std::size_t(count)));
  return digest.text();
}

InputFile opened(const std::string& path) try {
  return InputFile(path);
} catch (const std::runtime_error& error) {
  throw Rejection(std::string("it is missing: ") + error.what());
}

}  // namespace

std::vector<ListedShard> read_listed(Lines& lines, const ListedWords& listed) {
  std::vector<ListedShard> shards;
  std::uint64_t sum = 0;
  for (;;) {
    if (!lines.next())
      throw Rejection("the file ends before the line '" + std::string(listed.last) + '\'');
    const auto words = words_of(lines.text());
    if (words.size() != 4 || words[0] != "shard") break;
    if (shards.size() == format::kMostShards) throw Rejection("there are too many shards");
    shards.push_back({read_count(words[1], format::kMostShards),
                      read_count(words[2], std::size_t(-1)), std::string(words[3]),
                      lines.number()});
    if (shards.back().number != shards.size())
      throw Rejection("expected shard " + std::to_string(shards.size()));
    sum += shards.back().leaves;
  }
  const auto words = words_of(lines.text());
  if (words.size() != 2 || words[0] != listed.last || shards.empty())
    throw Rejection("expected 'shard NUMBER " + std::string(listed.shown) + " SHA256' or '" +
                    listed.last + ' ' + listed.shown + '\'');
  if (read_count(words[1], std::size_t(-1)) != sum)
    throw Rejection("the line '" + std::string(listed.last) + "' gives a wrong number of " +
                    listed.counted);
  if (lines.next())
    throw Rejection("there is text after the line '" + std::string(listed.last) + '\'');
  return shards;
}

std::string begin_of_state(std::size_t tree, std::size_t open) {
  return "tree " + std::to_string(tree + 1) + ", " + std::to_string(open) + " open, ";
}

std::string state_text(std::size_t tree, const OpenBoxes& open) {
  return begin_of_state(tree, open.boxes.size()) + open.text();
}

ShardFile::ShardFile(const std::string& path, const ListedShard& listed,
                     const std::string& question)
    : bytes_(opened(path)), stream_(&bytes_), lines_(stream_) {
  require(question.empty() ? format::kPlacesShardMagic : format::kShardMagic,
          "it is not a shard of a certificate");
  if (!question.empty())
    require("question " + question, "it belongs to the proof of another question");
  require("shard " + std::to_string(listed.number), "it is another shard");
  if (digest_of(path) != listed.sha256)
    throw Rejection("its bytes are not those of the index: their SHA-256 is another one");
}

void ShardFile::advance() {
  if (!lines_.next()) throw Rejection("the file ends before its line 'proof'");
}

void ShardFile::require(const std::string& line, const std::string& otherwise) {
  advance();
  if (lines_.text() != line)
    throw Rejection(otherwise + ": its line is '" + lines_.text().substr(0, 100) +
                    "', but should be '" + line + "'");
}

std::size_t ShardFile::read_piece(std::size_t most) {
  advance();
  const auto words = words_of(lines_.text());
  if (words.size() != 2 || words[0] != "piece") throw Rejection("expected 'piece NUMBER'");
  const std::size_t number = read_count(words[1], most);
  if (number == 0) throw Rejection("pieces are numbered from 1");
  return number - 1;
}

OpenBoxes ShardFile::read_open(const Box& root) {
  OpenBoxes open;
  advance();
  const auto next = words_of(lines_.text());
  if (next.size() != 2 || next[0] != "next") throw Rejection("expected 'next BOX'");
  open.next = read_count(next[1], std::size_t(-1));
  for (advance(); lines_.text() != "proof"; advance()) {
    if (open.boxes.size() == format::kMostOpen) throw Rejection("too many boxes are open");
    read_box(words_of(lines_.text()), root, open);
  }
  return open;
}

/// Ranges that are not given are those of box 0.
void ShardFile::read_box(const std::vector<std::string_view>& words, const Box& root,
                         OpenBoxes& into) const {
  if (words.size() < 2 || words.size() % 3 != 2 || words[0] != "open")
    throw Rejection("expected 'open BOX VARIABLE LOWER UPPER …' or 'proof'");
  const auto [place, is_new] = into.boxes.emplace(read_count(words[1], std::size_t(-1)), root);
  if (!is_new) throw Rejection("box " + std::string(words[1]) + " is open twice");
  for (std::size_t i = 2; i < words.size(); i += 3) {
    const std::size_t k = read_count(words[i], format::kMostVariables);
    if (k >= root.size()) throw Rejection("there is no variable " + std::string(words[i]));
    Interval& range = place->second[k];
    if (words[i + 1] != format::kEndOfRoot) range.lo = read_double(words[i + 1]);
    if (words[i + 2] != format::kEndOfRoot) range.hi = read_double(words[i + 2]);
    if (!(range.lo <= range.hi)) throw Rejection("the ends of a range are not in order");
  }
}

}  // namespace regulus::verifier
