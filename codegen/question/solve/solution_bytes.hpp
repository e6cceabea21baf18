// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the solutions at a place of a table as a message between ranks that share the places.
#pragma once

#include "codegen/question/solve/solutions.hpp"
#include "codegen/question/solve/solve_certificate.hpp"
#include "runtime/cluster/bytes.hpp"

namespace regulus::detail {

void put(cluster::ByteWriter& to, const Solutions& solutions);
void put(cluster::ByteWriter& to, const ListProof& list);

/// Throws    MalformedMessage.
[[nodiscard]] Solutions take_solutions(cluster::ByteReader& from);
[[nodiscard]] ListProof take_list_proof(cluster::ByteReader& from);

}  // namespace regulus::detail
