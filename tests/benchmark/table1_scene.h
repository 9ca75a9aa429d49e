// The paper's Table 1 as a made-up pelvis: seven bodies of its sizes, at about their places, without any patient's
// shape.
#pragma once

#include "registration/registration.h"

#include <array>
#include <string>
#include <vector>

namespace pelvireg::bench
{
/// Nodes wanted of vagina, uterus, bladder, rectum, pelvic fascia, sacral fascia, ligaments.
using Counts = std::array<double, 7>;

/// Columns of Table 1: "T005" or "T007".
Counts table1_counts(const std::string &data_set);

struct Scene
{
  registration::Model model;
  /// One image a step, played again from the start at the end; 70 control points each.
  std::vector<registration::Observation> observations;
};

/// Four organs (the uterus solid, the others one layer of tetrahedra about a cavity), two fasciae and five bands of
/// hexahedra. Every body has `scale` times the nodes asked for, as nearly as its grid allows. Attachments hold 40 nodes
/// (120 rows) whatever the scale. Neighbouring organs overlap by a fraction of a millimetre at rest, so that they
/// touch.
Scene table1_scene(const Counts &counts, double scale);
} // namespace pelvireg::bench
