// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/answer/refused_paving.hpp"

#include "codegen/answer/outputs.hpp"
#include "codegen/answer/picture/picture_options.hpp"
#include "codegen/answer/picture/robot_in_map.hpp"
#include "codegen/answer/picture/way_picture.hpp"
#include "codegen/answer/report/paving_options.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/request.hpp"

namespace regulus::detail {
namespace {

/// Refuses what no picture over these ranges can have: names and ranges of the search are enough.
void require_pictures(const PictureRequest& pictures, const Request& request) {
  SearchSubject subject;
  PavingOptions paving;
  for (const MotionParameter& p : request.motion.parameters) {
    if (certain_sign(p.range.hi - p.range.lo) == CertainSign::kPositive)
      paving.axes.push_back(subject.labels.variables.size());
    subject.labels.variables.push_back({p.name, p.unit});
    subject.variety.outer.push_back(
        {enclose_constant(p.range.lo, p.name).lo, enclose_constant(p.range.hi, p.name).hi});
  }
  const PictureOptions options = resolve_pictures(pictures, paving, subject);
  if (options.robot) require_robot_in_map(request, subject, options);
}

}  // namespace

void refuse_paving(const std::string& resolution, const ModelOptions& model,
                   const SearchOptions& search, const Services& services) {
  if (!resolution.empty()) static_cast<void>(read_resolution(resolution));
  const PictureRequest& pictures = services.pictures;
  for (const std::string& file : pictures.files) require_picture_format(file);
  if (pictures.files.empty() && pictures.axes.empty() && pictures.slices.empty() && !pictures.robot)
    return;
  const FormingWatch watch = watch_of(services, search);
  const auto request = if_readable([&] { return std::optional(read_request(model, &watch)); });
  if (!request) return;
  if (request->motion.trajectory)
    require_way_pictures(pictures);
  else
    require_pictures(pictures, *request);
}

}  // namespace regulus::detail
