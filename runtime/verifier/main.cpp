// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <charconv>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

#include "runtime/files/atomic_file.hpp"
#include "runtime/formal/coq_proof.hpp"
#include "runtime/formal/coq_theorem.hpp"
#include "runtime/formal/coqc.hpp"
#include "runtime/verifier/expression.hpp"
#include "runtime/verifier/input_file.hpp"
#include "runtime/verifier/verify.hpp"

namespace {

using regulus::verifier::Options;
using regulus::verifier::Outcome;
using regulus::verifier::Verification;

constexpr int kUsageError = 64, kFileError = 74;
constexpr unsigned kMostThreads = 1024;
constexpr std::size_t kMaxModelBytes = std::size_t{1} << 22;
constexpr std::size_t kMaxTheoremBytes = std::size_t{1} << 28;

constexpr const char* kHelp =
    "usage: regulus-verify [options] CERTIFICATE\n"
    "\n"
    "Proves the claim of a certificate anew. The answer is the line on standard\n"
    "output:\n"
    "  VERIFIED    the claim is true                                     (exit 0)\n"
    "  REJECTED    not a certificate, incomplete, or false               (exit 1)\n"
    "  UNFINISHED  neither could be shown within the bounds below        (exit 2)\n"
    "Standard error says what was checked, and why the claim is not verified.\n"
    "If CERTIFICATE is the index of a proof in shards, they are in\n"
    "CERTIFICATE.shards.\n"
    "Other exit codes: 64 usage, 74 a file cannot be read or written.\n"
    "\n"
    "  --model FILE     the question must also be that of this model file, line by\n"
    "                   line; UNFINISHED if a line cannot be compared\n"
    "  --waypoints FILE with --model: the table of way-points that check --waypoints\n"
    "                   took\n"
    "  --allow-options  allow ranges, tolerances and alpha to differ from that file,\n"
    "                   because options of regulus change them; list the differences\n"
    "  --time-limit S   stop after S seconds; the answer is then UNFINISHED\n"
    "  --threads N      prove leaves by N threads (default 1); the answer is the same\n"
    "  --max-boxes N    evaluate at most N boxes for all leaves together (default\n"
    "                   4194304)\n"
    "  --coq FILE       do not prove the claim, but write it as a theorem that Coq\n"
    "                   proves: coqc -Q FOLDER Regulus FILE\n"
    "                   (runtime/formal/FORMAL.md). With --model, the file also has a\n"
    "                   theorem about the robot of the model file, if that has the\n"
    "                   table [gough], [serial] or [matrix], or [legs] with legs of\n"
    "                   variable length; otherwise nothing is written\n"
    "  --force          with --coq or --theorem: the certificate is that of a bound\n"
    "                   of a force, also if it is of an earlier version and does not\n"
    "                   say so\n"
    "  --theorem        let Coq prove the claim: write the file CERTIFICATE.v, or\n"
    "                   that of --coq, run coqc, and audit what it proved. With\n"
    "                   --model the claim is verified first. The answer is PROVED,\n"
    "                   REJECTED or UNFINISHED, with the exit codes above\n"
    "  --audit          CERTIFICATE is a theorem file of any origin: let Coq prove it\n"
    "                   if it is as plain as those of --coq. PROVED: it states what\n"
    "                   it shows, and is true\n"
    "  --library FOLDER the compiled library of theorems; otherwise that in\n"
    "                   REGULUS_FORMAL, or beside this program\n"
    "  --quiet          print only the answer\n"
    "  --help           print this text\n";

struct Usage {
  std::string certificate, model, coq, library;
  Options options;
  bool help = false, quiet = false, is_force = false, is_theorem = false, is_audit = false;
  std::string mistake;  ///< about a word that is not understood
};

/// This program does not know the names of installed models.
std::string read_model_file(const std::string& name) try {
  return regulus::verifier::read_text(name, kMaxModelBytes);
} catch (const std::runtime_error& error) {
  if (name.find_first_of("./") != std::string::npos) throw;
  throw std::runtime_error(std::string(error.what()) +
                           "; give the path of the model file, which `regulus list " + name +
                           "` shows if that model is installed");
}

template <class Number>
bool read_number(const std::string& text, Number& value) {
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  return error == std::errc() && end == last && value > 0;
}

/// Returns what is wrong with a word that is not understood.
std::string mistake_in(const std::string& word, const std::string& next) {
  const auto expected = [&](const std::string& number) {
    return word + ": found '" + next + "', expected " + number;
  };
  if (word == "--time-limit") return expected("a number of seconds above 0");
  if (word == "--threads")
    return expected("a whole number from 1 to " + std::to_string(kMostThreads));
  if (word == "--max-boxes") return expected("a whole number from 1 on");
  return word.starts_with("-") ? "'" + word + "' is no option, or lacks its value"
                               : "'" + word + "' is a second certificate";
}

/// Returns false, with the mistake, if options exclude or need each other.
bool fits_together(Usage& usage) {
  if (usage.is_audit &&
      (usage.is_theorem || usage.is_force || !usage.coq.empty() || !usage.model.empty()))
    usage.mistake =
        "--audit reads a theorem file alone: --theorem, --coq, --force and --model are "
        "for certificates";
  else if (!usage.library.empty() && !usage.is_audit && !usage.is_theorem)
    usage.mistake = "--library is for --theorem and --audit";
  else if (usage.is_force && usage.coq.empty() && !usage.is_theorem)
    usage.mistake = "--force is for --coq and --theorem";
  return usage.mistake.empty();
}

/// Returns false if the words are not understood.
bool read_usage(const std::vector<std::string>& words, Usage& usage) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const std::string next = i + 1 < words.size() ? words[i + 1] : "";
    if (word == "--help" || word == "-h") {
      usage.help = true;
    } else if (word == "--quiet") {
      usage.quiet = true;
    } else if (word == "--force") {
      usage.is_force = true;
    } else if (word == "--theorem") {
      usage.is_theorem = true;
    } else if (word == "--audit") {
      usage.is_audit = true;
    } else if (word == "--allow-options") {
      usage.options.all_overridden = true;
    } else if (word == "--model" && !next.empty()) {
      usage.model = words[++i];
    } else if (word == "--waypoints" && !next.empty()) {
      usage.options.waypoints = words[++i];
    } else if (word == "--library" && !next.empty()) {
      usage.library = words[++i];
    } else if (word == "--coq" && !next.empty()) {
      usage.coq = words[++i];
    } else if (word == "--time-limit" && read_number(next, usage.options.time_limit)) {
      ++i;
    } else if (word == "--threads" && read_number(next, usage.options.threads) &&
               usage.options.threads <= kMostThreads) {
      ++i;
    } else if (word == "--max-boxes" && read_number(next, usage.options.max_boxes)) {
      ++i;
    } else if (!word.starts_with("-") && usage.certificate.empty()) {
      usage.certificate = word;
    } else {
      usage.mistake = mistake_in(word, next);
      return false;
    }
  }
  return usage.help || (!usage.certificate.empty() && fits_together(usage));
}

