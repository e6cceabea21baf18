// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/page/earlier_run.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "codegen/model/read_file.hpp"
#include "codegen/page/box_tree.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus::inline page {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 26;
constexpr std::uint64_t kMaxCertificateBytes = std::uint64_t{1} << 28;
/// Reports have a depth of about ten.
constexpr int kMaxJsonDepth = 64;
/// More lines than a page has room for.
constexpr int kMaxLines = 200000;
constexpr std::array kClaimWords = {"free", "singular", "undecided", "outside", "unreachable"};

[[noreturn]] void refuse(const EarlierRun& run, int line, const std::string& problem,
                         const std::string& remedy) {
  throw InputError::statement(run.path, line, problem, remedy);
}

[[noreturn]] void refuse_kind(const EarlierRun& run) {
  refuse(run, 0, "this is neither a certificate nor a report of an earlier run",
         "give a file of `check --certificate`, `locate --output`, or what --json printed for "
         "check, locate, bound or margin");
}

/// Returns a discarded value for a text that is no JSON, or is nested deeper than any report.
Json parsed(const std::string& text) {
  struct TooDeep {};
  const auto look = [](int depth, Json::parse_event_t, const Json&) {
    if (depth > kMaxJsonDepth) throw TooDeep();
    return true;
  };
  try {
    return Json::parse(text, look, false);
  } catch (const TooDeep&) {
    return Json(Json::value_t::discarded);
  }
}

const Json* member_of(const Json& object, const char* key) {
  const auto at = object.find(key);
  return at == object.end() ? nullptr : &*at;
}

bool has_text(const Json& object, const char* key) {
  const Json* const value = member_of(object, key);
  return value != nullptr && value->is_string();
}

bool has_number(const Json& object, const char* key) {
  const Json* const value = member_of(object, key);
  return value != nullptr && value->is_number();
}

bool has_verdict(const Json& report) {
  if (!has_text(report, "verdict")) return false;
  const auto& word = report["verdict"].get_ref<const std::string&>();
  return word == "no-singularity" || word == "singularity" || word == "possible-problem";
}

EarlierKind kind_of(const EarlierRun& run, const Json& report) {
  if (const Json* const error = member_of(report, "error"))
    refuse(run, 0,
           "the run that wrote this ended with an error" +
               (error->is_object() && has_text(*error, "message")
                    ? ": " + (*error)["message"].dump(-1, ' ', true)
                    : std::string()),
           "run it again");
  if (has_text(report, "bound") && has_text(report, "result") && report.contains("components"))
    return EarlierKind::kBound;
  if (report.contains("margin") && has_text(report, "bracket")) return EarlierKind::kMargin;
  if (has_verdict(report) && has_number(report, "resolution")) return EarlierKind::kPaving;
  if (has_verdict(report) && has_text(report, "claim") && has_text(report, "reason") &&
      has_text(report, "method") && has_number(report, "boxes") && has_number(report, "alpha"))
    return EarlierKind::kCheck;
  refuse_kind(run);
}

/// Every report has these.
void require_labels(const EarlierRun& run) {
  for (const char* key : {"model", "model_sha256", "motion"})
    if (!has_text(run.report, key)) refuse_kind(run);
  const Json* const question = member_of(run.report, "question");
  if (question == nullptr || !question->is_object())
    refuse(run, 0, "it does not say which question it answers",
           "it is of an earlier version: run again");
}

Json parsed_line(const EarlierRun& run, const std::string& line, int number) {
  Json value = parsed(line);
  if (!value.is_object()) refuse(run, number, "this is no JSON object", "make the file again");
  return value;
}

Interval interval_of(const EarlierRun& run, const Json& ends, int line) {
  if (!ends.is_array() || ends.size() != 2 || !ends[0].is_number() || !ends[1].is_number())
    refuse(run, line, "a range is not [lower, upper]", "make the file again");
  return {ends[0].get<double>(), ends[1].get<double>()};
}

/// Reads the lines of `locate --output`.
class PavingReader {
 public:
  explicit PavingReader(EarlierRun& run) : run_(run) {}

