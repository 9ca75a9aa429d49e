// How far a solution on a mesh is from the one on a mesh without end.
#pragma once

#include "synthetic/dataset/geometry.h"

#include <vector>

namespace pelvireg::metrics
{
/// One field on three meshes at the same k material points (k x 3, mm): coarse, middle, fine.
struct GridSeries
{
  dataset::Points coarse, middle, fine;
  double coarse_ratio = 0; ///< cell size of coarse over middle, > 1
  double fine_ratio = 0;   ///< cell size of middle over fine, > 1
};

/// Grid convergence index of the fine mesh (Roache 1994; Celik et al., J. Fluids Eng. 130, 2008, 078001).
struct GridConvergence
{
  double coarse_difference = 0, fine_difference = 0; ///< mm, root mean square of coarse - middle and middle - fine
  double observed_order = 0; ///< of the two; negative when the differences grow, infinite when fine equals middle
  double used_order = 0;     ///< observed, kept within 1 … 3 (quadratic cells)
  double safety_factor = 0;  ///< 1.25; 3 where the observed order is below 1: no asymptotic range, no trust
  std::vector<double> index; ///< mm, at each point: safety factor |middle - fine| / (r^p - 1), an error bar
};

/// Throws InputError for fields of different size, none at all, values that are not finite or ratios not above 1.
GridConvergence grid_convergence(const GridSeries &series);
} // namespace pelvireg::metrics
