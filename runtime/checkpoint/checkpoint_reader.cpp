// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "runtime/checkpoint/checkpoint.hpp"

namespace regulus {
namespace {

constexpr std::string_view kFirstLine = "regulus checkpoint 7\n";
constexpr std::size_t kDigest = 64;
constexpr std::size_t kEndLine = sizeof "end " - 1 + kDigest + sizeof "\n" - 1;

/// Splits a text into lines and words.
class Reader {
 public:
  explicit Reader(std::string_view text) noexcept : rest_(text) {}

  [[noreturn]] void refuse(const std::string& expected) const {
    throw CheckpointError("line " + std::to_string(line_) + ": expected " + expected);
  }
  void next_line(std::string_view name) {
    if (line_ > 0 && !words_.empty()) refuse("the end of the line");
    ++line_;
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) refuse("a line '" + std::string(name) + "'");
    words_ = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (!words_.starts_with(name)) refuse("'" + std::string(name) + "'");
    words_.remove_prefix(name.size());
  }
  void expect_end() const {
    if (!words_.empty() || !rest_.empty()) refuse("the end");
  }
  [[nodiscard]] bool at_end_of_line() const noexcept { return words_.empty(); }
  [[nodiscard]] bool take(std::string_view word) noexcept {
    if (words_ != word) return false;
    words_ = {};
    return true;
  }

  template <typename Number = std::uint64_t>
  Number number(Number most = std::numeric_limits<Number>::max()) {
    Number n = 0;
    const std::string_view word = next_word();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n);
    if (error != std::errc{} || end != word.data() + word.size() || n > most)
      refuse("a number up to " + std::to_string(most));
    return n;
  }
  double real() { return real_of(next_word()); }
  Interval range() {
    const std::string_view word = next_word();
    const std::size_t colon = word.find(':');
    if (colon == std::string_view::npos) refuse("a range LO:HI");
    const double lo = real_of(word.substr(0, colon)), hi = real_of(word.substr(colon + 1));
    if (!(lo <= hi)) refuse("bounds in order");
    return {lo, hi};
  }
  std::string_view word() { return next_word(); }

 private:
  std::string_view next_word() {
    if (!words_.starts_with(' ')) refuse("one more word");
    words_.remove_prefix(1);
    const std::string_view word = words_.substr(0, words_.find(' '));
    words_.remove_prefix(word.size());
    return word;
  }
  /// Reads what %a writes. from_chars accepts no sign or 0x, but words that are not numbers.
  double real_of(std::string_view word) const {
    const bool negative = word.starts_with('-');
    word.remove_prefix(negative ? 1 : 0);
    double x = 0.0;
    if (!word.starts_with("0x")) refuse("a hexadecimal number");
    word.remove_prefix(2);
    const auto [end, error] =
        std::from_chars(word.data(), word.data() + word.size(), x, std::chars_format::hex);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(x) ||
        word.starts_with('-'))
      refuse("a hexadecimal number");
    return negative ? -x : x;
  }

  std::string_view rest_, words_;
  std::size_t line_ = 0;
};

std::string_view without_digest(std::string_view text) {
  if (text.size() < kEndLine) throw CheckpointError("it is incomplete");
  const std::string_view body = text.substr(0, text.size() - kEndLine);
  if (text.substr(body.size()) != end_of_checkpoint(body))
    throw CheckpointError("it is damaged: its checksum is wrong");
  return body;
}

void read_blocked(Reader& reader, const CheckpointedQuestion& question, SearchState& state) {
  if (reader.take(" none")) return;
  state.blocked = true;
  state.blocked_reason =
      static_cast<Reason>(reader.number(static_cast<std::uint64_t>(Reason::kBadProblem)));
  state.boxes_when_blocked = reader.number();
  for (std::size_t k = 0; k < question.ranges.size(); ++k)
    state.blocking_box.push_back(reader.range());
}

void read_box(Reader& reader, const CheckpointedQuestion& question, Checkpoint& into) {
  reader.next_line("b");
  into.ids.push_back(reader.number(into.state.next_id - 1));
  into.depths.push_back(reader.number<std::uint32_t>());
  for (std::size_t k = 0; k < question.ranges.size(); ++k) {
    const Interval x = k < question.splittable ? reader.range() : question.ranges[k];
    if (!certain_subset(x, question.ranges[k])) reader.refuse("a box of the variety");
    into.boxes.push_back(x);
  }
}

