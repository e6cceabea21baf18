// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates of lists of solutions, as tests make, read and forge them.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "codegen/question/solve/list_file.hpp"
#include "runtime/verifier/verify.hpp"
#include "tests/property/solve/solved.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temporary_directory.hpp"

namespace regulus::detail::test {

using verifier::Outcome;
using Lines = std::vector<std::string>;

inline std::string library_model(const std::string& name) {
  return file_contents(std::filesystem::path(REGULUS_SOURCE_DIR) / "models" / (name + ".toml"));
}

struct Certified {
  Solutions solutions;
  ProofStatus status;
  std::string text;  ///< empty: no certificate was written
};

inline Certified certified(const std::string& model, const std::vector<std::string>& at = {},
                           const std::string& motion = "", std::uint64_t boxes = 20'000) {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "certificate").string();
  SearchOptions search;
  search.engine = Engine::kInterpreted;
  search.threads = 1;
  search.time_limit = 0;
  search.max_boxes = boxes;  // as many on a busy machine
  ModelOptions options;
  options.text = model;
  options.at = at;
  options.motion = motion;
  const Request request = read_solve_request(options, {});
  Certified result{solve(request, SolveRun{search, {}}), ProofStatus(), ""};
  result.status = certify_solutions(path, request, result.solutions);
  if (result.status.is_written()) result.text = file_contents(path);
  return result;
}

inline verifier::Verification verified(const std::string& certificate,
                                       const std::string& model = "", bool allows_options = false) {
  verifier::Options options;
  options.model_text = model;
  options.model_name = "model.toml";
  options.all_overridden = allows_options;
  std::istringstream stream(certificate);
  return verifier::verify(stream, options);
}

inline Outcome outcome(const std::string& certificate, const std::string& model = "") {
  const verifier::Verification v = verified(certificate, model);
  SCOPED_TRACE(describe(v));
  return v.outcome;
}

inline Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline std::string joined(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

inline std::size_t first(const Lines& lines, const std::string& key) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].starts_with(key + ' ')) return i;
  ADD_FAILURE() << "no line " << key;
  return 0;
}

inline std::size_t count_of(const Lines& lines, const std::string& key) {
  return std::size_t(std::ranges::count_if(
      lines, [&](const std::string& line) { return line.starts_with(key + ' '); }));
}

/// Writes the verdict and the claim that belong to the lines.
inline Lines claiming(Lines lines, const std::string& verdict, const std::string& robot,
                      const char* one, const char* many) {
  lines[first(lines, "verdict")] = "verdict " + verdict;
  lines[first(lines, "claim")] =
      "claim " +
      format::describe_solutions_claim({verdict, robot, one, many, count_of(lines, "solution")});
  return lines;
}

/// The list without any one of its lines is rejected. `text_of` writes lines with a verdict and its claim.
template <class TextOf>
void expect_each_line_is_needed(const Lines& genuine, const TextOf& text_of) {
  const auto at = std::ptrdiff_t(first(genuine, "solution"));
  for (std::size_t k = 0; k < count_of(genuine, "solution"); ++k) {
    Lines fewer = genuine;
    fewer.erase(fewer.begin() + at + std::ptrdiff_t(k));
    const char* verdict = count_of(fewer, "solution") == 0 ? "NONE" : "COMPLETE";
    EXPECT_EQ(outcome(text_of(fewer, verdict)), Outcome::kRejected) << k;
  }
}

/// The certificate without the sum of the file, which would refuse each change of it.
inline std::string without_sum(std::string certificate) {
  const std::size_t sum = certificate.find("\nsha256 ") + 8;
  return certificate.replace(sum, certificate.find('\n', sum) - sum, "-");
}

}  // namespace regulus::detail::test
