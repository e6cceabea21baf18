// SPDX-License-Identifier: GPL-3.0-or-later
// The objects of one compilation as one string of bytes, which is what the cache keeps.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regulus::codegen {

/// One more object at the end of the bundle. A bundle of one object is that object.
void add_to_bundle(std::string& bundle, std::string_view object);

/// The objects in the order they were added; bytes that are no bundle are one object.
[[nodiscard]] std::vector<std::string_view> objects_in(std::string_view bundle);

}  // namespace regulus::codegen
