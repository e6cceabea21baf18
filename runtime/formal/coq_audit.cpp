// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/coq_audit.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "runtime/formal/coq_question.hpp"
#include "runtime/formal/plain_geometry.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

using Kind = CoqToken::Kind;

constexpr std::string_view kLibrary =
    "From Regulus Require Import Expressions Questions Search Singularity Threshold Forces";
/// In its place, of a closure, along a way, of a quantity over its branch, of a finite error, and
/// of its solutions; of forces within limits, and of singular values; and the file more of a paving.
constexpr std::string_view kClosureImport =
    "From Regulus Require Import Expressions Questions Search Closures Tubes Branches";
constexpr auto kMoreOfClosures = std::to_array<std::string_view>(
    {"", " Ways", " Rates", " Rates Slopes", " Distances", " Solutions", " Poses"});
constexpr auto kMoreOfLibrary = std::to_array<std::string_view>({" Limits", " SingularValues"});
constexpr std::string_view kMoreOfPavings = " Parts";

/// The definitions of a file, but for those of its names.
constexpr auto kDefinitions =
    std::to_array<std::string_view>({"the_question : question",
                                     "the_question ( piece : list expression ) : question",
                                     "the_method : method",
                                     "pieces : list ( list expression )",
                                     "the_tree : tree",
                                     "the_trees : list tree",
                                     "negative : coordinates",
                                     "positive : coordinates",
                                     "the_point : coordinates",
                                     "the_direction : coordinates",
                                     "the_scales : list expression",
                                     "the_threshold : expression",
                                     "the_closure : closure",
                                     "the_closure ( piece : list expression ) : closure",
                                     "the_tubes : tubes",
                                     "the_tubes : list tubes",
                                     "the_solutions : list line",
                                     "the_legs : list ( leg written )",
                                     "the_roots : list root",
                                     "the_places : list ( list expression * listed )",
                                     "the_row : nat",
                                     "the_load : list expression",
                                     "the_limit : expression",
                                     "the_limits : list ( expression * expression )",
                                     "the_motors : list nat",
                                     "the_errors : list nat",
                                     "the_unknown : nat",
                                     "the_measure : measured",
                                     "the_factors : list expression",
                                     "the_side : side",
                                     "the_vectors : vectors",
                                     "the_parts : parts",
                                     "the_parts : list parts",
                                     "the_feasible_parts : parts",
                                     "the_feasible_parts : list parts"});

/// The words of their bodies. Each has one meaning, that of the imports: no definition has its name.
constexpr auto kWords = std::to_array<std::string_view>(
    {"Within", "Below",   "Above",    "Beyond", "Deflection", "Kept",        "LeftOut", "Parted",
     "NoTube", "Vectors", "Force",    "Motion", "nat",        "Closure",     "Tube",    "Excluded",
     "Held",   "Cut",     "Question", "Method", "Name",       "All_of",      "Some_of", "Leaf",
     "Split",  "within",  "nth",      "piece",  "no_entry",   "segments",    "deg",     "pi",
     "sqrt",   "sin",     "cos",      "tan",    "asin",       "acos",        "atan",    "atan2",
     "exp",    "log",     "abs",      "float",  "infinity",   "neg_infinity"});

constexpr std::string_view kSymbols = "()[];,+-*/^%";

/// The claims about one question, and where the library defines them.
struct Claim {
  std::string_view name, arguments, library = "Questions";
};
constexpr auto kClaims = std::to_array<Claim>(
    {{"no_singularity", ""},
     {"singularity", ""},
     {"determinant_above", " the_scales the_threshold"},
     {"determinant_not_above", " the_scales the_threshold"},
     {"force_within", " the_row the_load the_limit"},
     {"force_below", " the_row the_load the_limit"},
     {"forces_within_limits", " the_scales the_load the_limits", "Limits"},
     {"no_forces_within_limits", " the_scales the_load the_limits", "Limits"},
     {"forces_within_limits_in", " the_parts the_scales the_load the_limits", "Limits"},
     {"condition_2_below", " the_scales the_factors the_limit", "SingularValues"},
     {"singular_values_above", " the_scales the_factors the_limit", "SingularValues"},
     {"singular_values_below", " the_scales the_factors the_limit", "SingularValues"}});

