#include "validation/report/figure_files.h"

#include "synthetic/dataset/geometry.h"
#include "validation/report/figures.h"
#include "validation/report/plane_overlays.h"
#include "validation/report/svg.h"
#include "validation/runner/result_files.h"

#include <fmt/format.h>

namespace pelvireg::report
{
namespace
{
/// The figure above its key, on white. Both begin with "<svg ".
std::string standing_alone(const std::string &svg, double width, double height, const std::string &key,
                           double key_width)
{
  constexpr double key_height = 26;
  return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
                     "height=\"{1:g}\" font-family=\"Liberation Sans, Arial, sans-serif\">\n<rect width=\"{0:g}\" "
                     "height=\"{1:g}\" fill=\"#fff\"/>\n",
                     width, height + key_height) +
         placed(svg, 0, 0, width, height) + placed(key, (width - key_width) / 2, height, key_width, key_height) +
         "</svg>\n";
}
} // namespace

std::vector<std::string> figure_file_names(const std::vector<std::string> &conditions)
{
  std::vector<std::string> names;
  for (const std::string &condition : conditions)
    for (const char *figure : {"error_by_step", "error_by_slice", "image_plane"})
      names.push_back(fmt::format("{}-{}.svg", figure, condition));
  return names;
}

void write_figures(const ReportInputs &inputs, const std::filesystem::path &folder)
{
  std::filesystem::create_directories(folder);
  const std::string key = legend_svg(dataset::organ_names);
  const auto write =
      [&](const std::string &figure, const std::string &condition, const std::string &svg, const std::string &its_key)
  {
    const auto [width, height] = size_of(svg);
    runner::write_text_file(folder / fmt::format("{}-{}.svg", figure, condition),
                            standing_alone(svg, width, height, its_key, size_of(its_key).first));
  };
  for (const NamedPlot &plot : error_by_step_plots(inputs.evaluation))
    write("error_by_step", plot.condition, line_plot_svg(plot.plot), key);
  for (const NamedPlot &plot : error_by_slice_plots(inputs.evaluation))
    write("error_by_slice", plot.condition, line_plot_svg(plot.plot), key);
  for (const NamedSvg &panel : plane_overlays(inputs, truth_surfaces(inputs.truth), nominal_surfaces(inputs)))
    write("image_plane", panel.condition, panel.svg, overlay_key_svg());
}
} // namespace pelvireg::report
