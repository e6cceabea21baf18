// SPDX-License-Identifier: GPL-3.0-or-later
// The question that the front end writes of a file, compared with a file by the verifier.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <sstream>
#include <string>
#include <vector>

#include "codegen/answer/certificate/certificate_question.hpp"
#include "codegen/model/request.hpp"
#include "runtime/verifier/model/model_comparison.hpp"

namespace regulus::detail::test::readings {

inline std::string head_of(const std::string& text) {
  ModelOptions options;
  options.path = "test.toml";
  options.text = text;
  const Request request = read_request(options);
  const CertifiedQuestion question = certified_question(request, uncertain_names(request));
  return std::string(format::kMagic) + "\nverdict NO SINGULARITY\nclaim " +
         question.no_singularity + '\n' + question.text + "proof\n";
}

/// The outcome for the question alone: no proof follows.
inline verifier::Outcome compared(const std::string& head, const std::string& text,
                                  std::string& why) {
  std::istringstream stream(head);
  verifier::Lines lines(stream);
  verifier::Question question;
  verifier::read_question(lines, question);
  question.graph.end_of_file();
  verifier::Options options;
  options.model_name = "test.toml";
  options.model_text = text;
  verifier::Verification result;
  why.clear();
  try {
    compare_with_model(question, verifier::read_model_values(text), options, result);
  } catch (const verifier::OtherModel& other) {
    why = other.what();
    return verifier::Outcome::kRejected;
  } catch (const verifier::Unfinished& unfinished) {
    why = unfinished.what();
    return verifier::Outcome::kUnfinished;
  }
  return verifier::Outcome::kVerified;
}

inline verifier::Outcome compared(const std::string& head, const std::string& text) {
  std::string why;
  return compared(head, text, why);
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// Returns the text with each number between `begin` and `end` changed, one at a time.
inline std::vector<std::string> with_another_number(const std::string& text,
                                                    const std::string& begin,
                                                    const std::string& end) {
  std::vector<std::string> result;
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
  };
  const std::size_t stop = text.find(end);
  for (std::size_t at = text.find(begin); at < stop; ++at) {
    const char before = text[at - 1];
    if (!std::isdigit(static_cast<unsigned char>(text[at])) || is_word(before) || before == '.')
      continue;
    std::size_t last = at;
    while (std::isdigit(static_cast<unsigned char>(text[last])) || text[last] == '.') ++last;
    if (text.compare(last, 1, "]") == 0 && before == '[') continue;
    result.push_back(std::string(text).insert(last, text.find('.', at) < last ? "7" : ".7"));
    at = last;
  }
  return result;
}

}  // namespace regulus::detail::test::readings
