// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/forge/bundle.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "runtime/files/sha256.hpp"
#include "runtime/proof/format.hpp"
#include "runtime/proof/shards.hpp"

namespace regulus::detail::attack {

namespace fs = std::filesystem;

namespace {

/// The index, then each shard.
std::vector<std::string> parts_of(const std::string& proof) {
  const std::string mark = '\n' + std::string(format::kShardMagic) + '\n';
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t at; (at = proof.find(mark, begin)) != std::string::npos; begin = at + 1)
    parts.push_back(proof.substr(begin, at + 1 - begin));
  parts.push_back(proof.substr(begin));
  return parts;
}

/// Replaces the last word of the line that begins at `line`.
void set_last_word(std::string& text, std::size_t line, const std::string& word) {
  const std::size_t end = std::min(text.find('\n', line), text.size());
  const std::size_t space = text.rfind(' ', end);
  if (space != std::string::npos && space > line) text.replace(space + 1, end - space - 1, word);
}

}  // namespace

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string read_proof(const std::string& path) {
  std::string proof = read(path);
  for (std::size_t i = 1; fs::exists(format::shard_file(path, i)); ++i)
    proof += read(format::shard_file(path, i));
  return proof;
}

void write_proof(const std::string& proof, const std::string& path) {
  const fs::path folder = path + format::kShardsEnding;
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::vector<std::string> parts = parts_of(proof);
  write(path, parts[0]);
  for (std::size_t i = 1; i < parts.size(); ++i) write(format::shard_file(path, i), parts[i]);
}

void cut_proof(const std::string& path, std::uint64_t size) {
  write(path, write_shards(path, path, size));
}

bool is_in_shards(const std::string& proof) {
  return proof.starts_with(std::string(format::kIndexMagic) + '\n');
}

std::string signed_again(const std::string& proof) {
  std::vector<std::string> parts = parts_of(proof);
  std::string& index = parts[0];
  const std::size_t second = index.find('\n') + 1, end = index.find("\nproof\n");
  if (end == std::string::npos) return proof;
  const std::string question = sha256(index.substr(second, end + 7 - second));
  std::size_t line = end + 7;
  if (index.compare(line, 6, "value ") == 0) line = index.find('\n', line) + 1;
  std::string shards;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::size_t at = parts[i].find("\nquestion ");
    if (at != std::string::npos) set_last_word(parts[i], at + 1, question);
    if (index.compare(line, 6, "shard ") == 0) set_last_word(index, line, sha256(parts[i]));
    line = std::min(index.find('\n', line), index.size() - 1) + 1;
    shards += parts[i];
  }
  return index + shards;
}

}  // namespace regulus::detail::attack
