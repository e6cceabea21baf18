// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/cpp/generate.hpp"

#include <filesystem>

#include "codegen/kernel/cpp/emit.hpp"
#include "codegen/kernel/cpp/headers.hpp"
#include "codegen/kernel/cpp/words.hpp"
#include "codegen/kernel/formulation/functions_needed.hpp"

namespace regulus::detail {

std::string default_kernel_name(const Request& request) {
  const std::string model = request.model.path.empty()
                                ? request.model.name
                                : std::filesystem::path(request.model.path).stem().string();
  return free_name(model + "_" + request.motion.name);
}

std::vector<GeneratedFile> generate(const Request& request, const GenerateOptions& options) {
  const Formulation formulation =
      formulate(request.model, request.motion, functions_needed(Method::kAuto));
  KernelSubject subject = kernel_subject(request, formulation, options);
  EmitOptions emission;
  emission.prefix = subject.name;
  emission.command = subject.command;
  emission.source = subject.source;
  const EmittedKernel kernel = emit(lower(formulation), emission);
  subject.identity = kernel.identity;

  std::vector<GeneratedFile> files = {{subject.name + ".h", c_header(subject)},
                                      {subject.name + ".hpp", cpp_header(subject)},
                                      {subject.name + ".cpp", dispatch_source(subject)},
                                      {subject.name + "_kernel.inc", kernel.source}};
  for (const Isa isa : subject.isas)
    files.push_back(
        {subject.name + "_" + std::string(regulus::name(isa)) + ".cpp", isa_source(subject, isa)});
  return files;
}

}  // namespace regulus::detail
