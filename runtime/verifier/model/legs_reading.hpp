// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/verifier/model/section_reading.hpp"

namespace regulus::verifier {

/// Returns the reader of [legs].
[[nodiscard]] std::unique_ptr<SectionReading> legs_reading(const WrittenValues& values);

}  // namespace regulus::verifier
