// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace regulus::detail {

/// A file that an option names, to be written by the end of a command.
struct OutputFile {
  std::string option;         ///< for messages
  std::string path;           ///< empty: none
  bool must_be_file = false;  ///< not a device: the file is put in place by a rename
  /// The file may have a folder of numbered parts beside it: the ending of the folder's name.
  std::string parts_ending = {};
  /// The run goes on with the file of an earlier one, which is not renamed.
  bool continues = false;
};

/// Renames the files of earlier runs, FILE to FILE.old. So the proof or the picture of an earlier
/// run cannot be taken for that of a run that ended without one, by an error, a signal or a full
/// disk.
///
/// The folder of its parts goes with it, and FILE.old has no parts of another file. The folder of a
/// file that does not exist, because its run was killed, is removed.
///
/// Call it before anything else is done: it tries whether a file can be made in each folder. Devices
/// and pipes stay as they are. An existing FILE.old is replaced.
///
/// Throws    FileError when a file cannot be made or moved, or a folder of parts has other files;
///           UsageError when two outputs, or an output and a file of `inputs`, would use one name.
///           Nothing is moved unless all files can be made. Empty paths are none.
void set_earlier_outputs_aside(const std::vector<std::string>& inputs,
                               const std::vector<OutputFile>& outputs);

}  // namespace regulus::detail
