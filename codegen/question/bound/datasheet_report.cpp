// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "codegen/answer/report/question_report.hpp"
#include "codegen/answer/report/search_facts.hpp"
#include "codegen/question/bound/bound_report.hpp"
#include "codegen/question/bound/datasheet.hpp"

namespace regulus::detail {
namespace {

using Json = nlohmann::ordered_json;

/// A quantity with more components than this has one row, that of its extreme values.
constexpr std::size_t kMostRows = 12;

using Row = std::array<std::string, 6>;
constexpr std::array<const char*, 6> kHead{"quantity", "of", "from", "to", "unit", "limit"};

const char* word_of(LimitState state) {
  switch (state) {
    case LimitState::kKept:
      return "kept";
    case LimitState::kExceeded:
      return "EXCEEDED";
    case LimitState::kUnknown:
      return "unknown";
    case LimitState::kNone:
      break;
  }
  return "";
}

/// Returns "200 EXCEEDED".
std::string limit_cell(const Model& model, const ComponentBound& c) {
  const LimitState state = limit_state(model, c);
  return state == LimitState::kNone ? "" : limit_text(model, c) + ' ' + word_of(state);
}

std::string name_of(const Bound& bound) {
  const Component& c = bound.quantity.components.front();
  if (bound.quantity.is_least && c.sign < 0) return "least " + bound.quantity.name;
  if (!c.is_absolute) return "largest " + bound.quantity.name;
  return bound.quantity.name;
}

Row row_of(const Model& model, const Bound& bound, const ComponentBound& c) {
  const EndTexts ends = end_texts(c);
  const std::string unknown = "?";
  return {name_of(bound),
          c.component.label,
          c.is_unbounded     ? "unbounded"
          : ends.low.empty() ? (c.is_closed ? "0" : unknown)
                             : ends.low,
          c.is_unbounded      ? ""
          : ends.high.empty() ? unknown
                              : ends.high,
          c.component.unit == "1" ? "" : c.component.unit,
          limit_cell(model, c)};
}

std::vector<Row> rows_of(const Model& model, const Datasheet& sheet) {
  std::vector<Row> rows;
  for (const Bound& bound : sheet.bounds) {
    if (bound.components.size() <= kMostRows) {
      for (const ComponentBound& c : bound.components) rows.push_back(row_of(model, bound, c));
    } else if (const ComponentBound* c = bound.decisive_attained()) {
      ComponentBound whole = *c;
      if (const ComponentBound* p = bound.decisive_proved()) whole.proved = p->proved;
      rows.push_back(row_of(model, bound, whole));
    }
  }
  return rows;
}

/// Returns the width of a text in characters: UTF-8 is counted by its first bytes.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string format_rows(const std::vector<Row>& rows, const std::string& before,
                        const std::string& between, bool has_rule) {
  std::array<std::size_t, 6> widths{};
  const auto measure = [&](const Row& row) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  };
  Row head;
  std::ranges::copy(kHead, head.begin());
  measure(head);
  for (const Row& row : rows) measure(row);
  std::string text;
  const auto write = [&](const Row& row, char fill) {
    text += before;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) text += between;
      text += row[i] + std::string(widths[i] - width_of(row[i]), fill);
    }
    if (before.empty()) text.erase(text.find_last_not_of(' ') + 1);
    text += (before.empty() ? "" : " |") + std::string("\n");
  };
  write(head, ' ');
  if (has_rule) {
    text += "|";
    for (const std::size_t width : widths) text += std::string(width + 2, '-') + "|";
    text += '\n';
  }
  for (const Row& row : rows) write(row, ' ');
  return text;
}

/// A bar in a cell, as of |det J⁻¹|, would end the cell.
std::vector<Row> in_markdown(std::vector<Row> rows) {
  for (Row& row : rows)
    for (std::string& cell : row)
      for (std::size_t at = 0; (at = cell.find('|', at)) != std::string::npos; at += 2)
        cell.insert(at, 1, '\\');
  return rows;
}

