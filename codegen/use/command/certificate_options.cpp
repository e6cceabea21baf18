// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/command/certificate_options.hpp"

#include <CLI/CLI.hpp>

#include "codegen/use/command/number_check.hpp"
#include "runtime/proof/format.hpp"

namespace regulus::detail {

void add_certificate_option(CLI::App& app, std::string& path, const std::string& what) {
  app.add_option("--certificate", path,
                 what + "; `regulus verify` checks it. An earlier FILE is renamed to FILE.old")
      ->type_name("FILE");
}

void add_shard_option(CLI::App& app, std::uint64_t& size) {
  app.add_option(
         "--shard-size", size,
         "Cut a proof that is larger than SIZE into files of about SIZE, such as 64MB, in the "
         "folder FILE.shards; FILE is then their index")
      ->type_name("SIZE")
      ->transform(size_in_bytes(format::kLeastShardSize, format::kMaxBytes))
      ->needs("--certificate");
}

void add_verify_options(CLI::App& app, VerifyCommand& command) {
  app.add_option("CERTIFICATE", command.path, "Certificate file, or the index of its shards")
      ->required();
  app.add_option("--waypoints", command.waypoints,
                 "With --model: the file of way-points that check --waypoints took")
      ->type_name("FILE");
  app.add_option(
         "--model", command.model,
         "Also check that the certificate is about this model file: write the question again "
         "from the file and compare it line by line. The verifier's own reader also reads and "
         "compares every number and expression of the file")
      ->type_name("MODEL");
  app.add_flag("--allow-options", command.allows_options,
               "With --model: ranges, tolerances, alpha and larger control errors may differ from "
               "the file, because options change them; the differences are reported");
  app.add_option("--time-limit", command.time_limit,
                 "Stop after S seconds; the answer is then UNFINISHED")
      ->check(positive_seconds())
      ->type_name("S");
  app.add_option("--max-boxes", command.max_boxes,
                 "Evaluate at most N boxes for all leaves together; default 4194304")
      ->check(whole_number(1))
      ->type_name("N");
  app.add_option("--threads", command.threads,
                 "Prove leaves by N threads; the answer is the same for any N")
      ->check(whole_number(1, 1024))
      ->type_name("N")
      ->capture_default_str();
  app.add_flag("--json", command.output.json,
               "Print the report on standard output, as one JSON object");
  app.add_flag("--quiet", command.output.quiet, "Print only the answer (or the JSON report)");
}

}  // namespace regulus::detail
