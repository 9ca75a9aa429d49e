#include "validation/report/svg.h"

#include <fmt/format.h>

#include <sstream>

namespace pelvireg::report
{
std::string placed(const std::string &svg, double x, double y, double width, double height)
{
  const std::string start = "<svg ";
  return fmt::format("<svg x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" {}", x, y, width, height,
                     svg.substr(start.size()));
}

std::pair<double, double> size_of(const std::string &svg)
{
  const std::string before = "viewBox=\"0 0 ";
  const std::size_t at = svg.find(before);
  if (at == std::string::npos)
    return {0, 0};
  std::istringstream text(svg.substr(at + before.size(), 40));
  double width = 0, height = 0;
  text >> width >> height;
  return {width, height};
}
} // namespace pelvireg::report
