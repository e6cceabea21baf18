// SPDX-License-Identifier: GPL-3.0-or-later
#include <cfenv>
#include <csignal>
#include <iostream>

#include "regulus/codegen/driver/commands.hpp"
#include "regulus/codegen/driver/exit_code.hpp"
#include "regulus/codegen/driver/pipeline.hpp"
#include "regulus/codegen/jit/jit.hpp"
#include "regulus/codegen/model/errors.hpp"
#include "regulus/codegen/symbolic/determinant.hpp"

namespace {

using namespace regulus::codegen;

int run(const CommandLine& line, const std::string& command) {
  if (line.exit_code) return *line.exit_code;
  if (line.check) return run_check(*line.check);
  if (line.locate) return run_locate(*line.locate);
  if (line.margin) return run_margin(*line.margin);
  if (line.verify) return run_verify(*line.verify);
  return run_explain(*line.explain, command);
}

/// A file that may not grow is trouble to be reported, not a signal to die of.
void report_file_limits() { std::signal(SIGXFSZ, SIG_IGN); }

/// A library that was loaded before may have changed the rounding, or have subnormals flushed:
/// reading numbers and starting threads would inherit that.
void start_with_the_usual_arithmetic() { std::fesetenv(FE_DFL_ENV); }

/// The exit code says what was shown, unless nobody could read it.
int with_output_written(int exit_code) {
  std::cout.flush();
  if (!std::cout) throw FileError("cannot write standard output");
  return exit_code;
}

int complain(const std::exception& error, ExitCode code) {
  std::cerr << "regulus: " << error.what() << '\n';
  return code;
}

/// The words that were typed, the program by its name alone: a path means nothing elsewhere.
std::string typed(int argc, char** argv) {
  std::string command = "regulus";
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  return command;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    report_file_limits();
    start_with_the_usual_arithmetic();
    return with_output_written(run(parse_command_line(argc, argv), typed(argc, argv)));
  } catch (const UsageError& error) {
    return complain(error, kUsageError);
  } catch (const ClosedFormError& error) {
    std::cerr << "regulus: --method closed-form: " << error.what() << '\n';
    return kUsageError;
  } catch (const InputError& error) {
    return complain(error, kBadInput);
  } catch (const FileError& error) {
    return complain(error, kFileTrouble);
  } catch (const CompileError& error) {
    std::cerr << "regulus: internal error: the generated kernel did not compile\n"
              << error.what() << "\n--- the text ---\n"
              << error.text();
    return kInternalFault;
  } catch (const std::exception& error) {
    std::cerr << "regulus: internal error: ";
    return complain(error, kInternalFault);
  }
}
