// SPDX-License-Identifier: Apache-2.0
#include "runtime/formal/plain_geometry.hpp"

#include "runtime/formal/coq_words.hpp"
#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

constexpr std::string_view kSet = "the_set";

/// The file whose words the theorems use.
enum class Library { kGeometry, kArms, kMatrices, kLegs };

class GeometryReader {
 public:
  GeometryReader(PlainSentences& sentences, Library library)
      : sentences_(sentences), library_(library) {}

  void read(PlainTheorem& theorem) {
    theorem.geometry_import = sentences_.current() + ".\n";
    sentences_.next();
    read_robot(theorem);
    if (name_of_definition() != kSet) sentences_.fail("expected the definition of the_set");
    Words words{sentences_.words(), 2};
    const std::vector<std::string> names = binders(words);
    for (const char* word : {":", "Prop"}) expect_word(words, word);
    geometric_definition(words, names, theorem);
    robot(names, theorem);
    if (sentences_.at_end())
      theorem.may_be_empty = !is_singular_;
    else
      point(names, theorem);
  }

 private:
  [[nodiscard]] std::string name_of_definition() const {
    const Sentence& words = sentences_.words();
    return words.size() > 2 && words[0].text == "Definition" ? std::string(words[1].text) : "";
  }

  /// The definition before that of the set. A platform or an arm with tolerances has none.
  void read_robot(PlainTheorem& theorem) {
    const std::string name = name_of_definition();
    if (library_ == Library::kMatrices) {
      if (name != "the_matrix" && name != "the_inverse_jacobian")
        sentences_.fail("expected the definition of the_matrix");
      matrix_definition(theorem);
    } else if (library_ == Library::kArms && name == "arm") {
      arm_definition(theorem);
    } else if (library_ == Library::kGeometry && name == "legs") {
      legs_definition("leg", theorem);
    } else if (library_ == Library::kLegs && name == "legs") {
      legs_definition("robot_leg", theorem);
    } else {
      return;
    }
    robot_ = name;
  }

  /// A sentence, and where its reader is.
  struct Words {
    const Sentence& all;
    std::size_t at = 0;

    [[nodiscard]] std::string_view next() const { return at < all.size() ? all[at].text : ""; }
  };

  void expect_word(Words& words, std::string_view word) const {
    if (words.next() != word)
      sentences_.fail("found '" + std::string(words.next()) + "', expected '" + std::string(word) +
                      '\'');
    ++words.at;
  }

