// k-space truncation against Fourier series in closed form, noise against Rice's distribution.
#include "synthetic/dataset/error.h"
#include "synthetic/observation/images/acquisition.h"
#include "synthetic/observation/images/random_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pelvireg::observation
{
namespace
{
using std::numbers::pi;

/// Share of fine pixel `i` between two borders, in pixels; the field of view begins at -1/2.
float share(int i, int factor, double from, double to)
{
  const double left = (i + 0.0) / factor - 0.5, right = (i + 1.0) / factor - 0.5;
  return static_cast<float>(std::max(0.0, std::min(to, right) - std::max(from, left)) * factor);
}

Raster bar(int rows, int columns, int factor, double from, double to)
{
  Raster ideal(rows * factor, columns * factor);
  for (Eigen::Index column = 0; column < ideal.cols(); ++column)
    ideal.col(column) = share(static_cast<int>(column), factor, from, to);
  return ideal;
}

/// Sum of the Fourier series, of period n, of 1 on from … to, frequencies -k … k - 1, at x.
double truncated_series(double x, double from, double to, int n, int k)
{
  std::complex<double> sum = 0;
  for (int f = -k; f < k; ++f)
  {
    const double width = to - from, angle = pi * f * width / n;
    const double coefficient = f == 0 ? width / n : width / n * std::sin(angle) / angle;
    sum += coefficient * std::polar(1.0, 2 * pi * f * (x - 0.5 * (from + to)) / n);
  }
  return std::abs(sum);
}
} // namespace

TEST(Acquisition, OfABarIsItsFourierSeriesUpToTheLastLine)
{
  const int rows = 16, columns = 64;
  const double from = 20.3, to = 41.8;
  const Acquisition scanner({.rows = rows, .columns = columns, .acquired_rows = rows, .acquired_columns = 40});
  const Raster image = scanner.acquire({bar(rows, columns, 2, from, to)}, 0);
  // The fine pixels alias what lies beyond their own Nyquist frequency: 128 samples, 20 of 64 frequencies kept. The
  // largest alias at frequency f < 20 is a coefficient at 128 - f, below 1 / (pi 108), and signs alternate.
  for (int column = 0; column < columns; ++column)
    EXPECT_NEAR(image(5, column), truncated_series(column, from, to, columns, 20), 0.01) << column;
}

TEST(Acquisition, RingsAsGibbsSays)
{
  const int columns = 512;
  const Acquisition scanner({.rows = 8, .columns = columns, .acquired_rows = 8, .acquired_columns = 128});
  const Raster image = scanner.acquire({bar(8, columns, 2, 128, 384)}, 0);
  const float overshoot = image.row(3).maxCoeff() - 1;
  EXPECT_NEAR(overshoot, 0.0895,
              0.003); // Si(pi) / pi - 1/2 of the jump (Gibbs 1899): the first lobe's top, 4 pixels inside, is a pixel
}

TEST(Acquisition, WithAllLinesKeepsTheMeanAndThePlace)
{
  const Acquisition scanner({.rows = 32, .columns = 32, .acquired_rows = 32, .acquired_columns = 32});
  Raster ideal(64, 64);
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column)
    {
      // One wave, as its mean over a fine pixel; x and y at the fine pixel's centre, in pixels.
      const double x = (column + 0.5) / 2 - 0.5, mean = std::sin(pi * 3 / 64.0) / (pi * 3 / 64.0);
      ideal(row, column) = static_cast<float>(2 + mean * std::cos(2 * pi * 3 * x / 32));
    }
  const Raster image = scanner.acquire({ideal}, 0);
  for (int column = 0; column < 32; ++column)
    EXPECT_NEAR(image(7, column), 2 + std::cos(2 * pi * 3 * column / 32), 1e-5) << column;
}

