// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/report_options.hpp"

#include <CLI/CLI.hpp>

namespace regulus::detail {

void add_report_options(CLI::App& app, ReportCommand& command) {
  app.add_option("-o,--output", command.page, "The page to write, for any browser, offline")
      ->required()
      ->type_name("FILE.html");
  app.add_flag("--paving", command.paves, "Add the boxes of `regulus locate`");
  app.add_option(
         "--resolution", command.resolution,
         "Of the paving, as for locate: split boxes until each side is at most this part of "
         "its range")
      ->type_name("R");
  app.add_option("--bound", command.bounds,
                 "Add the bracket of a quantity of `regulus bound`; may be repeated")
      ->take_all()
      ->expected(1)
      ->type_name("QUANTITY");
  app.add_option("--load", command.load, "Set of wrenches for the bounds: NAME of a [load.NAME]")
      ->type_name("NAME");
  app.add_option("--twist", command.twist, "Set of twists for the bounds: NAME of a [twist.NAME]")
      ->type_name("NAME");
  app.add_option(
         "--margin", command.margins,
         "Add the bracket of the largest safe tolerance of `regulus margin`; may be repeated")
      ->take_all()
      ->expected(1)
      ->type_name("GROUP=LO:HI");
  app.add_option("--gap", command.gap,
                 "Stop a bracket when it is at most this part of its larger end")
      ->type_name("G")
      ->capture_default_str();
}

}  // namespace regulus::detail
