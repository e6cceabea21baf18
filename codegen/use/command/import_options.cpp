// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/import_options.hpp"

#include <CLI/CLI.hpp>

namespace regulus::detail {
namespace {

constexpr const char* kImportFooter =
    "The model of an arm has two motions: limits, the ranges of the joints in the\n"
    "file, and home, every joint at zero; that of a robot with loops has home and\n"
    "around_home, its motors within 5 degrees of it. Loops of a URDF file come from\n"
    "--cut, --weld, <constraint> elements, or from FILE.yaml beside it. From a file\n"
    "to a verdict: codegen/model/import/IMPORTING.md.\n"
    "Exit: 0 written; 64 usage, 65 bad file, 70 internal fault, 74 file error.";

void add_loop_options(CLI::App& app, ImportOptions& options) {
  app.add_option(
         "--cut", options.cuts,
         "Two links, or joints before them, whose origins are one point: a loop that a URDF file "
         "cannot have; may be repeated")
      ->take_all()
      ->expected(1)
      ->type_name("LINK=LINK");
  app.add_option("--weld", options.welds,
                 "Two links whose frames are one: a body that a URDF file has in two parts; may be "
                 "repeated")
      ->take_all()
      ->expected(1)
      ->type_name("LINK=LINK");
  app.add_option(
         "--actuated", options.actuated,
         "Driven joints of a robot with loops; default: those that the file says are driven; "
         "of legs in a plane, the joint at the base, or the one that slides")
      ->take_all()
      ->expected(1)
      ->type_name("JOINT,JOINT");
  app.add_option("--at", options.at,
                 "Where the loops are closed from, for joints that are not at zero: a motor stays "
                 "there, a passive joint begins there; may be repeated")
      ->take_all()
      ->expected(1)
      ->type_name("JOINT=VALUE");
  app.add_flag(
      "--closure", options.closure,
      "Write the equations of the loops as [closure], also where [gough] or [legs] says it "
      "in fewer words");
}

}  // namespace

void add_import_options(CLI::App& app, ImportCommand& command) {
  app.add_option("FILE", command.path, "Robot file of another program: URDF, MJCF or SDF")
      ->required();
  app.add_option("-o,--output", command.output, "Model file to write; default: standard output")
      ->type_name("MODEL.toml");
  app.add_option("--base", command.options.base,
                 "Link that the arm stands on; default: the link without a parent")
      ->type_name("LINK");
  app.add_option("--tip", command.options.tip,
                 "Link at the end of the arm; default: the link behind its last joint, if the file "
                 "has no branches")
      ->type_name("LINK");
  add_loop_options(app, command.options);
  app.add_option("--snap", command.options.snap,
                 "Take a number within this distance of a multiple of pi/12, or of a decimal with "
                 "fewer digits, for that number; each is reported. 0: take all numbers as they are")
      ->type_name("DISTANCE")
      ->capture_default_str();
  app.add_flag("--quiet", command.quiet, "Do not report what was read");
  app.add_flag("--json", command.json,
               "Print the model and the report on standard output, as one JSON object");
  app.footer(kImportFooter);
}

}  // namespace regulus::detail
