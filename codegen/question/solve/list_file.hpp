// SPDX-License-Identifier: GPL-3.0-or-later
// Files of proofs of all solutions: of those at one place, and at the places of a table.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "codegen/answer/certificate/proof_status.hpp"
#include "codegen/question/solve/solve_certificate.hpp"

namespace regulus::detail {

/// Writes the proof of what is known of the solutions at one place, if there is one. An empty path means
/// that none is wanted.
///
/// Requires  solutions are those of the request.
[[nodiscard]] ProofStatus certify_solutions(const std::string& path, const Request& request,
                                            const Solutions& solutions);

/// The proof at a place of a table, and how the report calls it: "line 3".
struct PlaceProof {
  std::string name;
  ListProof list;
};

/// Writes a certificate with a part for each place (FORMAT.md, "Places of a table"). A part without a proof
/// is empty, and the report says so; without any proof there is no file.
///
/// `left`: places that were not asked: the table is not whole, and there is no file. `shard_size`: as
/// ProofFile::set_shard_size.
[[nodiscard]] ProofStatus certify_places(const std::string& path,
                                         const std::vector<PlaceProof>& places, std::uint64_t left,
                                         std::uint64_t shard_size);

}  // namespace regulus::detail
