// SPDX-License-Identifier: GPL-3.0-or-later
// The question of a certificate: model and motion as they were read, before any rewriting.
#pragma once

#include "regulus/certificate/writer.hpp"
#include "regulus/codegen/driver/pipeline.hpp"

namespace regulus::codegen {

/// Throws UsageError when the model's names do not fit into a certificate: two things of one name.
[[nodiscard]] CertifiedQuestion certified_question(const Preparation& preparation);

}  // namespace regulus::codegen