/// The point is absent if the search had none.
void read_candidate(Reader& reader, const std::string& name, std::size_t variables,
                    WitnessCandidates::Candidate& into) {
  reader.next_line("candidate " + name);
  into.approx = reader.real();
  into.tried = reader.real();
  while (!reader.at_end_of_line()) into.point.push_back(reader.real());
  if (!into.point.empty() && into.point.size() != variables)
    reader.refuse("a number for each variable");
}

void read_candidates(Reader& reader, std::size_t variables, WitnessCandidates& into) {
  read_candidate(reader, "positive", variables, into.positive);
  read_candidate(reader, "negative", variables, into.negative);
  read_candidate(reader, "small", variables, into.small);
  reader.next_line("small");
  into.small_known = reader.number(1U) != 0;
  into.small_fresh = reader.number(1U) != 0;
  into.small_tries = reader.number<std::uint32_t>();
}

void read_run(Reader& reader, SearchState& state) {
  reader.next_line("run");
  Headway::Run run;
  run.begin = reader.number(state.statistics.boxes);
  run.leaves = reader.number();
  run.multiprecision = reader.number();
  run.part = reader.real();
  state.headway = Headway(run);
}

/// Every open box belongs to one unit; without units there are no numbers.
void read_units(Reader& reader, SearchState& state) {
  reader.next_line("units");
  while (!reader.at_end_of_line()) {
    state.units.push_back(reader.number<std::uint32_t>());
    if (state.units.back() == 0) reader.refuse("a number above 0");
  }
}

void require_format(std::string_view text) {
  if (text.starts_with(kFirstLine)) return;
  if (!text.starts_with("regulus checkpoint ")) throw CheckpointError("it is not a checkpoint");
  throw CheckpointError("another version of regulus has written it, in another format");
}

void read_counts(Reader& reader, SearchState& state) {
  reader.next_line("next");
  state.next_id = reader.number();
  if (state.next_id == 0) reader.refuse("a number above 0");
  Statistics& statistics = state.statistics;
  reader.next_line("boxes");
  for (std::uint64_t* n : {&statistics.boxes, &statistics.max_frontier, &statistics.probes})
    *n = reader.number();
  reader.next_line("seconds");
  statistics.seconds = reader.real();
  reader.next_line("leaves");
  for (std::uint64_t& n : statistics.leaves) n = reader.number();
  reader.next_line("filters");
  while (!reader.at_end_of_line()) state.filter_boxes.push_back(reader.number());
  reader.next_line("descent");
  state.next_descent = reader.number();
  reader.next_line("limit");
  state.threshold = AdaptiveThreshold(reader.real());
}

}  // namespace

std::vector<OpenBox> Checkpoint::open() const {
  std::vector<OpenBox> list;
  const std::size_t variables = ids.empty() ? 0 : boxes.size() / ids.size();
  for (std::size_t i = 0; i < ids.size(); ++i)
    list.push_back({ids[i], depths[i], {boxes.data() + i * variables, variables}});
  return list;
}

Checkpoint read_checkpoint(std::string_view text, const CheckpointedQuestion& question) {
  require_format(text);
  Reader reader(without_digest(text));
  reader.next_line(kFirstLine.substr(0, kFirstLine.size() - 1));
  reader.next_line("question");
  if (reader.word() != question.identity)
    throw CheckpointError(
        "it is about another question: another model, motion, range, tolerance or "
        "threshold");
  Checkpoint result;
  read_counts(reader, result.state);
  read_candidates(reader, question.ranges.size(), result.state.candidates);
  read_run(reader, result.state);
  reader.next_line("blocked");
  read_blocked(reader, question, result.state);
  read_units(reader, result.state);
  reader.next_line("open");
  const std::uint64_t count = reader.number();
  const std::vector<std::uint32_t>& units = result.state.units;
  if (!units.empty() && std::accumulate(units.begin(), units.end(), std::uint64_t{0}) != count)
    reader.refuse("as many boxes as the units have");
  for (std::uint64_t left = count; left > 0; --left) read_box(reader, question, result);
  reader.expect_end();
  std::vector<BoxId> ids = result.ids;
  std::sort(ids.begin(), ids.end());
  if (std::adjacent_find(ids.begin(), ids.end()) != ids.end())
    throw CheckpointError("it contains a box twice");
  return result;
}

}  // namespace regulus
