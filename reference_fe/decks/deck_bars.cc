#include "reference_fe/decks/deck_bars.h"

#include "reference_fe/elements/truss.h"

#include <algorithm>

namespace pelvireg::reference_fe
{
namespace
{
/// Stretches of a spring's table: fine where bars mostly are.
std::vector<double> tabulated_stretches()
{
  std::vector<double> stretches;
  for (int i = 30; i < 80; i += 5)
    stretches.push_back(0.01 * i);
  for (int i = 80; i < 130; ++i)
    stretches.push_back(0.01 * i);
  for (int i = 130; i <= 250; i += 5)
    stretches.push_back(0.01 * i);
  return stretches;
}
} // namespace

void write_trusses(DeckText &deck, const DeckMesh &mesh)
{
  struct Section
  {
    const DeckBar *first;
    std::vector<int> bars;
  };
  std::vector<Section> sections;
  for (std::size_t b = 0; b < mesh.bars().size(); ++b)
  {
    const DeckBar &bar = mesh.bars()[b];
    const auto is_same = [&](const Section &s)
    { return s.first->group == bar.group && s.first->area == bar.area && s.first->material == bar.material; };
    const auto same = std::find_if(sections.begin(), sections.end(), is_same);
    if (same == sections.end())
      sections.push_back({&bar, {static_cast<int>(b)}});
    else
      same->bars.push_back(static_cast<int>(b));
  }
  int number = 0;
  for (const Section &section : sections)
  {
    const std::string name = fmt::format("BARS_{}_{}", ++number, deck_name(section.first->group));
    deck.line("*ELEMENT, TYPE=T3D2, ELSET={}", name);
    for (const int b : section.bars)
      deck.line("{},{},{}", mesh.first_bar() + b, mesh.bars()[static_cast<std::size_t>(b)].node_a,
                mesh.bars()[static_cast<std::size_t>(b)].node_b);
    deck.line("*SOLID SECTION, ELSET={}, MATERIAL={}\n{:.9g}", name, deck_name(section.first->material),
              section.first->area);
  }
}

void write_springs(DeckText &deck, const DeckMesh &mesh, const dataset::ReferenceModel &reference)
{
  const std::vector<double> stretches = tabulated_stretches();
  int id = mesh.first_bar();
  for (const DeckBar &bar : mesh.bars())
  {
    const std::string name = fmt::format("BAR_{}_{}", id, deck_name(bar.group));
    const double length = (mesh.nodes().at(bar.node_b) - mesh.nodes().at(bar.node_a)).norm();
    deck.line("*ELEMENT, TYPE=SPRINGA, ELSET={}\n{},{},{}\n*SPRING, ELSET={}, NONLINEAR\n", name, id++, bar.node_a,
              bar.node_b, name);
    for (const double stretch : stretches)
      deck.line("{:.9g},{:.9g}", bar.area * uniaxial_response(reference.materials.at(bar.material), stretch).stress,
                length * (stretch - 1));
  }
}
} // namespace pelvireg::reference_fe