/// Writes one line over the previous one, on a terminal only.
void show_progress(const Verification& v) {
  std::cerr << "\r\033[K" << v.leaves << " leaves, " << v.boxes << " boxes" << std::flush;
}

Verification verify(std::istream& file, const Usage& usage) try {
  return regulus::verifier::verify(file, usage.options);
} catch (const std::runtime_error& error) {
  throw std::runtime_error(usage.certificate + ": " + error.what());
}

/// Verifies the claim, and says on standard error what was checked.
Verification verify_and_describe(Usage& usage) {
  regulus::verifier::InputFile bytes(usage.certificate);
  std::istream file(&bytes);
  usage.options.path = usage.certificate;
  if (!usage.model.empty()) {
    usage.options.model_text = read_model_file(usage.model);
    usage.options.model_name = usage.model;
  }
  const bool is_terminal = !usage.quiet && isatty(STDERR_FILENO) != 0;
  if (is_terminal) usage.options.progress = show_progress;
  Verification v = verify(file, usage);
  if (is_terminal) std::cerr << "\r\033[K";
  if (!usage.quiet) std::cerr << regulus::verifier::describe(v);
  return v;
}

int verify(Usage& usage) {
  const Verification v = verify_and_describe(usage);
  std::cout << regulus::verifier::name(v.outcome) << '\n';
  return static_cast<int>(v.outcome);
}

/// Without a text, throws what would be thrown after a long proof: there is no such folder.
void write_file(const std::string& name, const std::string* text) try {
  regulus::detail::AtomicFile output(name);
  if (text == nullptr) return;
  output.write(*text);
  output.put_in_place();
} catch (const std::system_error& error) {
  throw std::runtime_error("the file '" + name + "' cannot " + error.what());
}

