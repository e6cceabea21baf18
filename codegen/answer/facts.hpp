// SPDX-License-Identifier: GPL-3.0-or-later
// What an answer tells. Each fact is told once: people read it as a line of text, programs as a key of
// a JSON object. A page has both.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace regulus::detail {

/// What is read of a fact: by programs a key and its value, by people a label and a sentence. Of a key
/// the table in keys.hpp says which kind of value it has, its unit and how exact it is.
struct Fact {
  std::string key;               ///< empty: for people
  nlohmann::ordered_json value;  ///< null: not known, or there is none
  std::string label;             ///< empty: the line continues the one before
  std::string sentence;          ///< empty: for programs; may have several lines
};

/// Who reads the facts. Facts that cost time are not computed for a reader who does not see them.
enum class Readers : std::uint8_t { kPeople, kPrograms, kBoth };

/// The facts of an answer, in the order in which people read them.
class Facts {
 public:
  explicit Facts(Readers readers = Readers::kBoth) : readers_(readers) {}

  [[nodiscard]] bool are_for_people() const noexcept { return readers_ != Readers::kPrograms; }
  [[nodiscard]] bool are_for_programs() const noexcept { return readers_ != Readers::kPeople; }
  /// Returns facts about a part of the answer, for the same readers.
  [[nodiscard]] Facts part() const { return Facts(readers_); }

  /// Adds a fact for people and programs. A label that ends with a colon, as "at 0.1:", takes part in
  /// the sentence.
  Facts& tell(std::string key, nlohmann::ordered_json value, std::string label,
              std::string sentence);
  /// Adds a fact for programs alone. A later one of the same key replaces the value.
  Facts& add(std::string key, nlohmann::ordered_json value);
  /// Adds a fact for people alone; nothing if the sentence is empty.
  Facts& say(std::string label, std::string sentence);
  /// Adds finished lines for people: each has a label, or the margin of text().
  Facts& say_lines(std::string_view lines);
  /// Adds a part: programs find its facts in an object under `key`, people read them in turn.
  Facts& tell_part(std::string key, Facts part);
  Facts& append(Facts others);

  [[nodiscard]] const std::vector<Fact>& all() const noexcept { return facts_; }

  /// Returns the lines for people: a column of labels, and the sentences.
  [[nodiscard]] std::string text() const;
  /// Returns the keys as an object, in the order in which they were told.
  [[nodiscard]] nlohmann::ordered_json object() const;
  /// Returns the object of a whole answer: first the head that every answer has (keys.hpp), null
  /// where nothing was told, and then the other keys.
  [[nodiscard]] nlohmann::ordered_json report() const;

 private:
  Readers readers_;
  std::vector<Fact> facts_;
};

/// Returns a value, or null.
template <class Value>
[[nodiscard]] nlohmann::ordered_json or_null(const std::optional<Value>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

/// Returns the text for people of what `tell` tells to Facts.
template <class Tell>
[[nodiscard]] std::string text_of_facts(Tell&& tell) {
  Facts facts(Readers::kPeople);
  std::forward<Tell>(tell)(facts);
  return facts.text();
}

/// Returns the JSON report of what `tell` tells to Facts.
template <class Tell>
[[nodiscard]] nlohmann::ordered_json report_of_facts(Tell&& tell) {
  Facts facts(Readers::kPrograms);
  std::forward<Tell>(tell)(facts);
  return facts.report();
}

}  // namespace regulus::detail
