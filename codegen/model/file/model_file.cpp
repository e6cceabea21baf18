// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/model_file.hpp"

#include <algorithm>
#include <array>
#include <cfenv>
#include <initializer_list>
#include <system_error>

#include "codegen/model/constants.hpp"
#include "codegen/model/file/read_file.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/file/source_lines.hpp"
#include "codegen/model/file/toml_limits.hpp"
#include "codegen/model/mechanism/joint_limits.hpp"
#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/visible_text.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus::detail {
namespace {

/// Sets the usual rounding: a library that reads a decimal as a double may use the caller's
/// rounding, and its double is compared with the exact number.
class UsualArithmetic {
 public:
  UsualArithmetic() {
    std::fegetenv(&callers_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~UsualArithmetic() { std::fesetenv(&callers_); }
  UsualArithmetic(const UsualArithmetic&) = delete;
  UsualArithmetic& operator=(const UsualArithmetic&) = delete;

 private:
  std::fenv_t callers_{};
};

/// True if the library stopped at a number that neither its doubles nor its integers can hold, or
/// that is longer than its buffer.
bool is_about_a_large_number(std::string_view description) {
  for (const char* words : {"not representable in 64 bits", "could not be interpreted as a value",
                            "exceeds length limit", "too long"})
    if (description.find(words) != std::string_view::npos) return true;
  return false;
}

constexpr std::string_view kNumerals = "0123456789", kOperators = "+-*/^._()";
constexpr std::string_view kLatinLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

bool is_in_expression(char c) {
  return std::ranges::any_of(std::array{kNumerals, kOperators, kLatinLetters},
                             [c](std::string_view some) { return some.find(c) != some.npos; });
}

/// Returns the word where TOML stopped.
std::string word_at(std::string_view text, const toml::source_position& at) {
  const std::size_t stop = std::min(SourceLines(text).offset(at.line, at.column), text.size());
  std::size_t begin = stop, end = stop;
  while (begin > 0 && is_in_expression(text[begin - 1])) --begin;
  while (end < text.size() && is_in_expression(text[end])) ++end;
  return std::string(text.substr(begin, end - begin));
}

/// Returns true for 30deg, -pi/12.
bool seems_an_expression(const std::string& word) {
  const bool begins_so = word.starts_with("pi") || word.find_first_of("0123456789.+-(") == 0;
  const bool goes_on_so =
      word.find_first_of(kLatinLetters) != word.npos || word.find_first_of("*/^(") != word.npos;
  return begins_so && goes_on_so;
}

/// Returns what would be TOML at this place.
std::string remedy_at(std::string_view text, const toml::parse_error& error) {
  const std::string word = word_at(text, error.source().begin);
  if (seems_an_expression(word)) return "an expression as text, in quotes: \"" + word + '"';
  const bool is_value = error.description().find("value") != std::string_view::npos;
  const bool is_text = !word.empty() && kLatinLetters.find(word[0]) != std::string_view::npos;
  return is_value && is_text ? "text in quotes: \"" + word + '"' : "TOML 1.0";
}

toml::table parse_toml(std::string_view text, const std::string& file) try {
  require_toml_limits(text, file);
  return toml::parse(text);
} catch (const toml::parse_error& error) {
  const int line = static_cast<int>(error.source().begin.line);
  if (is_about_a_large_number(error.description()))
    throw InputError(file, line,
                     "a number that TOML cannot hold (" + visible(error.description()) + ")",
                     "the number in a string, \"1e400\", where it may have 1000 digits");
  throw InputError(file, line, "text that is not TOML (" + visible(error.description()) + ")",
                   remedy_at(text, error));
}

void check_version(const TomlReader& toml, const TomlEntry& root) {
  const TomlEntry version = toml.optional(root, "regulus");
  if (!version.node)
    toml.reject(root, "there is no version of the format", "the file must begin with: regulus = 1");
  const auto* number = version.node->as_integer();
  if (!number || number->get() != 1) toml.refuse(version, "the format version 1");
}

void read_header(ModelReading& reading, const TomlEntry& root) {
  check_version(reading.toml, root);
  reading.model.name = reading.toml.label(reading.toml.required(root, "name"));
  const TomlEntry source = reading.toml.optional(root, "source");
  if (source.node) reading.model.source = reading.toml.label(source);
}

void read_constants(ModelReading& reading, const TomlEntry& root) {
  const TomlReader& toml = reading.toml;
  if (const TomlEntry e = toml.optional(root, "geometry"); e.node) read_geometry(reading, e);
  if (const TomlEntry e = toml.optional(root, "let"); e.node) read_let(reading, e);
}

/// Refuses tables that a family of robots leaves no place for.
void refuse_beside(const TomlReader& toml, const TomlEntry& root, const std::string& family,
                   std::initializer_list<const char*> others) {
  for (const char* key : others)
    if (const TomlEntry e = toml.optional(root, key); e.node)
      toml.reject(e, std::string("[") + key + "] cannot be used together with [" + family + "]",
                  "remove one of them");
}

/// Reads the robot in one of its forms.
void read_robot(ModelReading& reading, const TomlEntry& root) {
  const TomlReader& toml = reading.toml;
  const TomlEntry gough = toml.optional(root, "gough"), serial = toml.optional(root, "serial");
  if (gough.node) {
    refuse_beside(toml, root, "gough", {"closure", "pose", "matrix", "serial", "legs", "drawing"});
    read_constants(reading, root);
    return read_gough(reading, gough);
  }
  if (serial.node) {
    refuse_beside(toml, root, "serial", {"closure", "pose", "matrix", "legs", "drawing"});
    read_constants(reading, root);
    return read_serial(reading, serial);
  }
  if (const TomlEntry legs = toml.optional(root, "legs"); legs.node) {
    refuse_beside(toml, root, "legs", {"closure", "pose", "matrix", "drawing"});
    read_constants(reading, root);
    return read_legs(reading, legs);
  }
  if (const TomlEntry closure = toml.optional(root, "closure"); closure.node) {
    refuse_beside(toml, root, "closure", {"matrix", "drawing", "twist"});
    read_pose(reading, toml.required(root, "pose"));
    read_unknowns(reading, closure);
    read_constants(reading, root);
    return read_closure(reading, closure);
  }
  read_pose(reading, toml.required(root, "pose"));
  read_constants(reading, root);
  read_matrix(reading, toml.required(root, "matrix"));
  if (const TomlEntry e = toml.optional(root, "drawing"); e.node) read_drawing(reading, e);
}

/// Reads the tables for bounds of forces, errors and speeds.
void read_strength(ModelReading& reading, const TomlEntry& root) {
  const TomlReader& toml = reading.toml;
  const auto read = [&](const char* key, void (*section)(ModelReading&, const TomlEntry&)) {
    if (const TomlEntry e = toml.optional(root, key); e.node) section(reading, e);
  };
  read("characteristic_length", read_characteristic_length);
  read("load", read_loads);
  read("twist", read_twists);
  read("actuators", read_actuators);
}

AskedExpression read_asked(ModelReading& reading, const std::string& text) try {
  const Place place{.file = "", .key = in_quotes(text)};
  const ParsedExpression term = parse_expression(text, reading.names, place);
  if (depends_on_unknown(reading.model, term))
    throw InputError::statement(place.file, place.line,
                                place.key + " depends on the unknowns of [closure]",
                                "write an expression of pose parameters and constants", place.key);
  return {term.value, term.must_be_defined};
} catch (const InputError& error) {
  throw UsageError(error.what());
}

}  // namespace

std::string read_model_text(const std::filesystem::path& path) {
  const auto fail = [&path](const std::string& why) -> FileError {
    return FileError("cannot read " + in_quotes(path.string()) + ": " + why);
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw fail("no such file; regulus list names the installed models");
  if (std::filesystem::is_directory(status)) throw fail("it is a directory");
  // One byte more than allowed, so that parse_model can refuse it in terms of the model.
  return read_start(path.string(), kLargestModelFile + 1, Readable::kStream);
}

Model parse_model(std::string_view text, const std::string& name_for_errors,
                  const std::string& asked, const FormingWatch* watch) {
  static const std::array<std::string, 17> kKeys = {"regulus",
                                                    "name",
                                                    "source",
                                                    "pose",
                                                    "geometry",
                                                    "let",
                                                    "matrix",
                                                    "gough",
                                                    "serial",
                                                    "legs",
                                                    "closure",
                                                    "drawing",
                                                    "motion",
                                                    "load",
                                                    "twist",
                                                    "actuators",
                                                    "characteristic_length"};
  if (text.size() > kLargestModelFile)
    throw InputError::statement(
        name_for_errors, 0, "the file is too large",
        "a model file has at most " + std::to_string(kLargestModelFile) + " bytes");
  const UsualArithmetic scope;
  const toml::table document = parse_toml(text, name_for_errors);
  // A reading has no progress to show. A small model is read in any case: a report needs it.
  const FormingWatch limits =
      watch != nullptr ? FormingWatch{watch->deadline, watch->interrupt} : FormingWatch{};
  ModelReading reading{.toml = TomlReader(name_for_errors, text),
                       .meter = WorkMeter(WorkMeter::kNoLimit, &limits, WorkStage::kSubstitution,
                                          WorkMeter::kBetweenLooks)};
  const TomlEntry root{.key = {}, .path = {}, .node = &document, .line = 1};
  (void)reading.toml.entries(root, kKeys);

  read_header(reading, root);
  read_robot(reading, root);
  read_strength(reading, root);
  if (!asked.empty()) reading.model.asked = read_asked(reading, asked);
  // A family may make a motion of its own.
  const TomlEntry motions = reading.toml.optional(root, "motion");
  if (motions.node || reading.model.motions.empty())
    read_motions(reading, reading.toml.required(root, "motion"));
  if (reading.model.matrix_kind != MatrixKind::kInverse)
    reading.model.limits = limits_of_joints(reading.model);
  warn_about_written_angles(reading, root);
  reading.model.must_be_defined = distinct(reading.model.must_be_defined);
  reading.model.sha256 = sha256(text);
  return std::move(reading.model);
}

Model load_model(const std::filesystem::path& path) {
  Model model = parse_model(read_model_text(path), path.string());
  model.path = path.string();
  return model;
}

}  // namespace regulus::detail
