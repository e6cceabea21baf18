// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the whole command on hostile models and judges it by the known truth (README.md).
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <set>

#include "tests/attack/families/families.hpp"
#include "tests/attack/runner/progress.hpp"
#include "tests/attack/runner/summary.hpp"
#include "tests/attack/runner/workers.hpp"

namespace regulus::detail::attack {
namespace {

struct Options {
  std::uint64_t models = 1000, seed = 1, after = 0;
  std::vector<std::string> only;
  unsigned jobs = 2;
  double time_cap = 20;
  std::string json, show, mutant;
  bool run = false, shrink = false, list = false, fail_on_slow = false, no_verify = false;
  double least_verified = 0;
  std::size_t failures = 5;
};

std::vector<const Family*> chosen(const std::vector<std::string>& only) {
  std::vector<const Family*> result;
  for (const std::string& name : only) {
    const Family* family = find_family(name);
    if (family == nullptr) throw std::invalid_argument("no family " + name + "; see --list");
    result.push_back(family);
  }
  if (only.empty())
    for (const Family& family : families()) result.push_back(&family);
  return result;
}

Attack named(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw std::invalid_argument("expected FAMILY:SEED");
  return chosen({text.substr(0, colon)}).front()->make(std::stoull(text.substr(colon + 1)));
}

/// Prints the model, the command and the truth as a script that runs the command.
void show(const Attack& attack) {
  std::cout << "# " << attack.family << ":" << attack.seed << ", " << name(attack.truth) << ": "
            << attack.argument << '\n';
  for (const auto& [name, text] : attack.planted)
    std::cout << "# there: " << name << " = " << text << '\n';
  std::cout << "cat >model.toml <<'END'\n" << attack.model.text() << "END\n";
  std::string line;
  for (const std::string& word : check_words(attack, "model.toml", "certificate"))
    line += (line.empty() ? "" : " ") +
            (word.find_first_of("*()") == std::string::npos ? word : "'" + word + "'");
  std::cout << line << '\n';
}

Mutant mutant_named(const std::string& text) {
  return text == "flipped"   ? Mutant::kFlipped
         : text == "rounded" ? Mutant::kRounded
                             : Mutant::kNone;
}

/// Returns a seed; the seeds of different runs do not overlap.
std::uint64_t seed_of(const Options& options, std::uint64_t round) {
  return options.seed * 1'000'000'000 + round;
}

/// How many models, from the first one on, have outcomes; they come in any order.
class Begun {
 public:
  void add(std::uint64_t model) {
    later_.insert(model);
    while (later_.erase(count_) > 0) ++count_;
  }
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  std::uint64_t count_ = 0;
  std::set<std::uint64_t> later_;
};

Summary run(const Options& options, const std::vector<const Family*>& from) {
  Summary summary;
  Begun begun;
  const std::uint64_t left = options.models - std::min(options.after, options.models);
  std::optional<Progress> progress;
  progress.emplace(std::cerr, isatty(STDERR_FILENO) != 0, left);
  Job job;
  job.count = left;
  job.make = [&](std::uint64_t i) {
    i += options.after;
    return from[i % from.size()]->make(seed_of(options, i / from.size()));
  };
  job.done = [&](std::uint64_t i, const Outcome& outcome) {
    begun.add(i);
    summary.add(job.make(i), outcome);
    progress->update(summary);
  };
  job.processes = options.jobs;
  job.limits.seconds = options.time_cap;
  job.mutant = mutant_named(options.mutant);
  job.verify = !options.no_verify;
  const bool complete = run_all(job);
  progress.reset();
  if (!complete)
    std::cout << "stopped by a signal: what follows is a part; the rest is that of --after "
              << options.after + begun.count() << '\n';
  return summary;
}

/// Checks that each family notices a falsified verdict, or some family falsified numbers.
bool noticed(const Options& options, const Summary& summary) {
  bool all = true, any = false;
  for (const auto& [name, count] : summary.families()) {
    const auto found = count.judgements.find(Judgement::kContradiction);
    const bool here = found != count.judgements.end() && found->second > 0;
    if (!here && options.mutant == "flipped") std::cout << "not noticed in " << name << '\n';
    all = all && here;
    any = any || here;
  }
  return options.mutant == "flipped" ? all : any;
}

int report(const Options& options, const Summary& summary) {
  std::cout << summary.table();
  if (!options.json.empty()) std::ofstream(options.json) << summary.json() << '\n';
  if (!options.mutant.empty()) return noticed(options, summary) ? 0 : 1;
  std::cout << summary.failure_lines("attack", options.failures);
  const bool slow = options.fail_on_slow && summary.slow() > 0;
  const bool unverified = summary.verified_percent() < options.least_verified;
  if (unverified) std::cout << "fewer than " << options.least_verified << " % are VERIFIED\n";
  return summary.failed() || slow || unverified ? 1 : 0;
}

/// Runs one model and prints everything known about the outcome.
int run_one(const Options& options) {
  const Attack attack = named(options.show);
  Summary summary;
  Job job;
  job.count = 1;
  job.processes = 1;
  job.limits.seconds = options.time_cap;
  job.mutant = mutant_named(options.mutant);
  job.make = [&](std::uint64_t) { return attack; };
  job.done = [&](std::uint64_t, const Outcome& o) {
    summary.add(attack, o);
    std::cout << "check   " << verdict_text(o.exit_code) << " (" << o.reason << "), "
              << o.check_seconds << " s\n"
              << "proof   " << name(o.proof) << " (" << o.proof_reason << "), " << o.verify_seconds
              << " s\n"
              << "truth   " << name(attack.truth) << ": " << attack.argument << '\n';
  };
  return !run_all(job) || summary.failed() ? 1 : 0;
}

/// Returns how the one model of a summary fails; empty if it does not fail.
std::string kind_of_failure(const Summary& summary) {
  return summary.failures().empty() ? "" : summary.failures().front().what;
}

/// Shows the shortest model of the same family that fails in the same way.
int shrink(const Options& options) {
  constexpr std::uint64_t kTried = 500;
  const Attack given = named(options.show);
  const Family* family = find_family(given.family);
  Attack shortest = given;
  Job job;
  job.count = kTried;
  job.processes = options.jobs;
  job.limits.seconds = options.time_cap;
  job.make = [&](std::uint64_t i) { return i == 0 ? given : family->make(i); };
  std::map<std::uint64_t, std::string> kinds;
  job.done = [&](std::uint64_t i, const Outcome& outcome) {
    Summary one;
    one.add(job.make(i), outcome);
    kinds[i] = kind_of_failure(one);
  };
  if (!run_all(job) || kinds[0].empty()) {
    std::cout << "# it does not fail\n";
    return 0;
  }
  for (const auto& [i, kind] : kinds) {
    if (kind != kinds[0]) continue;
    Attack other = job.make(i);
    if (other.model.text().size() < shortest.model.text().size()) shortest = std::move(other);
  }
  std::cout << "# " << kinds[0] << ", as " << options.show << '\n';
  show(shortest);
  return 1;
}

int main_of(const Options& options) {
  if (options.list) {
    for (const Family& family : families())
      std::cout << family.name << std::string(20 - std::string(family.name).size(), ' ')
                << family.description << '\n';
    return 0;
  }
  if (!options.show.empty()) {
    if (options.run) return run_one(options);
    if (options.shrink) return shrink(options);
    show(named(options.show));
    return 0;
  }
  return report(options, run(options, chosen(options.only)));
}

}  // namespace
}  // namespace regulus::detail::attack