/// The claims about a closure.
constexpr auto kBranchClaims = std::to_array<Claim>(
    {{"one_branch", "", "Closures"},
     {"branch_within", " the_motors the_measure the_vectors the_limit", "Rates"},
     {"branch_below", " the_motors the_measure the_vectors the_limit", "Rates"},
     {"branch_above", " the_motors the_measure the_vectors the_limit", "Rates"},
     {"branch_within_limits", " the_motors the_vectors the_limits", "Rates"},
     {"finite_error_within", " the_errors the_unknown the_limit", "Distances"},
     {"one_branch_along", " pieces", "Closures"},
     {"branch_within_along", " pieces the_motors the_measure the_vectors the_limit", "Rates"},
     {"branch_below_along", " pieces the_motors the_measure the_vectors the_limit", "Rates"},
     {"branch_above_along", " pieces the_motors the_measure the_vectors the_limit", "Rates"},
     {"branch_within_limits_along", " pieces the_motors the_vectors the_limits", "Rates"},
     {"finite_error_within_along", " pieces the_errors the_unknown the_limit", "Distances"},
     {"branch_determinant", " the_side the_limit", "Slopes"},
     {"branch_determinant_along", " pieces the_side the_limit", "Slopes"},
     {"branch_determinant_in", " the_parts the_feasible_parts the_side the_limit", "Slopes"},
     {"branch_determinant_along_in", " pieces the_parts the_feasible_parts the_side the_limit",
      "Slopes"},
     {"branch_condition", " the_factors the_limit", "Slopes"},
     {"branch_condition_along", " pieces the_factors the_limit", "Slopes"},
     {"branch_condition_2", " the_factors the_limit", "Slopes"},
     {"branch_condition_2_along", " pieces the_factors the_limit", "Slopes"},
     {"branch_singular_values_above", " the_factors the_limit", "Slopes"},
     {"branch_singular_values_above_along", " pieces the_factors the_limit", "Slopes"},
     {"branch_singular_values_below", " the_factors the_limit", "Slopes"},
     {"branch_singular_values_below_along", " pieces the_factors the_limit", "Slopes"},
     {"one_branch_in", " the_parts", "Branches"},
     {"one_branch_along_in", " pieces the_parts", "Ways"},
     {"branch_within_limits_in", " the_parts the_feasible_parts the_motors the_vectors the_limits",
      "Rates"},
     {"branch_within_limits_along_in",
      " pieces the_parts the_feasible_parts the_motors the_vectors the_limits", "Rates"},
     {"all_solutions", " the_solutions", "Closures"},
     {"some_solutions", " the_solutions", "Closures"},
     {"solutions_at", " the_places", "Closures"}});

/// The claims about the poses of a platform, and what they rest on.
constexpr auto kPoseClaims = std::to_array<std::string_view>(
    {"some_poses", "forty_poses -> all_poses", "sixteen_poses -> all_poses"});

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

/// Returns the words of Poses.v with its path before each.
std::string with_library(std::string_view words) {
  std::string text;
  while (!words.empty()) {
    const std::string_view word = take_until(words, " ");
    text += (text.empty() ? "" : " ") + std::string(word == "->" ? "" : "Regulus.Poses.") +
            std::string(word);
  }
  return text;
}

class PlainReader {
 public:
  explicit PlainReader(std::string_view text) : sentences_(text) {}

