// SPDX-License-Identifier: Apache-2.0
// Certificates in shards (FORMAT.md, "Shards").
#pragma once

#include <cstdint>
#include <string>

namespace regulus::detail {

/// Cuts the tree of a complete certificate, or its trees, each in preorder, into shards of about `size`
/// bytes in the folder `path`.shards, and returns the text of their index. The folder
/// appears under its name only when it is complete and safe on the disk.
///
/// Requires  `certificate` is a file that CertificateWriter wrote; there is no such folder yet.
/// Errors    std::runtime_error, whose text completes the sentence "the certificate cannot ...";
///           std::bad_alloc. The memory is 16 bytes for each box of the largest
///           tree.
[[nodiscard]] std::string write_shards(const std::string& certificate, const std::string& path,
                                       std::uint64_t size);

/// Cuts a certificate about the places of a table between two places: the same for its parts.
///
/// Requires  `certificate` is such a file; there is no such folder yet.
[[nodiscard]] std::string write_shards_of_places(const std::string& certificate,
                                                 const std::string& path, std::uint64_t size);

}  // namespace regulus::detail
