// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/picture/box_grid.hpp"

#include <fmt/format.h>

#include <iterator>
#include <new>

#include "codegen/answer/report/number_text.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

/// Returns a text that an XML comment can hold.
std::string comment(std::string text) {
  for (char& c : text)
    if (c == '-' || static_cast<unsigned char>(c) < 0x20) c = ' ';
  return text;
}

}  // namespace

BoxGrid::BoxGrid(const PreparedSearch& p, const PictureOptions& options)
    : axes_(options.paving.axes) {
  description_ = fmt::format("{}, {}{}: ", p.labels.model, p.labels.motion, options.subject);
  for (std::size_t k = 0; k < kClaims; ++k)
    words_ += fmt::format("{}{} {}", k > 0 ? ", " : "", k, options.word(Claim(k)));
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const VariableLabel& variable = p.labels.variables[axes_[i]];
    description_ += fmt::format("{}{} is {}{}", i > 0 ? ", " : "", "xyz"[i], variable.name,
                                unit_suffix(variable.unit));
  }
  if (p.labels.reach > 0) claims_.emplace(p.problem(), p.labels.reach);
}

void BoxGrid::add(std::span<const Interval> box, Claim claim) noexcept {
  try {
    cells_.push_back({{box[axes_[0]], box[axes_[1]], box[axes_[2]]}, claim});
  } catch (const std::bad_alloc&) {
    is_full_ = true;
  }
}

void BoxGrid::on_leaf(const OpenBox& box, Rule rule, const Proof&) noexcept {
  add(box.box, claims_ ? claims_->of(box.box, rule) : claim_of(rule));
}

void BoxGrid::on_open(const OpenBox& box) noexcept { add(box.box, Claim::kUndecided); }

std::string BoxGrid::array(const char* type, const char* name, int components,
                           const std::string& numbers) const {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}"
      "</DataArray>\n",
      type, name, components, numbers);
}

std::string BoxGrid::text() const {
  if (is_full_) throw FileError("memory does not suffice for the picture of all boxes");
  constexpr int kHexahedron =
      12;  // VTK's number; its corners: round the bottom, then round the top
  constexpr int kCorners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  std::string points, corners, offsets, types, claims;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    for (const auto& corner : kCorners)
      for (int k = 0; k < 3; ++k) {
        const Interval& side = cells_[i].sides[std::size_t(k)];
        fmt::format_to(std::back_inserter(points), "{}{}", corner[k] == 0 ? side.lo : side.hi,
                       k < 2 ? ' ' : '\n');
      }
    for (std::size_t k = 0; k < 8; ++k)
      fmt::format_to(std::back_inserter(corners), "{}{}", 8 * i + k, k < 7 ? ' ' : '\n');
    offsets += fmt::format("{}\n", 8 * (i + 1));
    types += fmt::format("{}\n", kHexahedron);
    claims += fmt::format("{}\n", int(cells_[i].claim));
  }
  return fmt::format(
             "<?xml version=\"1.0\"?>\n<!-- {}; claim: {} -->\n<VTKFile type=\"UnstructuredGrid\" "
             "version=\"0.1\" "
             "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" "
             "NumberOfCells=\"{}\">\n<Points>\n",
             comment(description_), comment(words_), 8 * cells_.size(), cells_.size()) +
         array("Float64", "Points", 3, points) + "</Points>\n<Cells>\n" +
         array("Int64", "connectivity", 1, corners) + array("Int64", "offsets", 1, offsets) +
         array("UInt8", "types", 1, types) + "</Cells>\n<CellData Scalars=\"claim\">\n" +
         array("UInt8", "claim", 1, claims) +
         "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace regulus::detail
