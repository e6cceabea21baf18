// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_audit.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "runtime/formal/coq_question.hpp"
#include "runtime/formal/coq_tokens.hpp"
#include "runtime/formal/coq_words.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

using Kind = CoqToken::Kind;
using Sentence = std::vector<CoqToken>;

constexpr auto kImports = std::to_array<std::string_view>(
    {"From Coq Require Import List", "From Coq Require Import PrimFloat",
     "From Regulus Require Import Expressions Questions Search Singularity Threshold Forces",
     "From Regulus Require Import Notations", "Import ListNotations"});

/// The definitions of a file, but for those of its names.
constexpr auto kDefinitions = std::to_array<std::string_view>(
    {"the_question : question", "the_question ( piece : list expression ) : question",
     "the_method : method", "pieces : list ( list expression )", "the_tree : tree",
     "the_trees : list tree", "negative : coordinates", "positive : coordinates",
     "the_point : coordinates", "the_scales : list expression", "the_threshold : expression",
     "the_row : nat", "the_load : list expression", "the_limit : expression"});

/// The words of their bodies. Each has one meaning, that of the imports: no definition has its name.
constexpr auto kWords = std::to_array<std::string_view>(
    {"Question", "Method", "Name", "Leaf", "Split", "within", "nth",      "piece",
     "no_entry", "pi",     "sqrt", "sin",  "cos",   "tan",    "asin",     "acos",
     "atan",     "atan2",  "exp",  "log",  "abs",   "float",  "infinity", "neg_infinity"});

constexpr std::string_view kSymbols = "()[];,+-*/^%";

/// The claims about one question, and where the library defines them.
struct Claim {
  std::string_view name, arguments;
};
constexpr auto kClaims =
    std::to_array<Claim>({{"no_singularity", ""},
                          {"singularity", ""},
                          {"determinant_above", " the_scales the_threshold"},
                          {"determinant_not_above", " the_scales the_threshold"},
                          {"force_within", " the_row the_load the_limit"},
                          {"force_below", " the_row the_load the_limit"}});

/// What follows the theorem if the file is about the robot of a model file.
constexpr std::string_view kGeometry = "From Regulus Require Import Geometry";
constexpr std::string_view kArms = "From Regulus Require Import Arms";
constexpr std::string_view kLegsDefinition = "legs : list leg", kSet = "the_set", kArm = "arm";

template <std::size_t N>
bool is_one_of(std::string_view text, const std::array<std::string_view, N>& all) {
  return std::ranges::find(all, text) != all.end();
}

/// Returns the words with the path of the audited file before each of its own.
std::string with_paths(std::string_view words) {
  std::string text;
  while (!words.empty()) {
    const std::string_view word = take_until(words, " ");
    if (!word.empty())
      text.append(" ").append(kAuditedFolder).append(".").append(kAuditedFile).append(".") += word;
  }
  return text;
}

class PlainReader {
 public:
  explicit PlainReader(std::string_view text) { split(coq_tokens(text)); }

  PlainTheorem read() {
    for (const std::string_view import : kImports) expect(import);
    while (at_ < sentences_.size() && sentences_[at_].front().text == "Definition") definition();
    PlainTheorem theorem = statement();
    proof();
    is_arm_ = current() == kArms;
    if (is_arm_ || current() == kGeometry) geometry(theorem);
    if (at_ < sentences_.size()) fail("nothing may follow the last theorem");
    return theorem;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    const std::size_t line = at_ < sentences_.size() ? sentences_[at_].front().line : last_line_;
    throw Rejection("line " + std::to_string(line) + ": " + what);
  }

  void split(const std::vector<CoqToken>& tokens) {
    Sentence sentence;
    for (const CoqToken& token : tokens) {
      last_line_ = token.line;
      if (token.kind != Kind::kPeriod) {
        sentence.push_back(token);
      } else if (!sentence.empty()) {
        sentences_.push_back(std::exchange(sentence, {}));
      } else {
        throw Rejection("line " + std::to_string(token.line) + ": an empty sentence");
      }
    }
    if (!sentence.empty()) throw Rejection("the last sentence has no end");
  }

  [[nodiscard]] std::string current() const {
    return at_ < sentences_.size() ? joined(sentences_[at_]) : "";
  }

  void expect(std::string_view sentence) {
    if (current() != sentence) fail("expected the sentence '" + std::string(sentence) + ".'");
    ++at_;
  }

  void definition() {
    const Sentence& words = sentences_[at_];
    const auto is_assignment = [](const CoqToken& t) { return t.text == ":="; };
    const auto assignment = std::ranges::find_if(words, is_assignment);
    if (assignment == words.end()) fail("a definition without ':='");
    const std::string head = joined({words.begin() + 1, assignment});
    const std::string name = head.substr(0, head.find(' '));
    const bool is_name = name.size() > 1 && name.starts_with('_') && name == head;
    if (!is_name && !is_one_of(head, kDefinitions))
      fail("'" + head + "' is not a definition of regulus-verify");
    if (!defined_.insert(name).second) fail("'" + name + "' is defined twice");
    const Sentence body(assignment + 1, words.end());
    if (is_name && (body.size() != 2 || body[0].text != "Name" || body[1].kind != Kind::kNumber))
      fail("the name '" + name + "' is not the name of a number");
    // Before its end a definition cannot use its own name, and the others are not expressions.
    for (const CoqToken& token : body) check_word(token, name);
    ++at_;
  }

