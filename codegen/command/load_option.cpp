// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/command/load_option.hpp"

#include <CLI/CLI.hpp>
#include <array>

namespace regulus::inline command {
namespace {

struct ForeignOption {
  const char* name;
  const char* why;
};

constexpr const char* kOneMethod = "with --load there is one method";

constexpr std::array<ForeignOption, 15> kForeign = {
    {{"--alpha", "forces have no threshold; change the limits in [actuators]"},
     {"--shard-size", "a proof with --load stays in one file"},
     {"--checkpoint", "a search with --load cannot be continued; divide the ranges instead"},
     {"--checkpoint-every", "a search with --load cannot be continued; divide the ranges instead"},
     {"--picture", "draw the boxes of --output instead"},
     {"--axes", "draw the boxes of --output instead"},
     {"--slices", "draw the boxes of --output instead"},
     {"--shade", "draw the boxes of --output instead"},
     {"--filter", "a filter tests a matrix, not forces"},
     {"--method", kOneMethod},
     {"--determinant", kOneMethod},
     {"--entries", kOneMethod},
     {"--bisect", kOneMethod},
     {"--uncertainty", kOneMethod},
     {"--precision", kOneMethod}}};

void refuse_foreign_options(const CLI::App& app) {
  if (app.count("--load") == 0) return;
  for (const ForeignOption& option : kForeign) {
    const CLI::Option* given = app.get_option_no_throw(option.name);
    if (given != nullptr && given->count() > 0) throw CLI::ValidationError(option.name, option.why);
  }
}

}  // namespace

void add_load_option(CLI::App& app, std::optional<std::string>& load) {
  app.add_option("--load", load,
                 "Ask instead whether the motors hold every wrench of [load.NAME] with forces "
                 "within [actuators] force, at every pose: FEASIBLE, INFEASIBLE or POSSIBLE "
                 "PROBLEM")
      ->type_name("NAME");
  app.callback([&app] { refuse_foreign_options(app); });
}

}  // namespace regulus::command
