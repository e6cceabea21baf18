// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/runner/subject.hpp"

#include <time.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "codegen/use/command/run_command_line.hpp"
#include "tests/attack/oracle/random.hpp"

namespace regulus::detail::attack {
namespace {

struct Answer {
  int exit_code = -1;
  std::string output, errors;
  double seconds = 0;
};

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Redirects the text of a stream to a string during the lifetime of this object.
class Captured {
 public:
  explicit Captured(std::ostream& stream) : stream_(stream), before_(stream.rdbuf(text_.rdbuf())) {}
  ~Captured() { stream_.rdbuf(before_); }
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;
  [[nodiscard]] std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::ostream& stream_;
  std::streambuf* before_;
};

Answer run_command(const std::vector<std::string>& words) {
  std::vector<const char*> arguments;
  std::string typed;
  for (const std::string& word : words) {
    arguments.push_back(word.c_str());
    typed += (typed.empty() ? "" : " ") + word;
  }
  const Captured output(std::cout), errors(std::cerr);
  const double begin = processor_seconds();
  Answer answer;
  answer.exit_code = report_errors([&] {
    return run_command_line(
        parse_command_line(static_cast<int>(arguments.size()), arguments.data()), typed);
  });
  answer.seconds = processor_seconds() - begin;
  answer.output = output.text();
  answer.errors = errors.text();
  return answer;
}

/// Returns the reason in the JSON report, or the messages if there is no reason.
std::string reason_of(const Answer& answer) {
  const auto report = nlohmann::json::parse(answer.output, nullptr, false);
  if (report.is_object() && report.contains("reason") && report["reason"].is_string())
    return report["reason"];
  return answer.errors.substr(0, 300);
}

/// Returns true if the report says that no pose was shown to satisfy the constraints.
bool warns_of_no_pose(const Answer& answer) {
  const auto report = nlohmann::json::parse(answer.output, nullptr, false);
  return report.is_object() && report.contains("nonempty") && report["nonempty"].is_null();
}

/// Returns true if the report says why the verifier may not finish.
bool warns_of_proof(const Answer& answer) {
  const auto report = nlohmann::json::parse(answer.output, nullptr, false);
  return report.is_object() && report.contains("certificate_note");
}

/// Returns the list of solutions of a report; nullopt if there is none.
std::optional<ListedSolutions> list_of(const Answer& answer) {
  const auto report = nlohmann::json::parse(answer.output, nullptr, false);
  if (!report.is_object() || !report.contains("solutions")) return std::nullopt;
  ListedSolutions listed{report["verdict"], {}};
  for (const auto& solution : report["solutions"]) {
    auto& values = listed.solutions.emplace_back();
    for (const auto& [name, ends] : solution["values"].items()) values[name] = {ends[0], ends[1]};
  }
  return listed;
}

/// Returns why the list is false; empty: it is not shown to be.
std::string falsehood_of(const Attack& attack, const Answer& answer) {
  const auto listed = attack.solve ? list_of(answer) : std::nullopt;
  return listed ? refute_list(*attack.solve, *listed).value_or("") : "";
}

/// A closure has one method, and a motion along way-points keeps uncertain quantities whole.
void add_search_options(Random& random, const ModelSource& model, std::vector<std::string>& words) {
  const auto add = [&](std::initializer_list<std::string> more) {
    words.insert(words.end(), more);
  };
  if (random.one_in(40))
    add({"--engine", "jit", "--no-cache"});
  else
    add({"--engine", "interpreted"});
  add({"--threads", random.one_in(8) ? "2" : "1"});
  if (!model.closure.empty()) {
    // Beside a fold, a tube around the way takes many boxes.
    if (!model.way.empty()) add({"--max-boxes", "2000"});
    return;
  }
  if (random.one_in(4))
    add({"--method",
         random.pick(
             {"reg", "reg+rohn", "kj", "kj+rohn", "jk", "jk+rohn", "kj-numeric", "jk-numeric"}),
         "--max-boxes", "300"});
  if (random.one_in(6)) add({"--bisect", random.pick({"widest", "weighted"})});
  if (model.way.empty() && random.one_in(6)) add({"--uncertainty", "variables"});
  if (random.one_in(8)) add({"--determinant", random.pick({"expansion", "gauss"})});
}

bool is_digit(char c) { return '0' <= c && c <= '9'; }

/// Returns the end of the decimal that begins there, with its exponent.
std::size_t end_of_decimal(const std::string& text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && (is_digit(text[end]) || text[end] == '.')) ++end;
  if (end == begin || end + 1 >= text.size() || (text[end] != 'e' && text[end] != 'E')) return end;
  std::size_t exponent = end + 1;
  if (text[exponent] == '-' || text[exponent] == '+') ++exponent;
  const std::size_t digits = exponent;
  while (exponent < text.size() && is_digit(text[exponent])) ++exponent;
  return exponent > digits ? exponent : end;
}

/// Replaces every decimal of 17 characters and more by the double nearest to it.
std::string rounded(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::max(end_of_decimal(text, i), i + 1);
    const std::string number = text.substr(i, end - i);
    i = end;
    if (number.size() < 17) {
      result += number;
      continue;
    }
    char digits[64];
    std::snprintf(digits, sizeof digits, "%.17e", std::stod(number));
    result += digits;
  }
  return result;
}

