// SPDX-License-Identifier: Apache-2.0
// A certificate about the places of a table: a part for each, which is a certificate of its own.
#pragma once

#include <optional>

#include "runtime/verifier/model/place_table.hpp"
#include "runtime/verifier/verify.hpp"

namespace regulus::verifier {

/// The place that a part must be about.
struct PlacePart {
  std::size_t number = 0;  ///< from 0
  /// The file that --waypoints or the motion names; nullopt: it is not read yet, or there is none.
  std::optional<PlaceTable>* table = nullptr;
};

/// Compares the question of a part with the model file and the row of the table. Throws OtherModel for
/// what differs, Unfinished for what cannot be compared.
void compare_place(Question& question, const WrittenValues& model, const Options& options,
                   const PlacePart& place, Verification& result);

/// Proves a part as a certificate of its own: returns if its claim is true, and throws Rejection,
/// Unfinished or OtherModel.
using CheckPart = void (*)(Lines& lines, const Options& options, PlacePart& place,
                           Verification& result);

/// Reads on from the first line to the end of the file, and proves each part. With a model file there
/// must be a part for each row of the table, in the same order. Returns if all claims are true; throws
/// Rejection, Unfinished or OtherModel.
void check_places(Lines& lines, const Options& options, CheckPart check_part, Verification& result);

}  // namespace regulus::verifier
