// SPDX-License-Identifier: GPL-3.0-or-later
// Forges certificates: a genuine one is changed and its model kept, or the reverse, or the way-points. The verifier with
// --model may call none of them VERIFIED, unless the change asks the same question (README.md).
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/attack/forge/bundle.hpp"
#include "tests/attack/forge/changes.hpp"
#include "tests/attack/forge/genuine.hpp"
#include "tests/attack/forge/same_question.hpp"
#include "tests/attack/forge/touched.hpp"

namespace regulus::detail::attack {
namespace {

struct Options {
  std::uint64_t forgeries = 1000, seed = 1;
  std::string only, json, show, format;
  std::size_t failures = 20;
  bool is_told_at_once = false;
};

constexpr int kChangesEach = 2000;

struct Genuine {
  const Base* base;
  std::string model, certificate;
  verifier::Verification answer;
};

struct Counts {
  std::uint64_t rejected = 0, unfinished = 0, same = 0, forged = 0, broken = 0;
  /// VERIFIED, where the command refuses the file: another part of it may be at fault.
  std::uint64_t refused = 0;
};

enum class Part { kCertificate, kModel, kWaypoints };

const char* name(Part part) {
  return part == Part::kCertificate ? "certificate " : part == Part::kModel ? "model " : "way ";
}

/// A changed certificate, model or file of way-points, and what became of it.
struct Forgery {
  Part part = Part::kModel;
  Change change;
  std::string why;  ///< VERIFIED: how the questions differ; empty if they are the same
};

class Folder {
 public:
  Folder() : path_((std::filesystem::temp_directory_path() / "forge-XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) throw std::runtime_error("no temporary folder");
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

class Run {
 public:
  explicit Run(const Options& options) : options_(options) {
    for (const Base& base : bases())
      if (options.only.empty() || options.only == base.name) prepare(base);
    if (genuine_.empty()) throw std::runtime_error("no base has the name " + options.only);
  }

  void run() {
    for (std::uint64_t i = 0; i < options_.forgeries; ++i) try_one(i);
  }

  /// Returns the exit code.
  int report() const {
    std::cout << "base                   rejected unfinished       same    refused     FORGED     "
                 "BROKEN   "
                 "genuine\n";
    nlohmann::ordered_json json;
    Counts all;
    for (const Genuine& g : genuine_) {
      const Counts c = count(g);
      print(g.base->name, c, verifier::name(g.answer.outcome));
      json[g.base->name] = {{"rejected", c.rejected},
                            {"unfinished", c.unfinished},
                            {"same", c.same},
                            {"forged", c.forged},
                            {"broken", c.broken},
                            {"refused", c.refused},
                            {"genuine", verifier::name(g.answer.outcome)}};
      all.rejected += c.rejected, all.unfinished += c.unfinished, all.same += c.same;
      all.forged += c.forged, all.broken += c.broken, all.refused += c.refused;
    }
    print("all", all, "");
    for (const Genuine& g : genuine_)
      if (g.answer.outcome != verifier::Outcome::kVerified)
        std::cout << "genuine " << g.base->name << ": " << g.answer.reason << '\n';
    for (const auto* list : {&failures_, &refused_})
      for (const std::string& line : *list) std::cout << line << '\n';
    if (!options_.json.empty()) std::ofstream(options_.json) << json.dump(2) << '\n';
    const bool all_verified = std::all_of(genuine_.begin(), genuine_.end(), [](const Genuine& g) {
      return g.answer.outcome == verifier::Outcome::kVerified;
    });
    return all.forged + all.broken == 0 && all_verified ? 0 : 1;
  }

  /// Returns 1, and prints the words, if changes leave lines alone that the page has, or that a base
  /// has, or if no base has a verdict of the page.
  int find_untouched(const std::string& path) const {
    std::ostringstream page;
    page << std::ifstream(path).rdbuf();
    std::set<std::string> words = words_of_format(page.str()),
                          verdicts = verdicts_of_format(page.str());
    if (words.size() < 40 || verdicts.size() < 8)
      throw std::runtime_error(path + " has no tables of lines");
    std::size_t count = 0;
    const auto tell = [&count](const std::string& sentence) {
      ++count;
      std::cout << sentence << '\n';
    };
    for (const Genuine& g : genuine_) {
      std::set<std::string> own = words_of_question(g.certificate);
      verdicts.erase(verdict_of(g.certificate));
      for (int i = 0; i < kChangesEach; ++i) {
        Random random(g.base->name, std::uint64_t(i));
        const Change change = change_certificate(g.certificate, random);
        for (const std::string& word : words_touched(g.certificate, change.text))
          words.erase(word), own.erase(word);
      }
      for (const std::string& word : own)
        tell("no forgery of " + std::string(g.base->name) + " changes a line " + word);
    }
    for (const std::string& word : words) tell("no forgery changes a line " + word);
    for (const std::string& verdict : verdicts) tell("no base has the verdict " + verdict);
    return count == 0 ? 0 : 1;
  }

  /// Prints the files of one forgery into the working folder.
  void show(std::uint64_t number) const {
    const Genuine& g = of(number);
    const Forgery forgery = made(number);
    std::ofstream("forged.model.toml") << model_in(g, forgery);
    std::ofstream("forged.certificate") << certificate_in(g, forgery);
    const Base base = base_of(g, forgery);
    if (has_waypoints(base)) std::ofstream(base.waypoints_name) << base.waypoints;
    std::cout << g.base->name << ", " << name(forgery.part) << forgery.change.what
              << "\nwritten: forged.model.toml, forged.certificate " << base.waypoints_name << '\n';
  }

 private:
  void prepare(const Base& base) {
    const std::string model = model_of(base);
    auto certificate = answer_about(base, model, folder_.path()).certificate;
    if (!certificate) throw std::runtime_error(std::string("no certificate of ") + base.name);
    // The sum of the file would refuse each change of it, whatever else is compared.
    const std::size_t sum = certificate->find("\nsha256 ") + 8;
    certificate->replace(sum, certificate->find('\n', sum) - sum, "-");
    if (is_in_shards(*certificate)) certificate = signed_again(*certificate);
    // The search may have read another file of way-points: it is written again.
    genuine_.push_back({&base, model, *certificate, {}});
    genuine_.back().answer = verify_about(base, *certificate, model, folder_.path());
  }

  [[nodiscard]] const Genuine& of(std::uint64_t number) const {
    return genuine_[number % genuine_.size()];
  }

  [[nodiscard]] Forgery made(std::uint64_t number) const {
    const Genuine& g = of(number);
    Random random(g.base->name, options_.seed * 1'000'000'000 + number);
    Forgery forgery;
    forgery.part = has_waypoints(*g.base) && random.one_in(3) ? Part::kWaypoints
                   : random.one_in(2)                         ? Part::kCertificate
                                                              : Part::kModel;
    forgery.change = forgery.part == Part::kCertificate ? change_certificate(g.certificate, random)
                     : forgery.part == Part::kModel     ? change_model(g.model, random)
                                                    : change_waypoints(g.base->waypoints, random);
    // Without it, the sums of the shards refuse each change of them.
    if (forgery.part == Part::kCertificate && is_in_shards(g.certificate) && !random.one_in(4))
      forgery.change.text = signed_again(forgery.change.text);
    return forgery;
  }

  void try_one(std::uint64_t number) {
    const Genuine& g = of(number);
    Counts& counts = counts_[g.base->name];
    const Forgery forgery = made(number);
    try {
      const Base base = base_of(g, forgery);
      write_waypoints(base);
      const verifier::Verification v =
          verify_about(base, certificate_in(g, forgery), model_in(g, forgery), folder_.path());
      if (v.outcome == verifier::Outcome::kRejected) ++counts.rejected;
      if (v.outcome == verifier::Outcome::kUnfinished) ++counts.unfinished;
      if (v.outcome == verifier::Outcome::kVerified) judge(g, forgery, number, counts);
    } catch (const std::exception& error) {
      ++counts.broken;
      fail(number, g, forgery, error.what());
    }
  }

  static bool has_waypoints(const Base& base) { return *base.waypoints != '\0'; }

  static const std::string& certificate_in(const Genuine& g, const Forgery& forgery) {
    return forgery.part == Part::kCertificate ? forgery.change.text : g.certificate;
  }
  static const std::string& model_in(const Genuine& g, const Forgery& forgery) {
    return forgery.part == Part::kModel ? forgery.change.text : g.model;
  }
  /// The result refers to the forgery.
  static Base base_of(const Genuine& g, const Forgery& forgery) {
    Base base = *g.base;
    if (forgery.part == Part::kWaypoints) base.waypoints = forgery.change.text.c_str();
    return base;
  }

  void write_waypoints(const Base& base) const {
    if (!has_waypoints(base)) return;
    std::ofstream(folder_.path() + '/' + base.waypoints_name, std::ios::binary) << base.waypoints;
  }

  /// The verifier is told of these options.
  static SetByOptions set_by_options(const Base& base) {
    const auto has = [&](const char* option) {
      return std::find(base.words.begin(), base.words.end(), option) != base.words.end();
    };
    return {.tolerances = has("--tolerance"), .alpha = has("--alpha")};
  }

  /// A change that leaves the question the same may be VERIFIED.
  void judge(const Genuine& g, const Forgery& forgery, std::uint64_t number, Counts& counts) {
    std::string why;
    const SetByOptions any = set_by_options(*g.base);
    if (forgery.part == Part::kCertificate) {
      why = difference(forgery.change.text, g.certificate, any);
    } else if (!are_equal_files(model_in(g, forgery), g.model) ||
               forgery.part == Part::kWaypoints) {
      const Answer other = answer_about(base_of(g, forgery), model_in(g, forgery), folder_.path());
      if (other.is_refused) {
        ++counts.refused;
        return note(refused_, number, g, forgery, "the command refuses that file");
      }
      why = other.certificate ? difference(g.certificate, *other.certificate, any)
                              : "the command proves nothing of that file";
    }
    if (why.empty()) {
      ++counts.same;
      return;
    }
    ++counts.forged;
    fail(number, g, forgery, why);
  }

  void fail(std::uint64_t number, const Genuine& g, const Forgery& forgery,
            const std::string& why) {
    note(failures_, number, g, forgery, "FORGED, " + why);
  }

  void note(std::vector<std::string>& list, std::uint64_t number, const Genuine& g,
            const Forgery& forgery, const std::string& why) const {
    if (list.size() == options_.failures) return;
    list.push_back(std::to_string(number) + ", " + g.base->name + ", " + name(forgery.part) +
                   forgery.change.what + ": " + why);
    if (options_.is_told_at_once) std::cerr << list.back() << std::endl;
  }

  [[nodiscard]] Counts count(const Genuine& g) const {
    const auto found = counts_.find(g.base->name);
    return found == counts_.end() ? Counts{} : found->second;
  }

  static void print(const std::string& name, const Counts& c, const char* genuine) {
    std::printf("%-20s", name.c_str());
    for (const std::uint64_t n : {c.rejected, c.unfinished, c.same, c.refused, c.forged, c.broken})
      std::printf(" %10llu", static_cast<unsigned long long>(n));
    std::printf("   %s\n", genuine);
    std::fflush(stdout);
  }

  const Options& options_;
  const Folder folder_;
  std::vector<Genuine> genuine_;
  std::map<std::string, Counts> counts_;
  std::vector<std::string> failures_, refused_;
};

}  // namespace
}  // namespace regulus::detail::attack

int main(int argc, char** argv) try {
  regulus::detail::attack::Options options;
  CLI::App app{"Forges certificates and models; none may be VERIFIED"};
  app.add_option("--forgeries", options.forgeries, "How many, over all bases");
  app.add_option("--seed", options.seed, "Of the run")->check(CLI::Range(0, 1'000'000'000));
  app.add_option("--base", options.only, "Only this base");
  app.add_option("--json", options.json, "Write the counts to FILE");
  app.add_option("--show", options.show, "NUMBER: write the files of one forgery");
  app.add_option("--lines-of", options.format,
                 "FORMAT.md: also name the lines that no change of a certificate touches");
  app.add_option("--failures", options.failures, "Most lines about failures");
  app.add_flag("--at-once", options.is_told_at_once, "Also tell each failure when it is found");
  CLI11_PARSE(app, argc, argv);
  regulus::detail::attack::Run run(options);
  if (!options.show.empty()) {
    run.show(std::stoull(options.show));
    return 0;
  }
  const int untouched = options.format.empty() ? 0 : run.find_untouched(options.format);
  run.run();
  return std::max(untouched, run.report());
} catch (const std::exception& error) {
  std::cerr << "forge: " << error.what() << '\n';
  return 64;
}