constexpr const char* kProvedRow =
    "Each row is a proved bracket: no value is beyond the outer end, over every pose and every";
constexpr const char* kAttainedRow = "uncertain value, and the inner end is attained.";

Json json_sheet_entry(const Request& request, const Bound& bound, const BoundSettings& settings) {
  Facts facts(Readers::kPrograms);
  tell_bracket(request, bound, settings, facts);
  Json object = facts.object();
  object.erase("proof");  // the head of the report has all of them
  for (std::size_t i = 0; i < bound.components.size(); ++i) {
    const LimitState state = limit_state(request.model, bound.components[i]);
    object["components"][i]["limit"] =
        state == LimitState::kNone ? Json(nullptr) : Json(word_of(state));
  }
  return object;
}

/// Returns "refuted" if a value is unbounded or beyond its limit, "closed" if every bracket is.
const char* verdict_of(const Model& model, const Datasheet& sheet) {
  bool is_closed = !sheet.is_interrupted && !sheet.bounds.empty();
  for (const Bound& bound : sheet.bounds) {
    is_closed = is_closed && bound.is_closed();
    for (const ComponentBound& c : bound.components)
      if (c.is_singular() || limit_state(model, c) == LimitState::kExceeded) return "refuted";
  }
  return is_closed ? "closed" : "open";
}

}  // namespace

std::string text_datasheet(const Request& request, const Datasheet& sheet) {
  const std::vector<Row> rows = rows_of(request.model, sheet);
  std::string text =
      rows.empty() ? "no quantity of this model is bounded\n" : format_rows(rows, "", "  ", false);
  for (const std::string& reason : sheet.left_out) text += "not bounded: " + reason + '\n';
  return text;
}

std::string markdown_datasheet(const Request& request, const Datasheet& sheet,
                               const std::string& set) {
  std::string text =
      fmt::format("# {}, motion {}\n\n```text\n{}```\n\n{}\n{}\n\n", request.model.name,
                  request.motion.name, set, kProvedRow, kAttainedRow);
  text += format_rows(in_markdown(rows_of(request.model, sheet)), "| ", " | ", true) + '\n';
  text += "Attained at:\n\n";
  for (const Bound& bound : sheet.bounds)
    if (const ComponentBound* c = bound.decisive_attained(); c && c->place)
      text +=
          fmt::format("- {}{}: {}\n", name_of(bound),
                      c->component.label.empty() ? "" : ", " + c->component.label, c->place->pose);
  if (!sheet.left_out.empty()) text += "\nNot bounded:\n\n";
  for (const std::string& reason : sheet.left_out) text += "- " + reason + '\n';
  return text + fmt::format("\nModel {}, SHA-256 {}\n", request.model.path, request.model.sha256);
}

void tell_datasheet(const Request& request, const Datasheet& sheet, const BoundSettings& settings,
                    Facts& facts) {
  if (!facts.are_for_programs()) return;  // people read the sheet
  Json bounds = Json::array(), proofs = Json::array();
  StageSeconds seconds;
  std::uint64_t boxes = 0;
  for (const Bound& bound : sheet.bounds) {
    bounds.push_back(json_sheet_entry(request, bound, settings));
    seconds += seconds_of(bound);
    boxes += boxes_of(bound);
    for (const ComponentBound& c : bound.components)
      c.proofs.add_to(proofs,
                      name_of(bound) + (c.component.label.empty() ? "" : ", ") + c.component.label);
  }
  if (!proofs.empty()) facts.add("proof", std::move(proofs));
  add_model(request, facts);
  add_search(settings.search, json_question(request, settings.search), facts);
  facts.add("boxes", boxes).add("seconds", json_seconds(seconds));
  if (!sheet.bounds.empty()) facts.add("claim", fmt::format("{} {}", kProvedRow, kAttainedRow));
  facts.add("verdict", verdict_of(request.model, sheet)).add("interrupted", sheet.is_interrupted);
  facts.add("bounds", std::move(bounds)).add("not_bounded", sheet.left_out);
}

}  // namespace regulus::detail
