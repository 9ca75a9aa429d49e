#include "registration/tracking/grey_image.h"

#include <opencv2/imgproc.hpp>

#include <numbers>

namespace pelvireg::tracking
{
GreyImage::GreyImage(const Image &image, double sigma) : image_(image)
{
  if (sigma <= 0)
    return;
  cv::setNumThreads(1);
  cv::Mat pixels(image_.rows, image_.columns, CV_32F, image_.pixels.data());
  cv::GaussianBlur(pixels, pixels, cv::Size(), sigma, sigma, cv::BORDER_REPLICATE);
}

double noise_of(const Image &image)
{
  const auto at = [&](int column, int row)
  { return static_cast<double>(image.pixels[static_cast<std::size_t>(row) * image.columns + column]); };
  double sum = 0;
  for (int y = 1; y + 1 < image.rows; ++y)
    for (int x = 1; x + 1 < image.columns; ++x)
      sum += std::abs(at(x - 1, y - 1) - 2 * at(x, y - 1) + at(x + 1, y - 1) - 2 * at(x - 1, y) + 4 * at(x, y) -
                      2 * at(x + 1, y) + at(x - 1, y + 1) - 2 * at(x, y + 1) + at(x + 1, y + 1));
  return std::sqrt(std::numbers::pi / 2) * sum / (6.0 * (image.columns - 2) * (image.rows - 2));
}

double agreement_of(double squared_difference, double noise, double tolerance)
{
  const double usual = 2 * noise * noise + tolerance * tolerance;
  return std::exp(-std::max(0.0, squared_difference / usual - 1) / 2);
}

double percentile_of(const Image &image, double share)
{
  std::vector<float> values = image.pixels;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double contrast_of(const Image &image)
{
  return percentile_of(image, 0.99) - percentile_of(image, 0.01);
}
} // namespace pelvireg::tracking