  PlainTheorem read() {
    sentences_.expect("From Coq Require Import List");
    sentences_.expect("From Coq Require Import PrimFloat");
    library();
    sentences_.expect("From Regulus Require Import Notations");
    sentences_.expect("Import ListNotations");
    while (!sentences_.at_end() && sentences_.words().front().text == "Definition") definition();
    PlainTheorem theorem = statement();
    proof();
    read_plain_geometry(sentences_, theorem);
    if (!sentences_.at_end()) fail("nothing may follow the last theorem");
    return theorem;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { sentences_.fail(what); }

  /// The files of the library.
  void library() {
    const std::string current = sentences_.current();
    std::string_view rest = current;
    if (rest.ends_with(kMoreOfPavings)) rest.remove_suffix(kMoreOfPavings.size());
    is_closure_ = rest.starts_with(kClosureImport) &&
                  is_one_of(rest.substr(kClosureImport.size()), kMoreOfClosures);
    const bool has_more =
        rest.starts_with(kLibrary) && is_one_of(rest.substr(kLibrary.size()), kMoreOfLibrary);
    if (!is_closure_ && !has_more) return sentences_.expect(kLibrary);
    sentences_.next();
  }

  void definition() {
    const Sentence& words = sentences_.words();
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
    sentences_.next();
  }

  /// Only these lists have natural numbers, for which `-` would mean something else.
  static bool is_of_numbers(const std::string& name) {
    return name == "the_motors" || name == "the_vectors" || name == "the_errors";
  }

  void check_word(const CoqToken& token, const std::string& itself) const {
    const bool is_known =
        token.kind == Kind::kNumber ||
        (token.kind == Kind::kSymbol && token.text.size() == 1 &&
         kSymbols.find(token.text) != std::string_view::npos) ||
        (is_one_of(token.text, kWords) && (token.text != "nat" || is_of_numbers(itself))) ||
        (token.text.starts_with('_') && token.text != itself && defined_.contains(token.text));
    if (!is_known)
      throw Rejection("line " + std::to_string(token.line) + ": '" + std::string(token.text) +
                      "' has no meaning in the definitions of a plain file");
  }

  PlainTheorem statement() {
    constexpr std::string_view kBegin = "Theorem the_claim : ";
    const std::string sentence = sentences_.current();
    if (!sentence.starts_with(kBegin)) fail("expected a definition, or the theorem the_claim");
    const std::string stated = sentence.substr(kBegin.size());
    if (is_closure_) return branch_statement(stated);
    for (const Claim& claim : kClaims) {
      const std::string name(claim.name), arguments(claim.arguments);
      const std::string path = "Regulus." + std::string(claim.library) + "." + name,
                        own = with_paths(arguments);
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

  [[nodiscard]] PlainTheorem branch_statement(const std::string& stated) const {
    for (const Claim& claim : kBranchClaims) {
      const std::string name(claim.name), arguments = " the_closure" + std::string(claim.arguments);
      if (stated == name + arguments)
        return {stated,
                "Regulus." + std::string(claim.library) + '.' + name + with_paths(arguments)};
    }
    const std::string_view arguments = " the_question the_legs the_solutions";
    for (const std::string_view claim : kPoseClaims)
      if (stated == std::string(claim).append(arguments))
        return {stated, with_library(claim) + with_paths(arguments)};
    fail("the statement is not that of a closure");
  }

  /// Whatever the proof applies, Coq checks it; no word of it can do anything else.
  void proof() {
    sentences_.next();
    sentences_.expect("Proof");
    const Sentence& words = sentences_.words();
    const auto is_plain = [](const CoqToken& t) {
      return t.text.starts_with("the_") || t.text.starts_with("check_") || t.text == "pieces" ||
             t.text == "negative" || t.text == "positive";
    };
    if (words.size() < 4 || words[0].text != "apply" || words[1].text != "(" ||
        words.back().text != ")" || !std::all_of(words.begin() + 2, words.end() - 1, is_plain))
      fail("expected the sentence 'apply (check_… …).'");
    sentences_.next();
    sentences_.expect("vm_cast_no_check ( eq_refl true )");
    sentences_.expect("Qed");
  }

  PlainSentences sentences_;
  bool is_closure_ = false;  ///< the imports are those of a closure
  std::set<std::string, std::less<>> defined_;
};

}  // namespace

PlainTheorem read_plain_theorem(std::string_view text) { return PlainReader(text).read(); }

}  // namespace regulus::verifier
