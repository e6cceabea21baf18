// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/ingredients.hpp"

#include <fmt/format.h>

namespace regulus::detail {
namespace {

struct Ingredient {
  const char* name;
  const char* meaning;
  void (*leave_out_of_search)(Settings&);
  void (*leave_out_of_functions)(FormulationOptions&);
};

void keep_search(Settings&) {}
void keep_functions(FormulationOptions&) {}

constexpr Ingredient kIngredients[] = {
    {"rewriting", "rewriting of expressions, so that variables occur less often", keep_search,
     [](FormulationOptions& f) { f.rewriting.rewrite = false; }},
    {"nesting", "rewriting into Horner's form", keep_search,
     [](FormulationOptions& f) { f.rewriting.horner = false; }},
    {"angles", "rewriting of sines and cosines into sums of angles", keep_search,
     [](FormulationOptions& f) { f.rewriting.trigonometric = false; }},
    {"squares", "rewriting into completed squares", keep_search,
     [](FormulationOptions& f) { f.rewriting.nesting.complete_squares = false; }},
    {"factoring", "rewriting with common factors", keep_search,
     [](FormulationOptions& f) { f.rewriting.nesting.factor = false; }},
    {"columns", "column operations of determinant 1", keep_search,
     [](FormulationOptions& f) { f.columns = ColumnSearch::kNone; }},
    {"natural", "the test on K·J^-1 as rewritten",
     [](Settings& s) { s.ingredients.natural = false; }, keep_functions},
    {"mean-value", "the test on the mean-value form of K·J^-1",
     [](Settings& s) { s.ingredients.mean_value = false; }, keep_functions},
    {"second-order", "the test on the second-order expansion of K·J^-1",
     [](Settings& s) { s.ingredients.second_order = false; },
     [](FormulationOptions& f) { f.expansion = ExpansionForm::kNone; }},
    {"moving", "a K that depends on the pose, in the second-order test",
     [](Settings& s) { s.ingredients.moving = false; }, keep_functions},
    {"rows", "uncertain quantities grouped by the row in which they occur",
     [](Settings& s) { s.ingredients.rows = false; },
     [](FormulationOptions& f) { f.rows = false; }},
    {"balls", "bounds of points in balls by their norm",
     [](Settings& s) { s.ingredients.balls = false; }, keep_functions},
    {"orthants", "the test of uncertain rows, direction by direction",
     [](Settings& s) { s.ingredients.orthants = false; }, keep_functions},
    {"midpoints", "the search for witnesses at midpoints of boxes",
     [](Settings& s) { s.ingredients.midpoints = false; }, keep_functions},
    {"corners", "the search for witnesses at corners of boxes",
     [](Settings& s) { s.ingredients.corners = false; }, keep_functions},
    {"descents", "the search for witnesses by descent",
     [](Settings& s) { s.ingredients.descents = false; }, keep_functions},
    {"stall", "stopping early if only uncertain quantities make the tests fail",
     [](Settings& s) { s.ingredients.stall = false; }, keep_functions},
    {"batch", "evaluation of eight boxes at a time", [](Settings& s) { s.batch = 1; },
     keep_functions},
};

template <typename LeaveOut>
void for_each_named(const std::vector<std::string>& names, LeaveOut&& leave_out_of) {
  for (const Ingredient& ingredient : kIngredients)
    for (const std::string& name : names)
      if (name == ingredient.name) leave_out_of(ingredient);
}

}  // namespace

std::vector<std::string> ingredient_names() {
  std::vector<std::string> names;
  for (const Ingredient& ingredient : kIngredients) names.emplace_back(ingredient.name);
  return names;
}

std::string describe_ingredient() {
  std::string words;
  for (const Ingredient& ingredient : kIngredients)
    words += fmt::format("\n  {:13} {}", ingredient.name, ingredient.meaning);
  return words;
}

void leave_out(const std::vector<std::string>& names, Settings& settings) {
  for_each_named(names, [&](const Ingredient& x) { x.leave_out_of_search(settings); });
}

void leave_out(const std::vector<std::string>& names, FormulationOptions& functions) {
  for_each_named(names, [&](const Ingredient& x) { x.leave_out_of_functions(functions); });
}

}  // namespace regulus::detail
