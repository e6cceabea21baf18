// SPDX-License-Identifier: GPL-3.0-or-later
// A proof in shards as one text: its index, and the shards behind it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace regulus::detail::attack {

[[nodiscard]] std::string read(const std::filesystem::path& path);
void write(const std::filesystem::path& path, const std::string& text);

/// Returns the text of a certificate, with its shards if it is an index.
[[nodiscard]] std::string read_proof(const std::string& path);

/// Writes it, and the shards into the folder beside it.
void write_proof(const std::string& proof, const std::string& path);

/// Cuts a certificate in one file into shards of about `size` bytes.
void cut_proof(const std::string& path, std::uint64_t size);

/// Returns true if the text is an index with its shards.
[[nodiscard]] bool is_in_shards(const std::string& proof);

/// Writes all SHA-256 of an index and its shards anew, as one who forges them would.
[[nodiscard]] std::string signed_again(const std::string& proof);

}  // namespace regulus::detail::attack
