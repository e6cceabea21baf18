// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/plain_sentences.hpp"

#include <utility>

#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {

PlainSentences::PlainSentences(std::string_view text) {
  Sentence sentence;
  for (const CoqToken& token : coq_tokens(text)) {
    last_line_ = token.line;
    if (token.kind != CoqToken::Kind::kPeriod) {
      sentence.push_back(token);
    } else if (!sentence.empty()) {
      sentences_.push_back(std::exchange(sentence, {}));
    } else {
      throw Rejection("line " + std::to_string(token.line) + ": an empty sentence");
    }
  }
  if (!sentence.empty()) throw Rejection("the last sentence has no end");
}

const Sentence& PlainSentences::words() const {
  static const Sentence kNone;
  return at_end() ? kNone : sentences_[at_];
}

void PlainSentences::expect(std::string_view sentence) {
  if (current() != sentence) fail("expected the sentence '" + std::string(sentence) + ".'");
  next();
}

void PlainSentences::fail(const std::string& what) const {
  const std::size_t line = at_end() ? last_line_ : words().front().line;
  throw Rejection("line " + std::to_string(line) + ": " + what);
}

}  // namespace regulus::verifier
