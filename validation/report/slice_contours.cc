#include "validation/report/slice_contours.h"

#include "validation/metrics/plane_cut.h"
#include "validation/report/html.h"
#include "validation/report/plane_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

namespace pelvireg::report
{
namespace
{
using metrics::CutSegment;

/// Grows with every point that it is shown.
struct Box
{
  Eigen::Vector2d lower = Eigen::Vector2d::Constant(std::numeric_limits<double>::max()), upper = -lower;

  void add(const Eigen::Vector2d &p)
  {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
};

/// The next segment of the curve that ends at a mesh edge; each is taken once.
class SegmentChain
{
public:
  explicit SegmentChain(const std::vector<CutSegment> &segments) : segments_(segments), taken_(segments.size(), false)
  {
    for (std::size_t s = 0; s < segments.size(); ++s)
      for (const metrics::EdgeCut &end : segments[s].ends)
        at_[{end.node_a, end.node_b}].push_back(s);
  }

  /// Points of an open or closed curve that begins with segment `first`.
  std::vector<Eigen::Vector3d> walk(std::size_t first)
  {
    std::vector<Eigen::Vector3d> points = {segments_[first].ends[0].position};
    std::size_t segment = first;
    int leaving = 1;
    while (true)
    {
      taken_[segment] = true;
      const metrics::EdgeCut &end = segments_[segment].ends[static_cast<std::size_t>(leaving)];
      points.push_back(end.position);
      const auto &neighbours = at_.at({end.node_a, end.node_b});
      const auto next = std::find_if(neighbours.begin(), neighbours.end(), [&](std::size_t s) { return !taken_[s]; });
      if (next == neighbours.end())
        return points;
      segment = *next;
      const metrics::EdgeCut &entry = segments_[segment].ends[0];
      leaving = entry.node_a == end.node_a && entry.node_b == end.node_b ? 1 : 0;
    }
  }
  bool is_taken(std::size_t segment) const { return taken_[segment]; }

private:
  const std::vector<CutSegment> &segments_;
  std::vector<bool> taken_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> at_;
};

/// Relative steps in tenths of a millimetre, each from where the rounded path stands: the rounding does not add up.
std::string path_of(const std::vector<Eigen::Vector3d> &points, const PlaneView &view)
{
  const auto tenths = [&](const Eigen::Vector3d &p) -> Eigen::Vector2d { return (10 * view(p)).array().round(); };
  Eigen::Vector2d at = tenths(points.front());
  std::string path = fmt::format("M{:g} {:g}", at.x() / 10, at.y() / 10);
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const Eigen::Vector2d next = tenths(points[i]);
    if (next == at)
      continue;
    path += fmt::format("l{:g} {:g}", (next.x() - at.x()) / 10, (next.y() - at.y()) / 10);
    at = next;
  }
  return path;
}

/// Cuts of one set of surfaces by one plane, one list an organ.
std::vector<std::vector<CutSegment>> cut_all(const std::vector<MovingSurface> &organs, const dataset::Plane &plane)
{
  std::vector<std::vector<CutSegment>> cuts;
  for (const MovingSurface &organ : organs)
    cuts.push_back(metrics::cut_surface(organ.frames.back(), organ.rest.triangles, organ.rest.region, plane));
  return cuts;
}

std::string paths_of(const std::vector<std::vector<CutSegment>> &cuts, const PlaneView &view, Box &box)
{
  std::string path;
  for (const std::vector<CutSegment> &cut : cuts)
  {
    SegmentChain chain(cut);
    for (std::size_t s = 0; s < cut.size(); ++s)
    {
      box.add(view(cut[s].ends[0].position));
      if (!chain.is_taken(s))
        path += path_of(chain.walk(s), view);
    }
  }
  return path;
}

std::vector<SliceLabel> labels_of(const std::vector<std::vector<CutSegment>> &cuts, const PlaneView &view)
{
  std::vector<SliceLabel> labels;
  for (std::size_t organ = 0; organ < cuts.size(); ++organ)
  {
    Box box;
    for (const CutSegment &segment : cuts[organ])
      box.add(view(segment.ends[0].position));
    if (!cuts[organ].empty())
      labels.push_back(
          {dataset::organ_names[organ], (box.lower.x() + box.upper.x()) / 2, (box.lower.y() + box.upper.y()) / 2});
  }
  return labels;
}

std::string panel(const SliceDrawing &drawing, const SliceContours &slice, std::size_t condition, double pitch)
{
  const double offset = slice.index * pitch;
  const std::string side =
      slice.index == 0 ? "image plane" : fmt::format("{:g} mm {}", std::abs(offset), offset > 0 ? "left" : "right");
  std::string html =
      fmt::format("<figure class=\"slice\" data-index=\"{}\"><svg viewBox=\"{:.1f} {:.1f} {:.1f} {:.1f}\" role=\"img\" "
                  "aria-label=\"Slice {}, {}: contours of truth and estimate\">",
                  slice.index, drawing.left, drawing.top, drawing.width, drawing.height, slice.index, side);
  html += fmt::format("<path class=\"truth\" d=\"{}\"/><path class=\"estimate\" d=\"{}\"/>", slice.truth,
                      condition < slice.estimates.size() ? slice.estimates[condition] : "");
  for (const SliceLabel &label : slice.labels)
    html += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", label.x, label.y, escape(label.organ));
  if (slice.labels.empty())
    html += fmt::format("<text class=\"none\" x=\"{:.1f}\" y=\"{:.1f}\">no organ</text>",
                        drawing.left + drawing.width / 2, drawing.top + drawing.height / 2);
  html += fmt::format("<path class=\"length\" d=\"M{:.1f} {:.1f}h20\"/><text class=\"length\" x=\"{:.1f}\" "
                      "y=\"{:.1f}\">20 mm</text>",
                      drawing.left + 4, drawing.top + drawing.height - 4, drawing.left + 31,
                      drawing.top + drawing.height - 4);
  return html + fmt::format("</svg><figcaption><b>{}{}</b> {}</figcaption></figure>\n", slice.index > 0 ? "+" : "",
                            slice.index, side);
}
} // namespace

SliceDrawing slice_drawing(const ReportInputs &inputs, const std::vector<MovingSurface> &truth,
                           const std::vector<ConditionSurfaces> &conditions)
{
  const runner::Evaluation &evaluation = inputs.evaluation;
  const PlaneView view(inputs.anatomy.dyn_plane);
  SliceDrawing drawing;
  Box box;
  for (int k = -evaluation.n_slices_each_side; k <= evaluation.n_slices_each_side; ++k)
  {
    const dataset::Plane plane = metrics::slice_plane(inputs.anatomy.dyn_plane, k, evaluation.slice_pitch);
    const auto truth_cuts = cut_all(truth, plane);
    SliceContours slice{k, paths_of(truth_cuts, view, box), {}, labels_of(truth_cuts, view)};
    for (const ConditionSurfaces &condition : conditions)
      slice.estimates.push_back(paths_of(cut_all(condition.organs, plane), view, box));
    drawing.slices.push_back(std::move(slice));
  }
  constexpr double margin = 3; // mm
  if (box.lower.x() > box.upper.x())
    return drawing;
  drawing.left = box.lower.x() - margin;
  drawing.top = box.lower.y() - margin;
  drawing.width = box.upper.x() - box.lower.x() + 2 * margin;
  drawing.height = box.upper.y() - box.lower.y() + 2 * margin;
  return drawing;
}

std::string slices_figure(const SliceDrawing &drawing, std::size_t condition, const std::string &name, double pitch)
{
  std::string html =
      fmt::format("<p class=\"slice-key\"><span class=\"line truth\"></span> truth <span class=\"line "
                  "estimate\"></span> estimate, condition <span class=\"slice-condition\">{}</span></p>\n"
                  "<div class=\"slice-grid\">\n",
                  escape(name));
  for (const SliceContours &slice : drawing.slices)
    html += panel(drawing, slice, condition, pitch);
  return html + "</div>\n";
}
} // namespace pelvireg::report