  /// Reads `(x y : R) (a1 : point)`: no name has another meaning here.
  std::vector<std::string> binders(Words& words) const {
    std::vector<std::string> names;
    while (words.next() == "(") {
      for (++words.at; words.next() != ":" && words.at < words.all.size(); ++words.at) {
        const std::string name(words.next());
        if (!is_quantity(name) || std::ranges::find(names, name) != names.end())
          sentences_.fail("'" + name + "' is no quantity of a robot, or is one twice");
        names.push_back(name);
      }
      expect_word(words, ":");
      if (words.next() != "R" && words.next() != "point") sentences_.fail("expected R or point");
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
    if (binders(words) != names) sentences_.fail("the quantities are not those of the_set");
    expect_word(words, ",");
  }

  void expect_set(Words& words, const std::vector<std::string>& names) const {
    expect_word(words, kSet);
    for (const std::string& name : names) expect_word(words, name);
  }

  template <class Predicate>
  void check_geometric_words(const Words& words, const std::vector<std::string>& names,
                             Predicate is_other) const {
    check_part(words, words.all.size(), names, is_other);
  }
  template <class Predicate>
  void check_part(const Words& words, std::size_t end, const std::vector<std::string>& names,
                  Predicate is_other) const {
    for (std::size_t i = words.at; i < end; ++i) {
      const CoqToken& token = words.all[i];
      const bool is_known = token.kind == CoqToken::Kind::kNumber ||
                            is_one_of(token.text, kRealWords) ||
                            is_one_of(token.text, kRealSymbols) || is_other(token.text) ||
                            std::ranges::find(names, token.text) != names.end();
      if (!is_known)
        throw Rejection("line " + std::to_string(token.line) + ": '" + std::string(token.text) +
                        "' has no meaning in the geometry of a plain file");
    }
  }

  /// Reads the body after `:=`, which begins here.
  void geometric_definition(Words words, const std::vector<std::string>& names,
                            PlainTheorem& theorem) {
    expect_word(words, ":=");
    check_geometric_words(words, names, [this](std::string_view word) {
      return (library_ == Library::kArms && is_one_of(word, kPartWords)) ||
             (library_ == Library::kLegs && is_one_of(word, kLegWords));
    });
    keep_definition(theorem);
  }
  void keep_definition(PlainTheorem& theorem) {
    theorem.definitions += sentences_.current() + ".\n";
    sentences_.next();
  }

  void legs_definition(const char* type, PlainTheorem& theorem) {
    Words words{sentences_.words(), 2};
    for (const char* word : {":", "list", type}) expect_word(words, word);
    geometric_definition(words, {}, theorem);
  }
  /// The names of its joints are its own.
  void arm_definition(PlainTheorem& theorem) {
    Words words{sentences_.words(), 2};
    const std::vector<std::string> joints = binders(words);
    for (const char* word : {":", "list", "part"}) expect_word(words, word);
    geometric_definition(words, joints, theorem);
  }

  /// Reads `let _name := value in`, as often as it stands there. Each name is new, and is no word.
  void matrix_definition(PlainTheorem& theorem) {
    Words words{sentences_.words(), 2};
    std::vector<std::string> names = binders(words);
    for (const char* word : {":", "nat", "->", "nat", "->", "R", ":="}) expect_word(words, word);
    while (words.next() == "let") {
      ++words.at;
      const std::string name(words.next());
      if (!name.starts_with('_') || !is_quantity(name) ||
          std::ranges::find(names, name) != names.end())
        sentences_.fail("'" + name + "' is no name of a model file, or is one twice");
      ++words.at;
      expect_word(words, ":=");
      const std::size_t begin = words.at;
      while (words.next() != "in" && words.at < words.all.size()) ++words.at;
      check_part({words.all, begin}, words.at, names, [](std::string_view) { return false; });
      expect_word(words, "in");
      names.push_back(name);
    }
    if (words.next() != "matrix_of" && words.next() != "scaled")
      sentences_.fail("expected let, matrix_of or scaled");
    check_geometric_words(words, names, [](std::string_view word) {
      return word == "matrix_of" || word == "scaled";
    });
    keep_definition(theorem);
  }

  /// Reads `Theorem NAME :`.
  Words theorem_named(const char* name) const {
    Words words{sentences_.words()};
    for (const char* word : {"Theorem", name, ":"}) expect_word(words, word);
    return words;
  }

  void add_theorem(const char* name, PlainTheorem& theorem) {
    const Sentence& all = sentences_.words();
    theorem.geometry.push_back({name, joined({all.begin() + 3, all.end()})});
    sentences_.next();
    sentences_.expect("Proof");
  }

  /// Full rank or a large determinant at all poses, or a determinant that is small or 0 at one.
  void robot(const std::vector<std::string>& names, PlainTheorem& theorem) {
    constexpr const char* kName = "the_robot";
    Words words = theorem_named(kName);
    is_singular_ = words.next() == "exists" || (names.empty() && names_a_pose());
    expect_binders(words, is_singular_ ? "exists" : "forall", names);
    expect_set(words, names);
    expect_word(words, is_singular_ ? "/\\" : "->");
    check_geometric_words(words, names,
                          [this](std::string_view word) { return is_of_conclusion(word); });
    add_theorem(kName, theorem);
    geometric_proof(names);
  }

  [[nodiscard]] bool is_of_conclusion(std::string_view word) const {
    constexpr auto kOfAll =
        std::to_array<std::string_view>({"full_column_rank", "determinant", "<", "="});
    constexpr auto kOfGough = std::to_array<std::string_view>({"gough", "inverse_jacobian"});
    constexpr auto kOfArms = std::to_array<std::string_view>(
        {"full_row_rank", "jacobian", "jacobian_seen", "rows_of", "v_x", "v_y", "v_z", "w_x", "w_y",
         "w_z", "columns_depend"});
    if (is_one_of(word, kOfAll) || (!robot_.empty() && word == robot_)) return true;
    if (library_ == Library::kGeometry) return is_one_of(word, kOfGough);
    if (library_ == Library::kLegs)
      return is_one_of(word, kMatrixOfLegsWords) || is_one_of(word, kLegWords);
    return library_ == Library::kArms && (is_one_of(word, kOfArms) || is_one_of(word, kPartWords));
  }

  /// A motion without quantities has one pose.
  [[nodiscard]] bool names_a_pose() const {
    return sentences_.current().find("the_set /\\ ") != std::string::npos;
  }

  void point(const std::vector<std::string>& names, PlainTheorem& theorem) {
    constexpr const char* kName = "the_set_is_inhabited";
    Words words = theorem_named(kName);
    expect_binders(words, "exists", names);
    expect_set(words, names);
    if (words.at != words.all.size()) sentences_.fail("expected the end of the sentence");
    add_theorem(kName, theorem);
    geometric_proof(names);
  }

  /// Whatever it does, Coq checks it; no word of it can do anything else.
  void geometric_proof(const std::vector<std::string>& names) {
    for (; !sentences_.at_end() && sentences_.current() != "Qed"; sentences_.next())
      check_geometric_words({sentences_.words()}, names, [](std::string_view word) {
        return word.starts_with('_') || is_one_of(word, kProofWords);
      });
    sentences_.expect("Qed");
  }

  PlainSentences& sentences_;
  const Library library_;
  std::string robot_;         ///< its own name
  bool is_singular_ = false;  ///< the theorem about the robot names a pose
};

}  // namespace

void read_plain_geometry(PlainSentences& sentences, PlainTheorem& theorem) {
  constexpr std::string_view kImport = "From Regulus Require Import ";
  const std::string import = sentences.current();
  for (const auto& [file, library] :
       {std::pair("Geometry", Library::kGeometry), std::pair("Arms", Library::kArms),
        std::pair("Matrices", Library::kMatrices), std::pair("Legs", Library::kLegs)})
    if (import == std::string(kImport) + file) GeometryReader(sentences, library).read(theorem);
}

}  // namespace regulus::verifier
