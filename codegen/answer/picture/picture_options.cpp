// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/picture/picture_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "codegen/answer/report/place_text.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

using Axes = std::vector<std::size_t>;

std::string listed(const SearchSubject& p, const Axes& axes) {
  std::string words;
  for (const std::size_t k : axes)
    words += (words.empty() ? "" : ", ") + p.labels.variables[k].name;
  return words.empty() ? "a motion with ranges" : words;
}

/// `option` and `choice` are parts of the message: "--axes", "two of".
std::size_t parse_axis(const std::string& wanted, const SearchSubject& p, const Axes& axes,
                       const char* option, const char* choice) {
  for (const std::size_t k : axes)
    if (p.labels.variables[k].name == wanted) return k;
  throw UsageError(fmt::format("{}: '{}' is not a parameter with a range; choose {}: {}", option,
                               wanted, choice, listed(p, axes)));
}

Axes parse_axes(const std::string& text, const SearchSubject& p, const Axes& axes) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos)
    throw UsageError("--axes: found '" + text + "', expected two motion parameters, p,q");
  const auto axis = [&](const std::string& name) {
    return parse_axis(name, p, axes, "--axes", "two of");
  };
  const std::size_t first = axis(text.substr(0, comma));
  const std::size_t second = axis(text.substr(comma + 1));
  if (first == second)
    throw UsageError("--axes: found '" + text + "', expected two different parameters");
  return {first, second};
}

/// The values are the middles of equal parts of the range: no picture is one of its ends.
std::vector<Slice> parse_slices(const std::string& text, const SearchSubject& p, const Axes& axes) {
  constexpr unsigned kMaxSlices = 36;
  const std::size_t equals = text.find('=');
  const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
  unsigned count = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), count);
  if (error != std::errc() || end != number.data() + number.size() || count < 2 ||
      count > kMaxSlices)
    throw UsageError(fmt::format(
        "--slices: found '{}', expected p=N, a motion parameter and a number from 2 to {}", text,
        kMaxSlices));
  const std::size_t axis = parse_axis(text.substr(0, equals), p, axes, "--slices", "one of");
  const Interval range = p.variety.outer[axis];
  std::vector<Slice> slices;
  for (unsigned i = 0; i < count; ++i)
    slices.push_back({axis, range.lo + (range.hi - range.lo) * (i + 0.5) / count});
  return slices;
}

bool ends_with_any(const std::string& file, std::initializer_list<const char*> endings) {
  return std::ranges::any_of(endings, [&](const char* ending) { return file.ends_with(ending); });
}

/// Throws UsageError that `what` needs other ranges, with those of the motion and what changes them.
[[noreturn]] void refuse_ranges(const std::string& what, const SearchSubject& p, const Axes& axes,
                                bool too_many = false) {
  std::string words = what + "; this motion has " +
                      (axes.empty()       ? "none"
                       : axes.size() == 1 ? "a range of "
                                          : "ranges of ");
  if (!axes.empty()) words += listed(p, axes);
  for (std::size_t k = 0; k < p.labels.variables.size() && !too_many; ++k)
    if (is_motion(p.labels.variables[k]) && std::ranges::count(axes, k) == 0)
      throw UsageError(words + "; --range " + p.labels.variables[k].name + "=LO:HI gives " +
                       (axes.empty() ? "one" : "another"));
  throw UsageError(words + (too_many ? "; --range p=V sets a parameter to one value"
                                     : "; name a motion with more of them, or give a "
                                       "constant of its pose a range, --range p=LO:HI"));
}

void require_axes_for(const PictureRequest& request, const PictureOptions& options,
                      const SearchSubject& p) {
  const Axes& axes = options.paving.axes;
  const bool is_flat = options.drawn.size() < 2;
  if (!request.files.empty() && axes.empty())
    refuse_ranges("--picture: a motion parameter with a range is needed to draw", p, axes);
  if (!options.slices.empty() && is_flat)
    refuse_ranges("--slices: two other motion parameters with ranges are needed to draw", p, axes);
  if (options.shade == Shade::kShare && is_flat)
    refuse_ranges("--shade share: two motion parameters with ranges are needed to draw", p, axes);
  for (const std::string& file : request.files)
    if (is_grid_file(file) && axes.size() != 3)
      refuse_ranges(fmt::format("--picture {}: boxes in space need three motion parameters with "
                                "ranges",
                                file),
                    p, axes, axes.size() > 3);
}

}  // namespace

void require_picture_format(const std::string& file) {
  if (!ends_with_any(file, {".svg", ".pdf", ".png", ".vtu"}))
    throw UsageError("--picture: found '" + file +
                     "', expected a name that ends in .svg, .pdf, .png or .vtu");
}

bool is_grid_file(const std::string& file) { return file.ends_with(".vtu"); }

PictureOptions resolve_pictures(const PictureRequest& request, const PavingOptions& paving,
                                const SearchSubject& p) {
  PictureOptions options{paving, paving.axes, {}, request.shade, request.robot};
  if (request.files.empty()) {
    for (const auto& [option, text] :
         {std::pair{"--axes", &request.axes}, std::pair{"--slices", &request.slices}})
      if (!text->empty()) throw UsageError(fmt::format("{} needs --picture", option));
    if (request.robot) throw UsageError("--robot needs --picture");
  }
  if (!request.slices.empty()) {
    options.slices = parse_slices(request.slices, p, paving.axes);
    std::erase(options.drawn, options.slices.front().axis);
  }
  const Axes choice = options.drawn;
  if (options.drawn.size() > 2) options.drawn.resize(2);
  if (!request.axes.empty()) options.drawn = parse_axes(request.axes, p, choice);
  require_axes_for(request, options, p);
  return options;
}

}  // namespace regulus::detail
