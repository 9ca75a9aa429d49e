#include "reference_fe/decks/deck_bars.h"
#include "reference_fe/decks/deck_mesh.h"
#include "reference_fe/decks/deck_text.h"
#include "reference_fe/decks/decks.h"
#include "reference_fe/outer_surface.h"
#include "synthetic/dataset/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace pelvireg::reference_fe
{
namespace
{
using dataset::ReferenceModel;
using dataset::SurfaceRegion;

constexpr int most_layers = 8;
constexpr double least_share = 1e-9; ///< of the abdominal pressure on a face; within it of 1: the whole
/// Different names stay different in the deck.
void require_unique(const std::vector<std::string> &names, const char *kind)
{
  std::map<std::string, std::string> seen;
  for (const std::string &name : names)
    if (const auto [place, is_new] = seen.emplace(deck_name(name), name); !is_new || deck_name(name).empty())
      throw InputError(
          fmt::format("{} '{}' and '{}' have the same name '{}' in a deck, which knows letters, digits and "
                      "underscores without case; rename one",
                      kind, place->second, name, deck_name(name)));
}

void check_names(const ReferenceModel &reference)
{
  std::vector<std::string> parts, materials;
  for (const dataset::ReferenceShell &shell : reference.shells)
    parts.push_back(shell.name);
  for (const dataset::ReferenceSolid &solid : reference.solids)
    parts.push_back(solid.name);
  for (const auto &[name, material] : reference.materials)
    materials.push_back(name);
  require_unique(parts, "parts");
  require_unique(materials, "materials");
}

void check_loads(const DeckLoads &loads)
{
  const auto check = [&](const std::vector<double> &values, const std::string &what)
  {
    if (values.empty() || values.size() != loads.pressure.size())
      throw InputError(fmt::format("a deck needs one {} a step, got {} for {} steps; give a pressure or a truth", what,
                                   values.size(), loads.pressure.size()));
    for (const double value : values)
      if (!std::isfinite(value))
        throw InputError(
            fmt::format("the {} of a deck is {}, must be finite; mend the truth or the pressure", what, value));
  };
  check(loads.pressure, "abdominal pressure");
  for (const auto &[part, values] : loads.cavity_pressure)
    check(values, "fluid pressure of '" + part + "'");
}

std::string joined(const std::vector<std::pair<std::string, std::string>> &pairs)
{
  std::string text;
  for (const auto &[a, b] : pairs)
    text += (text.empty() ? "" : ", ") + printable(a) + "-" + printable(b);
  return text.empty() ? "none" : text;
}

void write_header(DeckText &deck, const dataset::Anatomy &anatomy, const DeckLoads &loads, const DeckOptions &options)
{
  const ReferenceModel &reference = anatomy.reference;
  std::string cavities;
  for (const dataset::ReferenceShell &shell : reference.shells)
    if (shell.has_cavity)
      cavities += (cavities.empty() ? "" : ", ") + printable(shell.name) +
                  (loads.cavity_pressure.contains(shell.name) ? " (its pressure is given)" : " (empty)");
  deck.line("*HEADING\npelvireg case {}", printable(anatomy.case_name));
  deck.line("** Units mm, N, MPa, tonne, s. Frame LPS (+x left, +y posterior, +z superior).");
  deck.line("** Given: shells as C3D20R, {} through the wall; solids as C3D10; bars as {} on the mid-surface;",
            options.layers, options.springs ? "SPRINGA" : "T3D2");
  deck.line("**   supports, ties, follower pressure (abdominal, a mean share a face), {} steps with NLGEOM.",
            loads.pressure.size());
  deck.line("**   Energy sum C_i0 (I1bar - 3)^i + (J - 1)^2 / D1 with D1 = 2 / kappa, as the reference's own.");
  deck.line("** Not given: contact between parts ({}).", joined(reference.contact_pairs));
  deck.line("** Not given: incompressible fluid of cavities ({}), nor its pressure on the flat caps of open ends.",
            cavities.empty() ? "none" : cavities);
  deck.line(
      "** Abaqus: C3D20RH and C3D10H (hybrid) suit these nearly incompressible materials better; CalculiX has none.");
  deck.line("** CalculiX: run 'ccx' on this file's name without .inp, then 'pelvireg import DIR --from NAME.frd'.");
}

void write_nodes(DeckText &deck, const DeckMesh &mesh)
{
  deck.line("*NODE, NSET=ALL_NODES");
  for (const auto &[id, x] : mesh.nodes())
    deck.line("{},{:.9g},{:.9g},{:.9g}", id, x[0], x[1], x[2]);
}

std::string surface_name(const std::string &part, const std::string &what)
{
  return deck_name(part) + "_" + what;
}

void write_surface(DeckText &deck, const std::string &name, const std::vector<DeckFace> &faces)
{
  deck.line("*SURFACE, NAME={}, TYPE=ELEMENT", name);
  for (const DeckFace &face : faces)
    deck.line("{},S{}", face.element, face.number);
}

void write_bodies(DeckText &deck, const DeckMesh &mesh)
{
  for (const DeckBody &body : mesh.bodies())
  {
    deck.line("*ELEMENT, TYPE={}, ELSET={}", body.element_type, deck_name(body.part));
    int id = body.first_element;
    std::set<int> used;
    for (const std::vector<int> &nodes : body.elements)
    {
      std::vector<std::string> words = {std::to_string(id++)};
      for (const int node : nodes)
        words.push_back(std::to_string(node));
      deck.list(words, 11);
      used.insert(nodes.begin(), nodes.end());
    }
    deck.line("*NSET, NSET={}_NODES", deck_name(body.part));
    std::vector<std::string> words;
    for (const int node : used)
      words.push_back(std::to_string(node));
    deck.list(words, 16);
    deck.line("*SOLID SECTION, ELSET={}, MATERIAL={}", deck_name(body.part), deck_name(body.material));
    write_surface(deck, surface_name(body.part, "OUTER"), body.outer_faces);
    if (!body.inner_faces.empty())
      write_surface(deck, surface_name(body.part, "INNER"), body.inner_faces);
  }
}

/// D2 and D3 large: (J - 1)^4 / D2 + (J - 1)^6 / D3 vanish. Zeros would make CalculiX take values of its own.
void write_materials(DeckText &deck, const ReferenceModel &reference)
{
  for (const auto &[name, m] : reference.materials)
  {
    deck.line("*MATERIAL, NAME={}", deck_name(name));
    if (m.c20 == 0 && m.c30 == 0)
      deck.line("*HYPERELASTIC, NEO HOOKE\n{:.9g},{:.9g}", m.c10, 2 / m.kappa);
    else
      deck.line("*HYPERELASTIC, YEOH\n{:.9g},{:.9g},{:.9g},{:.9g},1.e6,1.e6", m.c10, m.c20, m.c30, 2 / m.kappa);
  }
}

/// A held point between nodes: one of them that no other equation has taken follows from the rest.
void write_held_point(DeckText &deck, const DeckPoint &point, const std::set<int> &held, std::set<int> &taken)
{
  const auto dependent =
      std::find_if(point.nodes.begin(), point.nodes.end(), [&](int node) { return !taken.contains(node); });
  if (dependent == point.nodes.end())
    return; // every node of it is held already
  taken.insert(*dependent);
  std::vector<int> nodes = {*dependent};
  std::vector<double> weights = {point.weights[static_cast<std::size_t>(dependent - point.nodes.begin())]};
  for (std::size_t i = 0; i < point.nodes.size(); ++i)
    if (point.nodes[i] != nodes.front() && !held.contains(point.nodes[i]))
    {
      nodes.push_back(point.nodes[i]);
      weights.push_back(point.weights[i]);
    }
  deck.equations(nodes, weights);
}

/// Held points, and nodes of bars that hang on a wall between its nodes.
void write_constraints(DeckText &deck, const DeckMesh &mesh)
{
  std::set<int> taken; // fixed, or eliminated by an equation
  for (const DeckPoint &point : mesh.fixed_points())
    if (point.is_node())
      taken.insert(point.nodes.front());
  if (!taken.empty())
  {
    deck.line("*NSET, NSET=FIXED");
    std::vector<std::string> words;
    for (const int node : taken)
      words.push_back(std::to_string(node));
    deck.list(words, 16);
    deck.line("*BOUNDARY\nFIXED,1,3");
  }
  std::set<int> held = taken;
  for (const DeckPoint &point : mesh.fixed_points())
    if (!point.is_node())
      write_held_point(deck, point, held, taken);
  for (const auto &[id, point] : mesh.carried_nodes())
  {
    DeckPoint equation{{id}, {-1}};
    equation.nodes.insert(equation.nodes.end(), point.nodes.begin(), point.nodes.end());
    equation.weights.insert(equation.weights.end(), point.weights.begin(), point.weights.end());
    deck.equations(equation.nodes, equation.weights);
  }
}

/// Faces of one part, by the region of the reference's cell or boundary face.
std::vector<DeckFace> outer_faces(const DeckBody &body, const dataset::Integers &region, SurfaceRegion wanted)
{
  std::vector<DeckFace> faces;
  for (Eigen::Index c = 0; c < region.size(); ++c)
    if (region[c] == static_cast<std::int32_t>(wanted))
      faces.push_back(body.outer_faces[static_cast<std::size_t>(c)]);
  return faces;
}

const dataset::Integers &region_of(const ReferenceModel &reference, const std::string &part)
{
  for (const dataset::ReferenceShell &shell : reference.shells)
    if (shell.name == part)
      return shell.region;
  return std::find_if(reference.solids.begin(), reference.solids.end(), [&](const auto &s) { return s.name == part; })
      ->region;
}

/// Mean of a face's shares of the pressure over its area at rest.
double mean_share(const SurfaceFace &face, const Eigen::VectorXd &shares)
{
  Eigen::Matrix3Xd x(3, shares.size());
  for (Eigen::Index i = 0; i < shares.size(); ++i)
    x.col(i) = face.nodes[static_cast<std::size_t>(i)].rest_position();
  double sum = 0, area = 0;
  for (const FacePoint &q : face_quadrature(static_cast<int>(shares.size())))
  {
    const double weight = q.weight * Eigen::Vector3d(x * q.d_xi).cross(Eigen::Vector3d(x * q.d_eta)).norm();
    sum += weight * q.value.dot(shares);
    area += weight;
  }
  return sum / area;
}

/// Mean share of the abdominal pressure on every outer face of a part, in the order of DeckBody::outer_faces.
std::vector<double> mean_shares(const ReferenceModel &reference, const std::string &part)
{
  std::vector<double> shares;
  for (const dataset::ReferenceShell &shell : reference.shells)
    for (Eigen::Index c = 0; shell.name == part && c < shell.cells.rows(); ++c)
      shares.push_back(mean_share(shell_face(shell, 0, c, +1), pressure_shares(shell, c)));
  for (const dataset::ReferenceSolid &solid : reference.solids)
    for (Eigen::Index f = 0; solid.name == part && f < solid.faces.rows(); ++f)
      shares.push_back(mean_share(solid_face(solid, 0, f), pressure_shares(solid, f)));
  return shares;
}

/// The patch of b follows whatever outer face of a it lies on, as in the reference.
void write_ties(DeckText &deck, const DeckMesh &mesh, const ReferenceModel &reference)
{
  for (const auto &[a, b] : reference.ties)
  {
    const auto body =
        std::find_if(mesh.bodies().begin(), mesh.bodies().end(), [&](const DeckBody &x) { return x.part == b; });
    const std::vector<DeckFace> patch = outer_faces(*body, region_of(reference, b), SurfaceRegion::cervix_patch);
    if (patch.empty())
      throw InputError(
          fmt::format("tie {}-{}: part '{}' has no cell of region cervix_patch; mark the shared patch", a, b, b));
    write_surface(deck, surface_name(b, "PATCH"), patch);
    deck.line("*TIE, NAME=TIE_{}_{}, POSITION TOLERANCE=5., ADJUST=NO\n{},{}", deck_name(a).substr(0, 30),
              deck_name(b).substr(0, 30), surface_name(b, "PATCH"), surface_name(a, "OUTER"));
  }
}

/// Pressure over the total time: step i ends at time i.
void write_amplitude(DeckText &deck, const std::string &name, const std::vector<double> &pressure)
{
  deck.line("*AMPLITUDE, NAME={}, TIME=TOTAL TIME", name);
  std::vector<std::string> words = {"0.,0."};
  for (std::size_t i = 0; i < pressure.size(); ++i)
    words.push_back(fmt::format("{}.,{:.9g}", i + 1, pressure[i]));
  deck.list(words, 4);
}

void write_loads(DeckText &deck, const DeckMesh &mesh, const ReferenceModel &reference, const DeckLoads &loads,
                 std::vector<std::string> &cards)
{
  write_amplitude(deck, "ABDOMINAL_PRESSURE", loads.pressure);
  for (const DeckBody &body : mesh.bodies())
  {
    const std::vector<double> shares = mean_shares(reference, body.part);
    std::vector<DeckFace> faces;
    std::string partial;
    for (std::size_t f = 0; f < shares.size(); ++f)
      if (shares[f] > 1 - least_share)
        faces.push_back(body.outer_faces[f]);
      else if (shares[f] > least_share)
        partial += fmt::format("\n{},P{},{:.9g}", body.outer_faces[f].element, body.outer_faces[f].number, shares[f]);
    if (!partial.empty())
      cards.push_back("*DLOAD, AMPLITUDE=ABDOMINAL_PRESSURE" + partial);
    if (!faces.empty())
    {
      write_surface(deck, surface_name(body.part, "PERITONEAL"), faces);
      cards.push_back(
          fmt::format("*DSLOAD, AMPLITUDE=ABDOMINAL_PRESSURE\n{},P,1.", surface_name(body.part, "PERITONEAL")));
    }
    if (const auto cavity = loads.cavity_pressure.find(body.part); cavity != loads.cavity_pressure.end())
    {
      const std::string amplitude = "FLUID_" + deck_name(body.part);
      write_amplitude(deck, amplitude, cavity->second);
      cards.push_back(fmt::format("*DSLOAD, AMPLITUDE={}\n{},P,1.", amplitude, surface_name(body.part, "INNER")));
    }
  }
  if (cards.empty())
    throw InputError("no part has a cell of region peritoneal, so nothing carries the abdominal pressure; mark the "
                     "peritoneal surfaces in the anatomy or export other parts");
}

/// CalculiX' T3D2 keeps residuals of about 1 % of the mean force at its hinges however small the corrections get. With
/// bars the correction decides: at most 0.1 % of the increment's largest displacement.
constexpr const char *controls_with_trusses = "*CONTROLS, PARAMETERS=FIELD\n0.05,0.001";

void write_steps(DeckText &deck, std::size_t n_steps, const std::vector<std::string> &loads, bool has_trusses)
{
  for (std::size_t step = 1; step <= n_steps; ++step)
  {
    deck.line("** increment {}\n*STEP, NLGEOM, INC=1000\n*STATIC\n0.25,1.,1.e-5,1.", step);
    if (has_trusses)
      deck.line("{}", controls_with_trusses);
    if (step == 1)
      for (const std::string &card : loads)
        deck.line("{}", card);
    deck.line("*NODE FILE, FREQUENCY=1000000\nU\n*END STEP");
  }
}
} // namespace

std::string abaqus_deck(const dataset::Anatomy &anatomy, const DeckLoads &loads, const DeckOptions &options)
{
  const ReferenceModel &reference = anatomy.reference;
  check_loads(loads);
  if (options.layers < 1 || options.layers > most_layers)
    throw InputError(fmt::format("a deck has 1 to {} bricks through a wall, got {}; give another number", most_layers,
                                 options.layers));
  check_names(reference);
  const DeckMesh mesh(reference, options.layers);
  DeckText deck;
  write_header(deck, anatomy, loads, options);
  write_nodes(deck, mesh);
  write_bodies(deck, mesh);
  if (options.springs)
    write_springs(deck, mesh, reference);
  else
    write_trusses(deck, mesh);
  write_materials(deck, reference);
  write_constraints(deck, mesh);
  write_ties(deck, mesh, reference);
  std::vector<std::string> cards;
  write_loads(deck, mesh, reference, loads, cards);
  write_steps(deck, loads.pressure.size(), cards, !mesh.bars().empty() && !options.springs);
  return deck.take();
}
} // namespace pelvireg::reference_fe
