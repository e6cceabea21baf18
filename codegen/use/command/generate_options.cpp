// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/generate_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <future>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/report_text.hpp"
#include "codegen/kernel/cpp/write_files.hpp"
#include "codegen/kernel/jit/object_file.hpp"
#include "codegen/support/earlier_outputs.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/write_file.hpp"

namespace regulus::detail {
namespace {

GenerateOptions generate_options(const GenerateCommand& command, const Request& request,
                                 const std::string& typed) {
  GenerateOptions options;
  options.name = command.name.empty() ? default_kernel_name(request) : command.name;
  options.name_space = command.name_space;
  for (const std::string& isa : command.isas) options.isas.push_back(parse_isa(isa).value());
  options.command = typed;
  return options;
}

/// Throws FileError if the files have no place. The folder need not exist yet.
void require_room(const GenerateCommand& command) {
  require_room_in(command.folder);
  if (command.dependencies.empty()) return;
  const auto whole = [](const std::filesystem::path& path) {
    return (std::filesystem::absolute(path) / "").lexically_normal();
  };
  OutputFile rule{"--depfile", command.dependencies};
  rule.continues = true;  // replaced in its place, as the kernel's files are
  const std::filesystem::path file = std::filesystem::absolute(rule.path);
  if (whole(file.parent_path()) != whole(command.folder)) set_earlier_outputs_aside({}, {rule});
}

std::string compiled(const GeneratedFile& source, const std::vector<NamedText>& headers, Isa isa) {
  try {
    return compile_object_file({source.name, source.text}, headers, isa);
  } catch (const NoCompiler& error) {
    throw UsageError(std::string("--object: no compiler is available (") + error.what() +
                     "); leave the option out, and compile the C++ text");
  }
}

/// Adds NAME_<isa>.o for each NAME_<isa>.cpp.
void add_objects(std::vector<GeneratedFile>& files, const GenerateOptions& options) {
  const auto kernel = std::ranges::find(files, options.name + "_kernel.inc", &GeneratedFile::name);
  const std::vector<NamedText> headers = {{kernel->name, kernel->text}};
  std::vector<std::pair<std::string, std::future<std::string>>> objects;
  for (const Isa isa : kAllIsas) {
    const std::string name = options.name + "_" + std::string(regulus::name(isa));
    const auto source = std::ranges::find(files, name + ".cpp", &GeneratedFile::name);
    if (source == files.end()) continue;
    objects.emplace_back(name + ".o", std::async(std::launch::async, [source, &headers, isa] {
                           return compiled(*source, headers, isa);
                         }));
  }
  std::vector<GeneratedFile> added;
  for (auto& [name, object] : objects) added.push_back({name, object.get()});
  std::ranges::move(added, std::back_inserter(files));
}

nlohmann::ordered_json json_list(const std::string& name, const std::filesystem::path& folder,
                                 const std::vector<GeneratedFile>& files) {
  nlohmann::ordered_json list = {{"name", name}, {"files", nlohmann::json::array()}};
  for (const GeneratedFile& file : files) list["files"].push_back((folder / file.name).string());
  return list;
}

}  // namespace

void add_model_changes(CLI::App& app, ModelOptions& options) {
  app.add_option("--range", options.ranges,
                 "Range of a motion parameter, p=LO:HI, or its value, p=V; expressions allowed: "
                 "psi=-5*deg:5*deg")
      ->take_all()
      ->expected(1)
      ->type_name("p=LO:HI");
  app.add_option("--tolerance", options.tolerances,
                 "Tolerance of a group of constants, e.g. base,platform=0.1")
      ->take_all()
      ->expected(1)
      ->type_name("GROUP=E");
  app.add_option("--alpha", options.alpha, "Threshold: certify |det J^-1| > A instead of full rank")
      ->type_name("A");
  app.add_flag("--beyond-limits", options.beyond_limits,
               "Let the question leave the limits of the joints, which the model file gives");
}

void add_generate_options(CLI::App& app, GenerateCommand& command) {
  app.add_option("-o,--output", command.folder,
                 "Folder for the files; it is created if it does not exist")
      ->required()
      ->type_name("DIR");
  app.add_option("--isa", command.isas,
                 "Instruction sets to generate code for; your program chooses among them when it "
                 "runs. portable is always included")
      ->delimiter(',')
      ->check(CLI::IsMember({"avx512", "avx2", "portable"}))
      ->expected(1)
      ->take_all()
      ->type_name("ISA,...")
      ->default_str("avx512,avx2,portable");
  app.add_option(
         "--name", command.name,
         "Name of the files and symbols; the default is made of the model file and the motion")
      ->type_name("NAME");
  app.add_option("--namespace", command.name_space, "Namespace of the C++ header; default NAME")
      ->type_name("NS");
  app.add_option("--depfile", command.dependencies,
                 "Also write a dependency file for make and Ninja")
      ->type_name("FILE");
  app.add_flag("--object", command.object,
               "Also compile the kernel for each instruction set, in process: NAME_ISA.o");
  app.add_flag("--json", command.json, "Print the list on standard output, as one JSON object");
  app.add_flag("--quiet", command.quiet, "Do not list the files (unless as JSON)");
}

void generate_files(const GenerateCommand& command, const Request& request,
                    const std::string& typed) {
  const std::filesystem::path folder = command.folder;
  require_room(command);
  const GenerateOptions options = generate_options(command, request, typed);
  std::vector<GeneratedFile> files = generate(request, options);
  if (command.object) add_objects(files, options);
  const std::string dependencies =
      command.dependencies.empty() ? "" : dependency_text(folder, files, request.model.path);
  write_files(folder, files);
  if (!command.dependencies.empty()) write_file(command.dependencies, dependencies);
  if (command.json)
    std::cout << report_text(json_list(options.name, folder, files), command.json_indent) << '\n';
  else if (!command.quiet)
    for (const GeneratedFile& file : files) std::cout << (folder / file.name).string() << '\n';
  if (!std::cout.flush()) throw FileError("standard output cannot be written");
}

}  // namespace regulus::detail
