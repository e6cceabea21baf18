// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a table of way-points as places, one a line, that nothing joins.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "codegen/model/place.hpp"

namespace regulus::detail {

struct PlaceRow {
  int line = 0;                  ///< of the file
  std::optional<double> time{};  ///< of the column t or time, rounded; nullopt: there is none
  std::vector<GivenNumber> numbers;
};

struct PlaceFile {
  std::string sha256;       ///< of the file's bytes
  std::string time_unit{};  ///< empty: none is given
  std::vector<PlaceRow> rows;
  std::vector<std::string> notes;  ///< what may have been meant otherwise
};

/// Reads a table as `check --waypoints` takes it. Its columns are pose parameters, or the lengths of all
/// legs, or the coordinates of the tool (place.hpp).
///
/// Errors    InputError with the line of the file, also for G-code; FileError.
[[nodiscard]] PlaceFile read_places(const Model& model, const std::string& file);

}  // namespace regulus::detail
