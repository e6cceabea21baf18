// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/runner/summary.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace regulus::detail::attack {
namespace {

template <class Key>
std::uint64_t of(const std::map<Key, std::uint64_t>& counts, Key key) {
  const auto found = counts.find(key);
  return found == counts.end() ? 0 : found->second;
}

std::uint64_t refusals(const FamilyCount& c) { return of(c.exits, 64) + of(c.exits, 65); }

/// Removes numbers: reasons that differ only in their numbers count as one.
std::string without_numbers(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool digit = '0' <= c && c <= '9';
    if (!digit)
      result += c;
    else if (result.empty() || result.back() != '#')
      result += '#';
  }
  return result.substr(0, 160);
}

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text.substr(0, 200);
}

std::uint64_t models(const FamilyCount& c) {
  std::uint64_t sum = 0;
  for (const auto& [truth, count] : c.truths) sum += count;
  return sum;
}

std::string row(const std::string& name, const FamilyCount& c) {
  const std::uint64_t undefined =
      of(c.truths, Truth::kUndefined) + of(c.truths, Truth::kUndefinedOrSingular);
  return fmt::format(
      "{:18}{:7}|{:6}{:6}{:6}{:6}|{:6}{:6}{:6}{:6}|{:6}{:6}{:6}{:6}|{:6}{:6}{:6}{:6}{:6}|{:8.1f}{:"
      "7.2f}"
      "\n",
      name, models(c), of(c.truths, Truth::kSingular), of(c.truths, Truth::kRegular), undefined,
      of(c.truths, Truth::kEmpty) + of(c.truths, Truth::kRefused), of(c.exits, 0), of(c.exits, 1),
      of(c.exits, 2), refusals(c), of(c.judgements, Judgement::kMissed),
      of(c.judgements, Judgement::kContradiction), of(c.judgements, Judgement::kCrash),
      of(c.judgements, Judgement::kSlow) + c.slow_proofs, of(c.proofs, Proof::kVerified),
      of(c.proofs, Proof::kUnfinished) - c.announced, c.announced, of(c.proofs, Proof::kRejected),
      of(c.proofs, Proof::kBroken), c.seconds, c.slowest);
}

void add_to(FamilyCount& sum, const FamilyCount& c) {
  for (const auto& [key, n] : c.truths) sum.truths[key] += n;
  for (const auto& [key, n] : c.exits) sum.exits[key] += n;
  for (const auto& [key, n] : c.judgements) sum.judgements[key] += n;
  for (const auto& [key, n] : c.proofs) sum.proofs[key] += n;
  sum.announced += c.announced;
  sum.slow_proofs += c.slow_proofs;
  sum.seconds += c.seconds;
  sum.slowest = std::max(sum.slowest, c.slowest);
}

nlohmann::ordered_json json_of(const FamilyCount& c) {
  nlohmann::ordered_json j = {{"models", models(c)}};
  for (const auto& [truth, n] : c.truths) j["truth"][name(truth)] = n;
  for (const auto& [code, n] : c.exits) j["verdicts"][verdict_text(code)] = n;
  for (const auto& [judgement, n] : c.judgements) j["judgements"][name(judgement)] = n;
  for (const auto& [proof, n] : c.proofs) j["proofs"][name(proof)] = n;
  j["announced"] = c.announced;
  j["slow_proofs"] = c.slow_proofs;
  j["seconds"] = c.seconds;
  j["slowest"] = {{"seconds", c.slowest}, {"seed", c.slowest_seed}};
  return j;
}

}  // namespace

void Summary::note(const std::string& what, const Attack& attack, const std::string& detail) {
  failures_.push_back({what, attack.family, attack.seed, one_line(detail)});
}

void Summary::add(const Attack& attack, const Outcome& outcome) {
  FamilyCount& count = families_[attack.family];
  ++count.truths[attack.truth];
  if (outcome.exit_code >= 0) ++count.exits[outcome.exit_code];
  const Judgement judgement = judge(attack, outcome);
  ++count.judgements[judgement];
  if (judgement == Judgement::kContradiction || judgement == Judgement::kCrash ||
      judgement == Judgement::kSlow)
    note(name(judgement), attack,
         verdict_text(outcome.exit_code) + " where it is " + name(attack.truth) + " (" +
             attack.argument +
             "): " + (outcome.false_list.empty() ? outcome.reason : outcome.false_list));
  if (outcome.ending == Ending::kSlow && outcome.stage == Stage::kVerify) {
    ++count.slow_proofs;
    note("SLOW PROOF", attack, outcome.reason);
  } else if (outcome.proof != Proof::kNone) {
    ++count.proofs[outcome.proof];
    if (proof_failed(outcome)) note(name(outcome.proof), attack, outcome.proof_reason);
    if (outcome.proof == Proof::kUnfinished) add_unfinished(attack, outcome);
  }
  const double seconds = outcome.check_seconds + outcome.verify_seconds;
  count.seconds += seconds;
  if (seconds > count.slowest) {
    count.slowest = seconds;
    count.slowest_seed = attack.seed;
  }
}

