// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/engine/ingredients.hpp"

#include <fmt/format.h>

namespace regulus::inline engine {
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
    {"rewriting", "forms in which variables occur less often", keep_search,
     [](FormulationOptions& f) { f.rewriting.rewrite = false; }},
    {"nesting", "Horner's among these", keep_search,
     [](FormulationOptions& f) { f.rewriting.horner = false; }},
    {"angles", "sums of angles among these", keep_search,
     [](FormulationOptions& f) { f.rewriting.trigonometric = false; }},
    {"squares", "completed squares among these", keep_search,
     [](FormulationOptions& f) { f.rewriting.nesting.complete_squares = false; }},
    {"factoring", "common factors among these", keep_search,
     [](FormulationOptions& f) { f.rewriting.nesting.factor = false; }},
    {"columns", "column operations of determinant 1", keep_search,
     [](FormulationOptions& f) { f.columns = ColumnSearch::kNone; }},
    {"natural", "the test on K·J^-1 as rewritten",
     [](Settings& s) { s.ingredients.natural = false; }, keep_functions},
    {"mean-value", "the test on its mean-value form",
     [](Settings& s) { s.ingredients.mean_value = false; }, keep_functions},
    {"second-order", "the test on its expansion",
     [](Settings& s) { s.ingredients.second_order = false; },
     [](FormulationOptions& f) { f.expansion = ExpansionForm::kNone; }},
    {"moving", "a K that moves with the pose in that",
     [](Settings& s) { s.ingredients.moving = false; }, keep_functions},
    {"rows", "uncertain quantities taken by the row they touch",
     [](Settings& s) { s.ingredients.rows = false; },
     [](FormulationOptions& f) { f.rows = false; }},
    {"balls", "points in balls taken by their norm",
     [](Settings& s) { s.ingredients.balls = false; }, keep_functions},
    {"orthants", "direction by direction of the uncertain rows",
     [](Settings& s) { s.ingredients.orthants = false; }, keep_functions},
    {"midpoints", "witnesses sought at the middles of boxes",
     [](Settings& s) { s.ingredients.midpoints = false; }, keep_functions},
    {"corners", "at corners", [](Settings& s) { s.ingredients.corners = false; }, keep_functions},
    {"descents", "downhill", [](Settings& s) { s.ingredients.descents = false; }, keep_functions},
    {"stall", "stopping if only uncertainty makes the tests fail",
     [](Settings& s) { s.ingredients.stall = false; }, keep_functions},
    {"batch", "eight boxes at a time", [](Settings& s) { s.batch = 1; }, keep_functions},
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

}  // namespace regulus::engine
