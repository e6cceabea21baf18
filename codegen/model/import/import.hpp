// SPDX-License-Identifier: GPL-3.0-or-later
// Models of robots that files of other programs describe.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace regulus {

struct ImportOptions {
  std::string base{}, tip{};         ///< links; empty: the only one that can be meant
  std::vector<std::string> cuts{};   ///< "LINK=LINK": points of loops that the file does not have
  std::vector<std::string> welds{};  ///< the same for frames
  std::vector<std::string> actuated{};  ///< driven joints of a robot with loops; empty: the usual
  std::vector<std::string> at{};        ///< "JOINT=VALUE": from where loops are closed
  bool closure = false;                 ///< [closure] also for robots that have other words
  std::string list{}, list_file{};      ///< text and path of the closures beside a URDF file
  std::string snap = "1e-8";            ///< numbers move by at most this much
};

/// Notes for the user on how a model came about, under one title: "read", "robot", "matrix",
/// "ignored", "renamed", "snapped" or "note".
struct ImportNotes {
  std::string title;
  std::vector<std::string> lines;  ///< at least one
};

struct Imported {
  std::string model;  ///< the text of the model file
  std::vector<ImportNotes> notes;

  /// Returns the notes as lines of text.
  [[nodiscard]] std::string report() const;
};

/// The largest file that is read.
constexpr std::size_t kLargestImport = std::size_t{16} << 20;

/// Makes a model of a URDF, MJCF or SDF file: [serial] of an arm, [gough] of a platform on six legs,
/// [legs] of a robot in the plane with loops, [closure] of any other robot with loops.
///
/// Ensures   the model's text is read without an error.
/// Throws    InputError with file and line; UsageError if an option is missing or wrong.
[[nodiscard]] Imported import_robot(std::string_view text, const std::string& file,
                                    const ImportOptions& options);

/// The same for a file on a disk, with the closures that FILE.yaml has beside FILE.urdf.
///
/// Throws    FileError besides.
[[nodiscard]] Imported import_robot_file(const std::string& path, const ImportOptions& options);

}  // namespace regulus
