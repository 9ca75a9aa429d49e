#include "registration/tracking/optical_flow.h"

#include <opencv2/video/tracking.hpp>

namespace pelvireg::tracking
{
namespace
{
const cv::Size window(13, 13);
constexpr int top_level = 2;

std::vector<cv::Point2f> single_precision(const std::vector<Eigen::Vector2d> &points)
{
  std::vector<cv::Point2f> converted;
  for (const Eigen::Vector2d &point : points)
    converted.emplace_back(static_cast<float>(point.x()), static_cast<float>(point.y()));
  return converted;
}
} // namespace

struct FlowFrame::Content
{
  cv::Mat pixels;
  std::vector<cv::Mat> pyramid;
};

FlowFrame::FlowFrame() = default;
FlowFrame::~FlowFrame() = default;
FlowFrame::FlowFrame(FlowFrame &&) noexcept = default;
FlowFrame &FlowFrame::operator=(FlowFrame &&) noexcept = default;

FlowFrame::FlowFrame(const Image &image, double low, double high) : content_(std::make_unique<Content>())
{
  cv::setNumThreads(1);
  const cv::Mat pixels(image.rows, image.columns, CV_32F, const_cast<float *>(image.pixels.data()));
  pixels.convertTo(content_->pixels, CV_8U, 255 / (high - low), -255 * low / (high - low));
  cv::buildOpticalFlowPyramid(content_->pixels, content_->pyramid, window, top_level);
}

std::vector<FlowPoint> FlowFrame::lucas_kanade(const FlowFrame &next, const std::vector<Eigen::Vector2d> &points) const
{
  if (points.empty())
    return {};
  const std::vector<cv::Point2f> start = single_precision(points);
  std::vector<cv::Point2f> there, back = start;
  std::vector<unsigned char> found_there, found_back;
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.01);
  cv::calcOpticalFlowPyrLK(content_->pyramid, next.content_->pyramid, start, there, found_there, cv::noArray(), window,
                           top_level, until);
  cv::calcOpticalFlowPyrLK(next.content_->pyramid, content_->pyramid, there, back, found_back, cv::noArray(), window,
                           top_level, until);
  std::vector<FlowPoint> result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    result[i] = {{there[i].x, there[i].y},
                 std::hypot(back[i].x - start[i].x, back[i].y - start[i].y),
                 found_there[i] != 0 && found_back[i] != 0};
  return result;
}

std::vector<Eigen::Vector2d> FlowFrame::dense_inverse_search(const FlowFrame &next,
                                                             const std::vector<Eigen::Vector2d> &points) const
{
  cv::Mat flow;
  cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM)->calc(content_->pixels, next.content_->pixels, flow);
  std::vector<Eigen::Vector2d> moved;
  for (const Eigen::Vector2d &point : points)
  {
    const double x = std::clamp(point.x(), 0.0, flow.cols - 1.001), y = std::clamp(point.y(), 0.0, flow.rows - 1.001);
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const double fx = x - column, fy = y - row;
    const auto at = [&](int dx, int dy)
    {
      const auto value = flow.at<cv::Vec2f>(row + dy, column + dx);
      return Eigen::Vector2d(value[0], value[1]);
    };
    moved.push_back(point + (1 - fy) * ((1 - fx) * at(0, 0) + fx * at(1, 0)) +
                    fy * ((1 - fx) * at(0, 1) + fx * at(1, 1)));
  }
  return moved;
}

FlowScale::FlowScale(const Image &first) : low(percentile_of(first, 0.001))
{
  const double range = percentile_of(first, 0.999) - low;
  high = low + std::max(1.2 * range, 1e-6 * std::max(1.0, std::abs(low)));
}
} // namespace pelvireg::tracking
