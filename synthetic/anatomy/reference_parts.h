// The reference's discretisation: shells, solid, bars.
#pragma once

#include "synthetic/anatomy/organs.h"

namespace pelvireg::anatomy
{
/// A shell on the mid-surface between the charts' outer surface and the same moved inward by `thickness`.
/// `offset` -1/2: the charts are the outer surface; 0: they are the mid-surface.
dataset::ReferenceShell make_shell(const std::string &name, const std::string &material,
                                   const std::vector<Chart> &charts, double thickness, double offset);

/// The uterus: quadratic tetrahedra whose boundary nodes lie on the charts. Throws ComputationError when one is
/// inverted.
dataset::ReferenceSolid make_solid(const std::string &name, const std::string &material,
                                   const std::vector<Chart> &charts, double size);

/// Parts, materials, bars, contact pairs, ties.
dataset::ReferenceModel make_reference(const Parameters &parameters);

/// Bars of all supports, of the urethra and of the hiatus.
std::vector<dataset::ReferenceTruss> make_bars(const Parameters &parameters, const dataset::ReferenceModel &model);
} // namespace pelvireg::anatomy
