// Checks a term against difference quotients: the residual is the derivative of the energy, the tangent of the
// residual.
#pragma once

#include "reference_fe/term.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pelvireg::reference_fe
{
/// Deterministic numbers in [-1, 1], the same on every machine.
inline Eigen::VectorXd scattered(int n, unsigned seed)
{
  Eigen::VectorXd values(n);
  for (int i = 0; i < n; ++i)
  {
    seed = seed * 1664525u + 1013904223u;
    values[i] = static_cast<double>(seed >> 8) / (1 << 23) - 1;
  }
  return values;
}

/// Largest error of the tangent against central differences of the residual, relative to the largest entry.
inline double tangent_error(const Term &term, int item, const Eigen::VectorXd &solution, double step)
{
  LocalSystem at, plus, minus;
  term.unknowns(item, at.unknowns);
  term.evaluate(item, solution, at);
  double error = 0;
  for (std::size_t j = 0; j < at.unknowns.size(); ++j)
  {
    Eigen::VectorXd moved = solution;
    moved[at.unknowns[j]] += step;
    term.evaluate(item, moved, plus);
    moved[at.unknowns[j]] -= 2 * step;
    term.evaluate(item, moved, minus);
    const Eigen::VectorXd quotient = (plus.residual - minus.residual) / (2 * step);
    error = std::max(error, (quotient - at.tangent.col(static_cast<Eigen::Index>(j))).cwiseAbs().maxCoeff());
  }
  return error / at.tangent.cwiseAbs().maxCoeff();
}

/// Largest error of the residual against central differences of the energy, relative to the largest entry.
inline double residual_error(const Term &term, int item, const Eigen::VectorXd &solution, double step)
{
  LocalSystem at, plus, minus;
  term.unknowns(item, at.unknowns);
  term.evaluate(item, solution, at);
  double error = 0;
  for (std::size_t j = 0; j < at.unknowns.size(); ++j)
  {
    Eigen::VectorXd moved = solution;
    moved[at.unknowns[j]] += step;
    term.evaluate(item, moved, plus);
    moved[at.unknowns[j]] -= 2 * step;
    term.evaluate(item, moved, minus);
    const double quotient = (plus.energy - minus.energy) / (2 * step);
    error = std::max(error, std::abs(quotient - at.residual[static_cast<Eigen::Index>(j)]));
  }
  return error / at.residual.cwiseAbs().maxCoeff();
}
} // namespace pelvireg::reference_fe