  void check_word(const CoqToken& token, const std::string& itself) const {
    const bool is_known =
        token.kind == Kind::kNumber ||
        (token.kind == Kind::kSymbol && token.text.size() == 1 &&
         kSymbols.find(token.text) != std::string_view::npos) ||
        is_one_of(token.text, kWords) ||
        (token.text.starts_with('_') && token.text != itself && defined_.contains(token.text));
    if (!is_known)
      throw Rejection("line " + std::to_string(token.line) + ": '" + std::string(token.text) +
                      "' has no meaning in the definitions of a plain file");
  }

  PlainTheorem statement() {
    constexpr std::string_view kBegin = "Theorem the_claim : ";
    const std::string sentence = current();
    if (!sentence.starts_with(kBegin)) fail("expected a definition, or the theorem the_claim");
    const std::string stated = sentence.substr(kBegin.size());
    for (const Claim& claim : kClaims) {
      const std::string name(claim.name), arguments(claim.arguments);
      const std::string path = "Regulus.Questions." + name, own = with_paths(arguments);
      if (stated == name + " the_question" + arguments)
        return {stated, path + with_paths("the_question") + own};
      if (stated ==
          "Forall ( fun piece => " + name + " ( the_question piece )" + arguments + " ) pieces")
        return {stated, "Coq.Lists.List.Forall (fun piece => " + path + " (" +
                            with_paths("the_question") + " piece)" + own + ")" +
                            with_paths("pieces")};
    }
    fail("the statement is not one of regulus-verify");
  }

  /// Whatever the proof applies, Coq checks it; no word of it can do anything else.
  void proof() {
    ++at_;
    expect("Proof");
    const Sentence words = at_ < sentences_.size() ? sentences_[at_] : Sentence{};
    const auto is_plain = [](const CoqToken& t) {
      return t.text.starts_with("the_") || t.text.starts_with("check_") || t.text == "pieces" ||
             t.text == "negative" || t.text == "positive";
    };
    if (words.size() < 4 || words[0].text != "apply" || words[1].text != "(" ||
        words.back().text != ")" || !std::all_of(words.begin() + 2, words.end() - 1, is_plain))
      fail("expected the sentence 'apply (check_… …).'");
    ++at_;
    expect("vm_cast_no_check ( eq_refl true )");
    expect("Qed");
  }

  // The theorems about a robot.

  void geometry(PlainTheorem& theorem) {
    theorem.geometry_import = current() + ".\n";
    ++at_;
    const bool has_parts = is_arm_ && current().starts_with("Definition arm ");
    if (has_parts) arm_definition(theorem);
    const bool has_legs =
        !is_arm_ && current().starts_with("Definition " + std::string(kLegsDefinition) + " := ");
    if (has_legs) geometric_definition(3, {}, theorem);
    if (!current().starts_with("Definition the_set ")) fail("expected the definition of the_set");
    Words words{at_sentence(), 2};
    const std::vector<std::string> names = binders(words);
    for (const char* word : {":", "Prop"}) expect_word(words, word);
    geometric_definition(words.at, names, theorem);
    robot(names, {has_legs, has_parts}, theorem);
    if (at_ < sentences_.size())
      point(names, theorem);
    else
      theorem.may_be_empty = !is_singular_;
  }

  /// A sentence, and where its reader is.
  struct Words {
    const Sentence& all;
    std::size_t at = 0;

    [[nodiscard]] std::string_view next() const { return at < all.size() ? all[at].text : ""; }
  };

  [[nodiscard]] const Sentence& at_sentence() const {
    static const Sentence kNone;
    return at_ < sentences_.size() ? sentences_[at_] : kNone;
  }

  void expect_word(Words& words, std::string_view word) const {
    if (words.next() != word)
      fail("found '" + std::string(words.next()) + "', expected '" + std::string(word) + '\'');
    ++words.at;
  }

  /// Reads `(x y : R) (a1 : point)`: no name has another meaning here.
  std::vector<std::string> binders(Words& words) const {
    std::vector<std::string> names;
    while (words.next() == "(") {
      for (++words.at; words.next() != ":" && words.at < words.all.size(); ++words.at) {
        const std::string name(words.next());
        if (!is_quantity(name) || std::ranges::find(names, name) != names.end())
          fail("'" + name + "' is no quantity of a robot, or is one twice");
        names.push_back(name);
      }
      expect_word(words, ":");
      if (words.next() != "R" && words.next() != "point") fail("expected R or point");
      ++words.at;
      expect_word(words, ")");
    }
    return names;
  }