/// Returns the text of the file, without the theorem about the robot of the model file.
std::string theorem_of(const Usage& usage, regulus::verifier::CoqRobot& robot) {
  regulus::verifier::InputFile bytes(usage.certificate);
  std::istream file(&bytes);
  const auto statement = usage.is_force ? regulus::verifier::CoqStatement::kForce
                                        : regulus::verifier::CoqStatement::kClaim;
  if (usage.model.empty()) return regulus::verifier::coq_proof(file, statement);
  const std::string model = read_model_file(usage.model);
  const regulus::verifier::CoqModel read{regulus::verifier::read_model_values(model),
                                         usage.options.all_overridden};
  return regulus::verifier::coq_proof(file, statement, read, robot);
}

/// Calls `act`. Returns the exit code: that of the answer if there is no theorem.
template <class Act>
int unless_refused(const Usage& usage, Act act) {
  const auto refuse = [&usage](Outcome outcome, const std::exception& why) {
    std::cerr << "regulus-verify: " << usage.certificate << ": " << why.what() << '\n';
    if (usage.is_theorem || usage.is_audit) std::cout << regulus::verifier::name(outcome) << '\n';
    return static_cast<int>(outcome);
  };
  try {
    act();
    return 0;
  } catch (const regulus::verifier::Rejection& why) {
    return refuse(Outcome::kRejected, why);
  } catch (const regulus::verifier::Unfinished& why) {
    return refuse(Outcome::kUnfinished, why);
  } catch (const regulus::verifier::CoqTimeout& why) {
    return refuse(Outcome::kUnfinished, why);
  }
}

int write_coq(const Usage& usage) {
  return unless_refused(usage, [&] {
    regulus::verifier::CoqRobot robot;
    const std::string text = theorem_of(usage, robot);
    if (!robot.reason.empty()) throw regulus::verifier::Unfinished(robot.reason);
    const std::string all = text + robot.text;
    write_file(usage.coq, &all);
  });
}

/// Coq, and not this program, says that it is true.
void prove(const Usage& usage, const std::string& text) {
  const auto theorem =
      regulus::verifier::prove_by_coq(text, usage.library, usage.options.time_limit);
  if (!usage.quiet)
    for (const std::string& statement : theorem.statements)
      std::cerr << "theorem    " << statement << '\n';
  if (!usage.quiet && theorem.may_be_empty)
    std::cerr << "note       nothing in the file says that the_set has a point\n";
  std::cout << "PROVED\n";
}

int audit(const Usage& usage) {
  const std::string text = regulus::verifier::read_text(usage.certificate, kMaxTheoremBytes);
  return unless_refused(usage, [&] { prove(usage, text); });
}

/// Writes the file, and lets Coq prove it.
void write_and_prove(const Usage& usage, const std::string& file, const std::string& text) {
  write_file(file, &text);
  if (!usage.quiet) std::cerr << "file       " << file << '\n';
  prove(usage, text);
}

/// The verifier has compared the claim with the model file. If Coq cannot, the claim alone is left.
void prove_with_robot(const Usage& usage, const std::string& file) {
  regulus::verifier::CoqRobot robot;
  const std::string text = theorem_of(usage, robot);
  if (!robot.text.empty()) try {
      return write_and_prove(usage, file, text + robot.text);
    } catch (const regulus::verifier::Rejection& why) {
      robot.reason = why.what();
    }
  if (!usage.quiet && !robot.reason.empty()) std::cerr << "geometry   " << robot.reason << '\n';
  write_and_prove(usage, file, text);
}

int prove_theorem(Usage& usage) {
  const std::string file = usage.coq.empty() ? usage.certificate + ".v" : usage.coq;
  write_file(file, nullptr);
  if (!usage.model.empty()) {
    const Verification v = verify_and_describe(usage);
    if (v.outcome != Outcome::kVerified) {
      std::cout << regulus::verifier::name(v.outcome) << '\n';
      return static_cast<int>(v.outcome);
    }
  }
  return unless_refused(usage, [&] { prove_with_robot(usage, file); });
}

int answer(Usage& usage) {
  if (usage.is_audit) return audit(usage);
  if (usage.is_theorem) return prove_theorem(usage);
  return usage.coq.empty() ? verify(usage) : write_coq(usage);
}

}  // namespace

int main(int argc, char** argv) {
  Usage usage;
  if (!read_usage({argv + 1, argv + argc}, usage)) {
    if (!usage.mistake.empty())
      std::cerr << "regulus-verify: " << usage.mistake << "; --help lists the options\n";
    else
      std::cerr << kHelp;
    return kUsageError;
  }
  if (usage.help) {
    std::cout << kHelp;
    return 0;
  }
  try {
    return answer(usage);
  } catch (const std::exception& error) {
    std::cerr << "regulus-verify: " << error.what() << '\n';
    return kFileError;
  }
}