/// Turns a rejection into an acceptance, and everything else into a rejection.
int falsified(int exit_code) { return exit_code == 0 ? 1 : 0; }

Proof proof_of(const Answer& answer) {
  switch (answer.exit_code) {
    case 0:
      return Proof::kVerified;
    case 1:
      return Proof::kRejected;
    case 2:
      return Proof::kUnfinished;
    default:
      return Proof::kBroken;
  }
}

void verify(const Attack& attack, const std::string& model, const std::string& certificate,
            Outcome& outcome) {
  std::vector<std::string> words{"regulus", "verify", certificate, "--json", "--quiet"};
  // Reading the question from the file again takes as long as the first time.
  if (Random("verify" + attack.family, attack.seed).one_in(4))
    words.insert(words.end(), {"--model", model, "--allow-options"});
  const Answer answer = run_command(words);
  outcome.verify_seconds = answer.seconds;
  outcome.proof = proof_of(answer);
  outcome.proof_reason = reason_of(answer);
}

}  // namespace

std::vector<std::string> check_words(const Attack& attack, const std::string& model_path,
                                     const std::string& certificate_path) {
  Random random("command" + attack.family, attack.seed);
  if (attack.solve)
    return {"regulus",       "solve",
            model_path,      "m",
            "--json",        "--quiet",
            "--engine",      "interpreted",
            "--threads",     random.one_in(8) ? "2" : "1",
            "--max-boxes",   "30000",
            "--certificate", certificate_path};
  std::vector<std::string> words{"regulus", "check",   model_path,      "m",
                                 "--json",  "--quiet", "--certificate", certificate_path};
  add_search_options(random, attack.model, words);
  words.insert(words.end(), attack.options.begin(), attack.options.end());
  return words;
}

Outcome attack_with(const Attack& attack, const Run& run) {
  const std::string model = run.folder + "/model.toml", certificate = run.folder + "/certificate";
  std::filesystem::remove(certificate);
  const std::string text = attack.model.text();
  std::ofstream(model, std::ios::binary) << (run.mutant == Mutant::kRounded ? rounded(text) : text);
  if (!attack.model.way.empty())
    std::ofstream(run.folder + "/way.csv", std::ios::binary) << attack.model.way;
  run.entering(Stage::kCheck, -1);
  const Answer answer = run_command(check_words(attack, model, certificate));
  Outcome outcome;
  outcome.exit_code = answer.exit_code;
  outcome.reason = reason_of(answer);
  outcome.check_seconds = answer.seconds;
  outcome.may_be_vacuous = warns_of_no_pose(answer);
  outcome.is_announced = warns_of_proof(answer);
  outcome.false_list = falsehood_of(attack, answer);
  if (run.mutant == Mutant::kFlipped) outcome.exit_code = falsified(answer.exit_code);
  if (run.verify && run.mutant == Mutant::kNone && std::filesystem::exists(certificate)) {
    run.entering(Stage::kVerify, outcome.exit_code);
    outcome.stage = Stage::kVerify;
    verify(attack, model, certificate, outcome);
  }
  return outcome;
}

}  // namespace regulus::detail::attack
