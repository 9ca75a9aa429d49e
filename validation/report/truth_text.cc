#include "validation/report/truth_text.h"

#include "validation/report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pelvireg::report
{
namespace
{
std::string error_bar_html(const dataset::DiscretisationError &error)
{
  std::vector<std::string> heading = {"Error bar of the truth's mesh at the last increment (mm)"}, mean = {"mean"},
                           largest = {"largest"};
  const Eigen::Index last = error.mean.size() - 1;
  for (std::size_t organ = 0; organ < dataset::organ_names.size(); ++organ)
  {
    heading.push_back(dataset::organ_names[organ]);
    mean.push_back(fmt::format("{:.3f}", error.mean_by_organ(last, static_cast<Eigen::Index>(organ))));
    largest.push_back(fmt::format("{:.3f}", error.max_by_organ(last, static_cast<Eigen::Index>(organ))));
  }
  return table(heading, {mean, largest}) +
         fmt::format(
             "<p>Grid convergence index from meshes of {}, {} and {} quadrilaterals (the truth's is the "
             "finest), observed order {:.2f}, safety factor {:.2f}, over the organs' outer surfaces farther than "
             "{:g} mm from the end of a bar ({:.0f} % of the points are nearer; there at most {:.2f} mm). Over "
             "all increments: mean at most {:.3f} mm, largest {:.3f} mm. {}</p>\n",
             error.n_cells[0], error.n_cells[1], error.n_cells[2], error.observed_order, error.safety_factor,
             error.bar_distance, 100 * error.share_near_bars, error.max_near_bars.maxCoeff(), error.mean.maxCoeff(),
             error.max.maxCoeff(),
             error.same_solver ? "Made by the solver that made this truth."
                               : "Made by another revision of the solver (" + escape(error.revision) + ").");
}

std::string balance_html(const dataset::Truth &truth)
{
  double energy = 0, force = 0;
  for (const dataset::BalanceRecord &balance : truth.balances)
  {
    energy = std::max(energy, std::abs(balance.energy_error_percent));
    force = std::max(force, balance.force_error);
  }
  return fmt::format("<p>External work equals strain, contact and tie energy and the work done on the fluids within "
                     "{:.2f} % at every increment; the forces on the pelvis within {:.1e} N.</p>\n",
                     energy, force);
}

/// Rounded to hundredths; never -0.
double without_sign_of_zero(double value)
{
  return std::round(100 * value) / 100 + 0.0;
}

std::string volumes_html(const dataset::Truth &truth)
{
  std::string text;
  for (std::size_t c = 0; c < truth.cavity_names.size(); ++c)
  {
    const auto column = static_cast<Eigen::Index>(c);
    const dataset::IncrementRecord &last = truth.increments.back();
    text +=
        fmt::format("{}{} {:.2f} kPa, volume {:+.2f} %", c > 0 ? "; " : "", escape(truth.cavity_names[c]),
                    1e3 * last.cavity_pressures[column],
                    without_sign_of_zero(100 * (last.cavity_volumes[column] / truth.cavity_rest_volumes[column] - 1)));
  }
  return text.empty() ? "" : "<p>Fluids at the last increment: " + text + ".</p>\n";
}
} // namespace

std::string truth_quality_html(const dataset::Truth &truth)
{
  if (truth.increments.empty())
    return "";
  double penetration = 0;
  for (const dataset::IncrementRecord &increment : truth.increments)
    penetration = std::max(penetration, increment.max_penetration);
  std::string html = truth.discretisation_error
                         ? error_bar_html(*truth.discretisation_error)
                         : "<p>The error of the truth's mesh is not known: no mesh study of this case is part of the "
                           "program (pelvireg mesh-study makes one).</p>\n";
  html += truth.balances.empty() ? "<p>The truth does not say whether its energies and forces balance.</p>\n"
                                 : balance_html(truth);
  html += fmt::format("<p>Deepest penetration between organs over all increments: {:.3f} mm.</p>\n", penetration);
  return html + volumes_html(truth);
}
} // namespace pelvireg::report