TEST(Acquisition, TakesEachShareOfTheLinesFromItsInstant)
{
  const AcquisitionSetting setting{.rows = 16, .columns = 48, .acquired_rows = 16, .acquired_columns = 30};
  const Acquisition scanner(setting);
  const Raster nothing = Raster::Zero(32, 96), all = Raster::Ones(32, 96);
  // A constant image has the line at frequency 0 alone, number 15 of 30 lines: in the second of three instants.
  EXPECT_NEAR(scanner.acquire({nothing, all, nothing}, 0)(3, 20), 1, 1e-6);
  EXPECT_NEAR(scanner.acquire({all, nothing, all}, 0)(3, 20), 0, 1e-6);
}

TEST(Acquisition, NoiseInAirIsRayleigh)
{
  const double sigma = 0.05;
  const Acquisition scanner(
      {.rows = 128, .columns = 128, .acquired_rows = 128, .acquired_columns = 128, .noise = sigma});
  const Raster image = scanner.acquire({Raster::Zero(256, 256)}, 3);
  const double n = 128.0 * 128;
  const double mean = image.cast<double>().mean(), square = image.cast<double>().square().mean();
  // Five standard errors each.
  EXPECT_NEAR(mean, sigma * std::sqrt(pi / 2), 5 * sigma * std::sqrt((2 - pi / 2) / n));
  EXPECT_NEAR(square, 2 * sigma * sigma, 5 * 2 * sigma * sigma / std::sqrt(n));
}

TEST(Acquisition, NoiseOnASignalIsRicianAndTheRatioIsTheOneAskedFor)
{
  const double sigma = 0.1;
  const AcquisitionSetting setting{
      .rows = 128, .columns = 128, .acquired_rows = 128, .acquired_columns = 96, .noise = sigma};
  const Raster image = Acquisition(setting).acquire({Raster::Ones(256, 256)}, 0);
  const double n = 128.0 * 96; // independent samples
  const Eigen::ArrayXXd squares = image.cast<double>().square();
  const double square = squares.mean(), spread = (squares - square).square().mean();
  // E M^2 = A^2 + 2 sigma^2, Var M^2 = 4 sigma^2 (A^2 + sigma^2) (Rice 1944).
  EXPECT_NEAR(square, 1 + 2 * sigma * sigma, 5 * 2 * sigma * std::sqrt((1 + sigma * sigma) / n));
  EXPECT_NEAR(std::sqrt(spread) / (2 * sigma * std::sqrt(1 + sigma * sigma)), 1, 0.05);
}

TEST(Acquisition, NoiseDependsOnSeedAndImageAlone)
{
  AcquisitionSetting setting{.rows = 32, .columns = 32, .acquired_rows = 32, .acquired_columns = 24, .noise = 0.1};
  const Raster air = Raster::Zero(64, 64);
  const Acquisition scanner(setting);
  const Raster once = scanner.acquire({air}, 5);
  EXPECT_TRUE((once == Acquisition(setting).acquire({air}, 5)).all());
  EXPECT_FALSE((once == scanner.acquire({air}, 6)).any());
  setting.seed = 2;
  EXPECT_FALSE((once == Acquisition(setting).acquire({air}, 5)).any());
}

TEST(Acquisition, RefusesMoreLinesThanTheImageHas)
{
  EXPECT_THROW(Acquisition({.rows = 32, .columns = 32, .acquired_rows = 32, .acquired_columns = 34}), InputError);
  EXPECT_THROW(Acquisition({.rows = 32, .columns = 32, .acquired_rows = 4, .acquired_columns = 32}), InputError);
}

TEST(Texture, HasMeanZeroAndNoStructureFinerThanItsCell)
{
  double sum = 0, squares = 0, steepest = 0;
  int n = 0;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j, ++n)
    {
      const Eigen::Vector3d point(7.3 * i, 6.1 * j, 3.7 * (i + j));
      const double value = gradient_noise(point, 10, 4);
      sum += value;
      squares += value * value;
      steepest = std::max(steepest, std::abs(gradient_noise(point + Eigen::Vector3d(0.1, 0, 0), 10, 4) - value) / 0.1);
    }
  EXPECT_NEAR(sum / n, 0, 0.05);
  EXPECT_GT(squares / n, 0.03);
  EXPECT_LT(steepest, 3.0 / 10); // |slope| of the noise of cell 1 stays below 3
}
} // namespace pelvireg::observation
