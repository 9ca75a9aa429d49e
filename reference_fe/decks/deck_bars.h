// Ligaments, fasciae and supports in a deck.
#pragma once

#include "reference_fe/decks/deck_mesh.h"
#include "reference_fe/decks/deck_text.h"
#include "synthetic/dataset/anatomy.h"

namespace pelvireg::reference_fe
{
/// T3D2 in one element set for each group, section and material, in the order of their first bars.
void write_trusses(DeckText &deck, const DeckMesh &mesh);

/// SPRINGA, each with its table of force over elongation: the reference's own incompressible law between stretches of
/// 0.3 and 2.5. CalculiX makes bricks with hinges of T3D2, which many bars side by side keep from converging.
void write_springs(DeckText &deck, const DeckMesh &mesh, const dataset::ReferenceModel &reference);
} // namespace pelvireg::reference_fe
