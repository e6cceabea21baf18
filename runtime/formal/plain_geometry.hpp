// SPDX-License-Identifier: Apache-2.0
// The theorems about a robot in a file of the plain grammar.
#pragma once

#include "runtime/formal/coq_audit.hpp"
#include "runtime/formal/plain_sentences.hpp"

namespace regulus::verifier {

/// Reads them if the current sentence begins them. Throws Rejection, with the line.
void read_plain_geometry(PlainSentences& sentences, PlainTheorem& theorem);

}  // namespace regulus::verifier
