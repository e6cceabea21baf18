// SPDX-License-Identifier: Apache-2.0
// The lines of a part are read as the file of a certificate about one place. Nothing is taken from one
// part for another, so what is true of such a file is true of each part. With a model file, the numbers
// of a row of the table are put in the place of those of the motion, and the part is compared with that.
//
// Parts in shards have the numbers that they have in one file, so all are there, once and in order. The
// hashes only tell which file is wrong.
#include "runtime/verifier/places.hpp"

#include <algorithm>
#include <chrono>
#include <sstream>

#include "runtime/verifier/model/model_comparison.hpp"
#include "runtime/verifier/proof.hpp"
#include "runtime/verifier/shard_file.hpp"

namespace regulus::verifier {
namespace {

using Clock = std::chrono::steady_clock;

constexpr ListedWords kListed{"places", "places", "PLACES"};

/// The sum of what the parts of a file, or of a shard, claim.
struct ClaimedParts {
  format::ClaimedPlaces claimed;
  std::optional<std::string> unfinished;  ///< why the first such part is not proved
};

void add_differences(const std::vector<std::string>& from, std::vector<std::string>& into) {
  for (const std::string& difference : from)
    if (std::ranges::find(into, difference) == into.end()) into.push_back(difference);
}

std::size_t proved_places(const format::ClaimedPlaces& claimed) {
  return claimed.complete + claimed.none + claimed.incomplete;
}

class PartsChecker {
 public:
  /// `first`: the number of the first part, from 0. `counts` receives what is said of all parts.
  PartsChecker(Lines& lines, const Options& options, CheckPart check_part, Clock::time_point start,
               std::optional<PlaceTable>& table, std::size_t first, Verification& counts)
      : lines_(lines),
        options_(options),
        check_part_(check_part),
        start_(start),
        table_(table),
        first_(first),
        counts_(counts) {}

  /// Reads on to the end of the file, and proves each part.
  ClaimedParts check() {
    advance();
    for (std::size_t k = first_; lines_.text().starts_with(format::kPlace); ++k) {
      if (k == format::kMostPlaces) throw Rejection("there are too many places");
      const std::string expected = format::kPlace + std::to_string(k + 1);
      if (lines_.text() != expected) throw Rejection("expected the line '" + expected + '\'');
      check_next(k);
    }
    if (counts_.places == 0 || lines_.text() != format::kPlaces + std::to_string(counts_.places))
      throw Rejection("expected the next place, or the number of all in a line 'places'");
    if (lines_.next()) throw Rejection("there is text after the line 'places'");
    return std::move(parts_);
  }

 private:
  void advance() {
    if (!lines_.next()) throw Rejection("the file ends before its line 'places'");
  }

  /// Reads the lines of a part up to the next one.
  std::string read_part() {
    std::string part;
    for (advance();
         !lines_.text().starts_with(format::kPlace) && !lines_.text().starts_with(format::kPlaces);
         advance()) {
      part += lines_.text() + '\n';
      if (part.size() > format::kLongestPart) throw Rejection("the part about a place is too long");
    }
    return part;
  }

  /// An open part does not end the reading: another part may be false.
  void check_next(std::size_t k) {
    const std::size_t first = lines_.number();
    const std::string part = read_part();
    ++counts_.places;
    lines_.name_line(first);
    try {
      if (part.empty()) throw Unfinished("it has no proof");
      prove(k, part);
    } catch (const Unfinished& why) {
      if (!parts_.unfinished) parts_.unfinished = name_of(k) + ": " + why.what();
    }
    lines_.name_line(0);
  }

  [[nodiscard]] std::string name_of(std::size_t k) const {
    const std::string name = format::kPlace + std::to_string(k + 1);
    return table_ && k < table_->rows() ? name + ", " + table_->describe(k) : name;
  }

  void prove(std::size_t k, const std::string& part) {
    std::istringstream text(part);
    Lines lines(text);
    Verification of_part;
    PlacePart place{k, &table_};
    const auto here = [&](const std::exception& why) {
      return "line " + std::to_string(lines.number()) + " of its part: " + why.what();
    };
    const Options rest = rest_of_options();
    try {
      check_part_(lines, rest, place, of_part);
    } catch (const OtherModel& why) {
      throw OtherModel(name_of(k) + ": " + why.what());
    } catch (const Rejection& why) {
      throw Rejection(name_of(k) + ": " + here(why));
    } catch (const Unfinished& why) {
      counts_.boxes += of_part.boxes;
      throw Unfinished(here(why));
    }
    add(k, of_part, part);
  }