  void read(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      if (number_ == kMaxLines)
        refuse(run_, number_, "these are more boxes than a page holds",
               "use a coarser --resolution");
      take(parsed_line(run_, line, ++number_));
    }
    if (run_.report.is_null())
      refuse(run_, number_, "the boxes end without a summary", "its run was stopped: run again");
    if (run_.header.is_null()) return;
    try {
      run_.tree = tree_of_boxes(root_, boxes_);
    } catch (const std::invalid_argument& error) {
      refuse(run_, 0, std::string("the boxes do not cover the motion: ") + error.what(),
             "make the file again");
    }
  }

 private:
  void take(const Json& line) {
    if (!run_.report.is_null())
      refuse(run_, number_, "there are lines after the summary", "make the file again");
    if (line.contains("regulus_paving"))
      take_header(line);
    else if (line.contains("summary"))
      run_.report = line["summary"];
    else if (run_.header.is_null())
      take_stretch(line);
    else
      take_box(line);
  }

  void take_header(const Json& line) {
    if (number_ != 1 || line["regulus_paving"] != 1 || !line.contains("parameters"))
      refuse(run_, number_, "the format of these boxes is unknown", "make the file again");
    run_.header = line;
    for (const Json& parameter : line["parameters"]) {
      if (!has_text(parameter, "name") || !parameter.contains("range")) refuse_kind(run_);
      names_.push_back(parameter["name"]);
      root_.push_back(interval_of(run_, parameter["range"], number_));
    }
  }

  void take_stretch(const Json& line) {
    if (!line.contains("segments")) refuse_kind(run_);
    if (run_.stretches.is_null()) run_.stretches = Json::array();
    run_.stretches.push_back(line);
  }

  void take_box(const Json& line) {
    ClaimedBox& box = boxes_.emplace_back();
    const Json* const ranges = member_of(line, "box");
    box.claim = has_text(line, "kind") ? line["kind"].get<std::string>() : "";
    if (ranges == nullptr || std::ranges::find(kClaimWords, box.claim) == kClaimWords.end())
      refuse(run_, number_, "this is no box of a paving", "make the file again");
    for (const std::string& name : names_) {
      const Json* const range = member_of(*ranges, name.c_str());
      box.box.push_back(interval_of(run_, range == nullptr ? Json() : *range, number_));
    }
  }

  EarlierRun& run_;
  int number_ = 0;
  std::vector<std::string> names_;
  std::vector<Interval> root_;
  std::vector<ClaimedBox> boxes_;
};

void read_report(EarlierRun& run, const std::string& text) {
  const std::string first = text.substr(0, text.find('\n'));
  const Json line = parsed(first);
  const bool is_paving = line.is_object() && (line.contains("regulus_paving") ||
                                              (line.contains("kind") && line.contains("segments")));
  if (is_paving) {
    PavingReader(run).read(text);
  } else {
    run.report = parsed(text);
    if (!run.report.is_object()) refuse_kind(run);
  }
  run.kind = kind_of(run, run.report);
  if (is_paving && run.kind != EarlierKind::kPaving) refuse_kind(run);
  require_labels(run);
}

}  // namespace

const char* name(EarlierKind kind) {
  switch (kind) {
    case EarlierKind::kCertificate:
      return "certificate";
    case EarlierKind::kCheck:
      return "report of check";
    case EarlierKind::kPaving:
      return "boxes of locate";
    case EarlierKind::kBound:
      return "report of bound";
    case EarlierKind::kMargin:
      return "report of margin";
  }
  return "";
}

EarlierRun read_earlier_run(const std::string& path) {
  EarlierRun run{EarlierKind::kCertificate, path, {}, {}, {}, {}, {}};
  constexpr std::string_view kCertificate = "regulus-certificate";
  if (read_start(path, kCertificate.size(), Readable::kFile) == kCertificate) {
    run.sha256 = sha256(read_file(path, kMaxCertificateBytes, Readable::kFile));
    return run;
  }
  const std::string text = read_file(path, kMaxBytes, Readable::kFile);
  run.sha256 = sha256(text);
  read_report(run, text);
  return run;
}

}  // namespace regulus::page
