// SPDX-License-Identifier: GPL-3.0-or-later
// Models of robots that files of other programs describe.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace regulus::inline importing {

struct ImportOptions {
  std::string base{}, tip{};        ///< links; empty: the only one that can be meant
  std::vector<std::string> cuts{};  ///< "LINK=LINK": loops that the file does not have
  std::string snap = "1e-9";        ///< numbers move by at most this much
};

/// A model file, and what a user should know of how it came about.
struct Imported {
  std::string model;   ///< its text
  std::string report;  ///< lines: what was read, ignored, renamed, snapped, assumed
};

/// The largest file that is read.
constexpr std::size_t kLargestImport = std::size_t{16} << 20;

/// Makes a model of a URDF, MJCF or SDF file: [serial] of an arm, [gough] of a platform on six legs.
///
/// Ensures   the model's text is read without an error.
/// Throws    InputError with file and line; UsageError if an option is missing or wrong.
[[nodiscard]] Imported import_robot(std::string_view text, const std::string& file,
                                    const ImportOptions& options);

}  // namespace regulus::importing
