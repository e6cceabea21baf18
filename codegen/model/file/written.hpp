// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of a model file that is written from C++, each with its place in C++.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "codegen/model/exact/formula.hpp"
#include "codegen/support/errors.hpp"

namespace regulus {

struct WrittenLine {
  std::string key, value;
  SourcePlace place;
};

using WrittenSection = std::vector<WrittenLine>;

/// Throws InputError that names `what` if the section already has the key.
void write_once(WrittenSection& section, const std::string& what, WrittenLine line);

// Values of TOML.
[[nodiscard]] std::string written(std::string_view label);
[[nodiscard]] std::string written(const Formula& formula);
[[nodiscard]] std::string written(const std::vector<Formula>& formulas);
/// Returns a key, in quotes if TOML requires them.
[[nodiscard]] std::string written_key(const std::string& key);

/// The symbols of GiNaC that a robot declares and uses. GiNaC distinguishes two symbols of the same
/// name, and a model file does not, so every symbol used must be the declared one.
class WrittenSymbols {
 public:
  void declare(const GiNaC::symbol& symbol);
  void use(const Formula& formula, const SourcePlace& place);
  void use(const std::vector<Formula>& formulas, const SourcePlace& place);

  /// Throws InputError for a symbol that neither this nor `outer` declares.
  void require_declared(const WrittenSymbols* outer = nullptr) const;

 private:
  struct Use {
    GiNaC::ex symbol;
    SourcePlace place;
  };
  [[nodiscard]] bool declares(const GiNaC::ex& symbol) const;

  std::map<std::string, GiNaC::ex> declared_;
  std::vector<Use> used_;
};

/// Returns an error that names a line of C++: "PROBLEM; REMEDY".
[[nodiscard]] InputError mistake(const SourcePlace& place, const std::string& problem,
                                 const std::string& remedy, const std::string& symbol = {});

}  // namespace regulus