  /// With what is left of the limits for all parts.
  [[nodiscard]] Options rest_of_options() const {
    Options rest = options_;
    if (options_.time_limit > 0) rest.time_limit = options_.time_limit - seconds();
    if (rest.time_limit < 0) throw Unfinished("the time limit was reached");
    if (counts_.boxes >= options_.max_boxes)
      throw Unfinished("all places together need more than " + std::to_string(options_.max_boxes) +
                       " boxes");
    rest.max_boxes = options_.max_boxes - counts_.boxes;
    if (options_.progress)
      rest.progress = [this](const Verification& of_part) {
        Verification total = counts_;
        total.boxes += of_part.boxes;
        options_.progress(total);
      };
    return rest;
  }

  void add(std::size_t k, const Verification& of_part, const std::string& part) {
    if (counts_.model.empty() && proved_places(parts_.claimed) == 0) {
      counts_.model = of_part.model;
      counts_.sha256 = of_part.sha256;
      counts_.motion = of_part.motion;
    }
    if (of_part.model != counts_.model || of_part.sha256 != counts_.sha256 ||
        of_part.motion != counts_.motion)
      throw Rejection(name_of(k) + ": it is about another model or motion than the first part");
    counts_.boxes += of_part.boxes;
    counts_.leaves += of_part.leaves;
    counts_.roots += of_part.roots;
    counts_.real_roots += of_part.real_roots;
    counts_.numbers += of_part.numbers;
    add_differences(of_part.differences, counts_.differences);
    count(part);
  }

  /// The part is true, so its lines are what they say.
  void count(const std::string& part) {
    std::istringstream text(part);
    format::ClaimedPlaces& claimed = parts_.claimed;
    for (std::string line; std::getline(text, line);) {
      claimed.solutions += line.starts_with("solution ");
      claimed.complete += line == std::string("verdict ") + format::kComplete;
      claimed.none += line == std::string("verdict ") + format::kNone;
      claimed.incomplete += line == std::string("verdict ") + format::kIncomplete;
    }
  }

  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }

  Lines& lines_;
  const Options& options_;
  const CheckPart check_part_;
  const Clock::time_point start_;
  std::optional<PlaceTable>& table_;
  const std::size_t first_;
  Verification& counts_;
  ClaimedParts parts_;
};

class PlacesChecker {
 public:
  PlacesChecker(Lines& lines, const Options& options, CheckPart check_part, Verification& result)
      : lines_(lines), options_(options), check_part_(check_part), result_(result) {}

  void check() {
    if (!lines_.next())
      throw Rejection("the file is empty");  // next() returns its first line again
    if (lines_.text() == format::kPlacesIndexMagic)
      check_index();
    else
      parts_ = checker(lines_, options_, 0, result_).check();
    if (table_ && table_->rows() != result_.places)
      throw OtherModel("the certificate is not about " + table_->file() + ": it has " +
                       std::to_string(result_.places) + " places, the file " +
                       std::to_string(table_->rows()));
    result_.claim = format::describe_places_claim(parts_.claimed);
    if (parts_.unfinished) throw Unfinished(*parts_.unfinished);
  }

 private:
  PartsChecker checker(Lines& lines, const Options& options, std::size_t first,
                       Verification& counts) {
    return {lines, options, check_part_, start_, table_, first, counts};
  }

  void check_index() {
    if (options_.path.empty()) throw Unfinished("the shards of an index need its path");
    const std::vector<ListedShard> listed = read_listed(lines_, kListed);
    std::vector<ShardProof> proofs(listed.size());
    std::size_t first = 0;
    for (std::size_t i = 0; i < listed.size(); first += listed[i++].leaves)
      if (i % options_.parts == options_.part) prove(listed[i], first, proofs[i]);
    if (options_.parts > 1) options_.exchange(proofs);
    result_ = {};
    result_.shards = listed.size();
    for (std::size_t i = 0; i < listed.size(); ++i) {
      lines_.name_line(listed[i].line);
      join("shard " + std::to_string(listed[i].number) + ": ", listed[i], proofs[i]);
    }
    lines_.name_line(0);
  }

  /// An open part does not end the reading: a part of another shard may be false.
  void prove(const ListedShard& listed, std::size_t first, ShardProof& proof) try {
    ShardFile file(format::shard_file(options_.path, listed.number), listed, "");
    Options options = options_;
    if (options_.progress)
      options.progress = [this](const Verification& of_shard) {
        Verification total = result_;
        total.boxes += of_shard.boxes;
        options_.progress(total);
      };
    Verification counts;
    try {
      const ClaimedParts parts = checker(file.lines(), options, first, counts).check();
      if (counts.places != listed.leaves)
        throw Rejection("the index gives another number of places");
      put(parts, counts, proof);
    } catch (const OtherModel&) {
      throw;
    } catch (const Rejection& why) {
      throw Rejection("line " + std::to_string(file.lines().number()) + ": " + why.what());
    }
    result_.boxes += counts.boxes;
  } catch (const OtherModel& why) {
    proof.is_rejected = proof.is_of_other_model = true;
    proof.reason = why.what();
  } catch (const Rejection& why) {
    proof.is_rejected = true;
    proof.reason = why.what();
  }

