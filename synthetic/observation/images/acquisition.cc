#include "synthetic/observation/images/acquisition.h"

#include "synthetic/dataset/error.h"
#include "synthetic/observation/images/random_field.h"

#include <fftw3.h>
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace pelvireg::observation
{
namespace
{
using Complex = std::complex<double>;
using Spectrum = std::vector<Complex>; ///< row-major

fftw_plan plan_of(void *plan)
{
  return static_cast<fftw_plan>(plan);
}

/// FFTW_ESTIMATE: the plan does not depend on the machine's load; FFTW_UNALIGNED: nor on where the data lie.
fftw_plan new_plan(int rows, int columns, int sign)
{
  Spectrum data(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  auto *raw = reinterpret_cast<fftw_complex *>(data.data());
  return fftw_plan_dft_2d(rows, columns, raw, raw, sign, FFTW_ESTIMATE | FFTW_UNALIGNED);
}

void transform(void *plan, Spectrum &data)
{
  auto *raw = reinterpret_cast<fftw_complex *>(data.data());
  fftw_execute_dft(plan_of(plan), raw, raw);
}

/// Index of frequency k in an array of n.
std::size_t index_of(int k, int n)
{
  return static_cast<std::size_t>(k < 0 ? k + n : k);
}

/// Of a fine array of n samples: undoes the mean over a fine pixel, and moves the origin from the first fine pixel's
/// centre to the first pixel's.
Complex correction(int k, int n, int oversampling)
{
  const double angle = std::numbers::pi * k / n;
  const double pixel_mean = k == 0 ? 1 : std::sin(angle) / angle;
  return std::polar(1 / pixel_mean, angle * (oversampling - 1));
}
} // namespace

Acquisition::Acquisition(const AcquisitionSetting &setting) : setting_(setting)
{
  const auto require = [](int acquired, int size, const char *word)
  {
    if (acquired < 8 || acquired > size)
      throw InputError(fmt::format("Images of {} {} are to be made from {} acquired ones, but 8 to {} are allowed; "
                                   "change the acquired matrix.",
                                   size, word, acquired, size));
  };
  require(setting.acquired_rows, setting.rows, "rows");
  require(setting.acquired_columns, setting.columns, "columns");
  forward_ = new_plan(setting.rows * setting.oversampling, setting.columns * setting.oversampling, FFTW_FORWARD);
  backward_ = new_plan(setting.rows, setting.columns, FFTW_BACKWARD);
}

Acquisition::~Acquisition()
{
  fftw_destroy_plan(plan_of(forward_));
  fftw_destroy_plan(plan_of(backward_));
}

Raster Acquisition::acquire(const std::vector<Raster> &ideal, std::uint32_t image) const
{
  const int rows = setting_.rows, columns = setting_.columns, factor = setting_.oversampling;
  const std::size_t n_pixels = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  const double n_fine = static_cast<double>(n_pixels) * factor * factor;
  const double n_acquired = static_cast<double>(setting_.acquired_rows) * setting_.acquired_columns;
  Spectrum k_space(n_pixels);
  std::uint32_t sample = 0;
  int line = 0;
  for (std::size_t segment = 0; segment < ideal.size(); ++segment)
  {
    Spectrum fine(ideal[segment].data(), ideal[segment].data() + ideal[segment].size());
    transform(forward_, fine);
    const int last = setting_.acquired_columns * static_cast<int>(segment + 1) / static_cast<int>(ideal.size());
    for (; line < last; ++line)
    {
      const int kc = line - setting_.acquired_columns / 2;
      const Complex column_factor = correction(kc, columns * factor, factor);
      for (int i = 0; i < setting_.acquired_rows; ++i)
      {
        const int kr = i - setting_.acquired_rows / 2;
        const Complex value = fine[index_of(kr, rows * factor) * static_cast<std::size_t>(columns * factor) +
                                   index_of(kc, columns * factor)];
        const auto [real, imaginary] = normal_pair(setting_.seed, image, sample++);
        k_space[index_of(kr, rows) * static_cast<std::size_t>(columns) + index_of(kc, columns)] =
            value * column_factor * correction(kr, rows * factor, factor) / n_fine +
            setting_.noise / std::sqrt(n_acquired) * Complex(real, imaginary);
      }
    }
  }
  transform(backward_, k_space);
  Raster magnitude(rows, columns);
  for (std::size_t i = 0; i < n_pixels; ++i)
    magnitude.data()[i] = static_cast<float>(std::abs(k_space[i]));
  return magnitude;
}
} // namespace pelvireg::observation