void Summary::add_unfinished(const Attack& attack, const Outcome& outcome) {
  families_[attack.family].announced += outcome.is_announced ? 1 : 0;
  ++unfinished_[without_numbers(outcome.proof_reason)];
  note(outcome.is_announced ? "UNFINISHED, announced" : "UNFINISHED", attack, outcome.proof_reason);
}

std::uint64_t Summary::count(Judgement judgement) const {
  std::uint64_t sum = 0;
  for (const auto& [name, c] : families_) sum += of(c.judgements, judgement);
  return sum;
}

std::uint64_t Summary::count(Proof proof) const {
  std::uint64_t sum = 0;
  for (const auto& [name, c] : families_) sum += of(c.proofs, proof);
  return sum;
}

std::uint64_t Summary::models() const {
  std::uint64_t sum = 0;
  for (const auto& [name, c] : families_) sum += attack::models(c);
  return sum;
}

std::uint64_t Summary::slow() const {
  std::uint64_t sum = count(Judgement::kSlow);
  for (const auto& [name, c] : families_) sum += c.slow_proofs;
  return sum;
}

std::uint64_t Summary::unannounced() const {
  std::uint64_t sum = count(Proof::kUnfinished);
  for (const auto& [name, c] : families_) sum -= c.announced;
  return sum;
}

double Summary::verified_percent() const {
  std::uint64_t all = 0;
  for (const Proof p : {Proof::kVerified, Proof::kUnfinished, Proof::kRejected, Proof::kBroken})
    all += count(p);
  for (const auto& [name, c] : families_) all += c.slow_proofs;
  return all == 0 ? 100
                  : 100 * static_cast<double>(count(Proof::kVerified)) / static_cast<double>(all);
}

bool Summary::failed() const {
  return count(Judgement::kContradiction) + count(Judgement::kCrash) + count(Proof::kRejected) +
             count(Proof::kBroken) >
         0;
}

std::string Summary::table() const {
  std::string text = fmt::format(
      "{:18}{:>7}|{:>6}{:>6}{:>6}{:>6}|{:>6}{:>6}{:>6}{:>6}|{:>6}{:>6}{:>6}{:>6}|{:>6}{:>6}{:>6}{:>"
      "6}"
      "{:>6}|"
      "{:>8}{:>7}\n",
      "family", "models", "sing", "reg", "undef", "other", "safe", "sing", "open", "refus",
      "missed", "WRONG", "CRASH", "slow", "verif", "unfin", "annou", "REJEC", "BROKE", "seconds",
      "worst");
  FamilyCount all;
  for (const auto& [name, c] : families_) {
    text += row(name, c);
    add_to(all, c);
  }
  text +=
      row("all", all) + fmt::format("{:.2f} % of the proofs are VERIFIED\n", verified_percent());
  for (const auto& [reason, n] : unfinished_)
    text += fmt::format("UNFINISHED {:6}  {}\n", n, reason);
  return text;
}

std::string Summary::failure_lines(const std::string& program, std::size_t most) const {
  std::map<std::pair<std::string, std::string>, std::size_t> shown;
  std::string text;
  for (const Failure& f : failures_) {
    const std::size_t before = shown[{f.what, f.family}]++;
    if (before < most)
      text +=
          fmt::format("{}: {} --show {}:{}   {}\n", f.what, program, f.family, f.seed, f.detail);
  }
  for (const auto& [key, n] : shown)
    if (n > most) text += fmt::format("{} of {}: {} more\n", key.first, key.second, n - most);
  return text;
}

std::string Summary::json() const {
  nlohmann::ordered_json j;
  for (const auto& [name, c] : families_) j["families"][name] = json_of(c);
  j["verified_percent"] = verified_percent();
  j["unfinished"] = unfinished_;
  j["failures"] = nlohmann::json::array();
  for (const Failure& f : failures_)
    j["failures"].push_back(
        {{"what", f.what}, {"family", f.family}, {"seed", f.seed}, {"detail", f.detail}});
  return j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace regulus::detail::attack