int main(int argc, char** argv) try {
  regulus::detail::attack::Options options;
  CLI::App app{"Attacks the command with hostile models and judges its answers"};
  app.add_option("--models", options.models, "How many models, over all families");
  app.add_option("--after", options.after, "Leave out so many, which another part of the run has");
  app.add_option("--seed", options.seed, "Of the run")->check(CLI::Range(0, 1'000'000'000));
  app.add_option("--family", options.only, "Only these; see --list")->delimiter(',');
  app.add_option("--jobs", options.jobs, "Processes")->check(CLI::Range(1, 256));
  app.add_option("--time-cap", options.time_cap, "Seconds of processor time for each model");
  app.add_option("--json", options.json, "Write the summary to FILE");
  app.add_option("--show", options.show, "FAMILY:SEED: print the model and the command");
  app.add_flag("--run", options.run, "With --show: run it");
  app.add_flag("--shrink", options.shrink,
               "With --show: the shortest of 500 models of the family that fails in the same way");
  app.add_option("--mutant", options.mutant, "Falsify verdicts or numbers; fails if unnoticed")
      ->check(CLI::IsMember({"flipped", "rounded"}));
  app.add_option("--failures", options.failures, "Most lines for each kind of failure and family");
  app.add_option("--least-verified", options.least_verified, "Percent of the proofs");
  app.add_flag("--fail-on-slow", options.fail_on_slow, "A model above the limit is a failure");
  app.add_flag("--no-verify", options.no_verify, "Leave out the proofs");
  app.add_flag("--list", options.list, "The families");
  CLI11_PARSE(app, argc, argv);
  return regulus::detail::attack::main_of(options);
} catch (const std::exception& error) {
  std::cerr << "attack: " << error.what() << '\n';
  return 64;
}