  static void put(const ClaimedParts& parts, const Verification& counts, ShardProof& proof) {
    const format::ClaimedPlaces& c = parts.claimed;
    proof.is_proved = !parts.unfinished;
    proof.reason = parts.unfinished.value_or("");
    proof.boxes = counts.boxes, proof.leaves = counts.leaves;
    proof.about = {counts.model, counts.sha256, counts.motion};
    proof.differences = counts.differences;
    proof.of_places = {c.complete,        c.none,        c.incomplete, c.solutions, counts.roots,
                       counts.real_roots, counts.numbers};
  }

  void join(const std::string& here, const ListedShard& listed, const ShardProof& proof) {
    if (proof.is_of_other_model) throw OtherModel(here + proof.reason);
    if (proof.is_rejected) throw Rejection(here + proof.reason);
    if (!proof.is_proved && !parts_.unfinished) parts_.unfinished = here + proof.reason;
    result_.places += listed.leaves;
    if (proof.about.size() != 3 || proof.of_places.size() != 7) {
      if (proof.is_proved) throw Rejection(here + "it has no proof");
      return;  // no process has read it
    }
    const auto& n = proof.of_places;
    if (n[0] + n[1] + n[2] > 0) take_model(here, proof.about);
    result_.boxes += proof.boxes, result_.leaves += proof.leaves;
    format::ClaimedPlaces& c = parts_.claimed;
    c.complete += n[0], c.none += n[1], c.incomplete += n[2], c.solutions += n[3];
    result_.roots += n[4], result_.real_roots += n[5], result_.numbers += n[6];
    add_differences(proof.differences, result_.differences);
    if (result_.boxes > options_.max_boxes)
      throw Unfinished(here + "all places together need more than " +
                       std::to_string(options_.max_boxes) + " boxes");
  }

  void take_model(const std::string& here, const std::vector<std::string>& about) {
    if (!has_model_) result_.model = about[0], result_.sha256 = about[1], result_.motion = about[2];
    has_model_ = true;
    if (about != std::vector{result_.model, result_.sha256, result_.motion})
      throw Rejection(here + "it is about another model or motion than the first part");
  }

  Lines& lines_;
  const Options& options_;
  const CheckPart check_part_;
  Verification& result_;
  const Clock::time_point start_ = Clock::now();
  std::optional<PlaceTable> table_;
  ClaimedParts parts_;
  bool has_model_ = false;  ///< of an index
};

/// Reads the table that the options or the motion name. Throws Unfinished if there is none, unless the
/// places may be those of options.
void read_table_of(const Question& question, const WrittenValues& model, const Options& options,
                   std::optional<PlaceTable>& table) {
  if (table) return;
  const std::string file = options.waypoints.empty()
                               ? table_of_motion(model, question.motion, options.model_name)
                               : options.waypoints;
  if (!file.empty()) table.emplace(file);
  if (file.empty() && !options.all_overridden)
    throw Unfinished("the certificate is about places of a table; name it by --waypoints");
}

}  // namespace

void compare_place(Question& question, const WrittenValues& model, const Options& options,
                   const PlacePart& place, Verification& result) {
  std::optional<PlaceTable>& table = *place.table;
  read_table_of(question, model, options, table);
  if (!table) return compare_with_file(question, model, options, result);
  if (place.number >= table->rows())
    throw OtherModel("the certificate is not about " + table->file() + ", which has " +
                     std::to_string(table->rows()) + " places");
  PlaceTable::AtRow row = table->at(place.number, question, model);
  Options at_place = options;
  at_place.fixed.merge(row.fixed);
  try {
    compare_with_file(question, row.values, at_place, result);
  } catch (const OtherModel& why) {
    // Numbers that the table does not have may be those of options.
    if (row.is_whole || !options.all_overridden) throw;
    throw Unfinished(std::string("the table has not all numbers of the place, and ") + why.what());
  }
}

void check_places(Lines& lines, const Options& options, CheckPart check_part,
                  Verification& result) {
  PlacesChecker(lines, options, check_part, result).check();
}

}  // namespace regulus::verifier