  /// The same words as in the definition of the_set.
  void expect_binders(Words& words, std::string_view quantifier,
                      const std::vector<std::string>& names) const {
    if (names.empty()) return;
    expect_word(words, quantifier);
    if (binders(words) != names) fail("the quantities are not those of the_set");
    expect_word(words, ",");
  }

  void expect_set(Words& words, const std::vector<std::string>& names) const {
    expect_word(words, kSet);
    for (const std::string& name : names) expect_word(words, name);
  }

  template <class Predicate>
  void check_geometric_words(const Words& words, const std::vector<std::string>& names,
                             Predicate is_other) const {
    for (std::size_t i = words.at; i < words.all.size(); ++i) {
      const CoqToken& token = words.all[i];
      const bool is_known = token.kind == Kind::kNumber || is_one_of(token.text, kRealWords) ||
                            is_one_of(token.text, kRealSymbols) || is_other(token.text) ||
                            std::ranges::find(names, token.text) != names.end();
      if (!is_known)
        throw Rejection("line " + std::to_string(token.line) + ": '" + std::string(token.text) +
                        "' has no meaning in the geometry of a plain file");
    }
  }

  /// Reads the body after `:=`, which begins at or after `from`.
  void geometric_definition(std::size_t from, const std::vector<std::string>& names,
                            PlainTheorem& theorem) {
    Words words{at_sentence(), from};
    while (words.next() != ":=" && words.at < words.all.size() && from == 3) ++words.at;
    expect_word(words, ":=");
    check_geometric_words(words, names, [this](std::string_view word) {
      return is_arm_ && is_one_of(word, kPartWords);
    });
    theorem.definitions += current() + ".\n";
    ++at_;
  }

  /// The names of its joints are its own.
  void arm_definition(PlainTheorem& theorem) {
    Words words{at_sentence(), 2};
    const std::vector<std::string> joints = binders(words);
    for (const char* word : {":", "list", "part"}) expect_word(words, word);
    geometric_definition(words.at, joints, theorem);
  }

  /// Reads `Theorem NAME :`.
  Words theorem_named(const char* name) const {
    Words words{at_sentence()};
    for (const char* word : {"Theorem", name, ":"}) expect_word(words, word);
    return words;
  }

  void add_theorem(const char* name, PlainTheorem& theorem) {
    const Sentence& all = at_sentence();
    theorem.geometry.push_back({name, joined({all.begin() + 3, all.end()})});
    ++at_;
    expect("Proof");
  }

  /// Says what the file defines before the set.
  struct Own {
    bool has_legs, has_parts;
  };

  /// Full rank or a large determinant at all poses, or a determinant that is small or 0 at one.
  void robot(const std::vector<std::string>& names, const Own& own, PlainTheorem& theorem) {
    constexpr const char* kName = "the_robot";
    Words words = theorem_named(kName);
    is_singular_ = words.next() == "exists" || (names.empty() && names_a_pose());
    expect_binders(words, is_singular_ ? "exists" : "forall", names);
    expect_set(words, names);
    expect_word(words, is_singular_ ? "/\\" : "->");
    const auto is_of_matrix = [&](std::string_view word) {
      constexpr auto kMatrixWords = std::to_array<std::string_view>(
          {"full_column_rank", "determinant", "gough", "inverse_jacobian", "<", "="});
      constexpr auto kArmWords =
          std::to_array<std::string_view>({"full_column_rank", "full_row_rank", "jacobian"});
      if (is_arm_)
        return is_one_of(word, kArmWords) || is_one_of(word, kPartWords) ||
               (own.has_parts && word == kArm);
      return is_one_of(word, kMatrixWords) || (own.has_legs && word == "legs");
    };
    check_geometric_words(words, names, is_of_matrix);
    add_theorem(kName, theorem);
    geometric_proof(names);
  }

  /// A motion without quantities has one pose.
  [[nodiscard]] bool names_a_pose() const {
    return current().find("the_set /\\ ") != std::string::npos;
  }

  void point(const std::vector<std::string>& names, PlainTheorem& theorem) {
    constexpr const char* kName = "the_set_is_inhabited";
    Words words = theorem_named(kName);
    expect_binders(words, "exists", names);
    expect_set(words, names);
    if (words.at != words.all.size()) fail("expected the end of the sentence");
    add_theorem(kName, theorem);
    geometric_proof(names);
  }

  /// Whatever it does, Coq checks it; no word of it can do anything else.
  void geometric_proof(const std::vector<std::string>& names) {
    for (; at_ < sentences_.size() && current() != "Qed"; ++at_)
      check_geometric_words({at_sentence()}, names,
                            [](std::string_view word) { return is_one_of(word, kProofWords); });
    expect("Qed");
  }

  std::vector<Sentence> sentences_;
  std::size_t at_ = 0, last_line_ = 1;
  bool is_arm_ = false;       ///< the words of Arms.v have a meaning
  bool is_singular_ = false;  ///< the theorem about the robot names a pose
  std::set<std::string, std::less<>> defined_;
};

}  // namespace

PlainTheorem read_plain_theorem(std::string_view text) { return PlainReader(text).read(); }

}  // namespace regulus::verifier
