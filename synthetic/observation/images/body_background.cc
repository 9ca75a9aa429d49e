#include "synthetic/observation/images/body_background.h"

#include "synthetic/observation/images/random_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace pelvireg::observation
{
namespace
{
using Eigen::Vector2d; ///< (y, z) of the anatomy: posterior, superior
using Eigen::Vector3d;

constexpr double border_width = 0.75; ///< mm, half width of the soft step at borders of the scenery

/// A vertex of a chain of rods whose radius changes from vertex to vertex.
struct Joint
{
  double y, z, radius;
};

// Midsagittal landmarks: symphysis in front of the retropubic space; sacrum and coccyx behind the rectum; lumbar
// bodies.
constexpr std::array<Joint, 2> symphysis = {{{-10, -3, 10}, {-30, 14, 10}}};
constexpr std::array<Joint, 5> sacrum = {{{50, 170, 21}, {92, 156, 18}, {126, 128, 15}, {142, 98, 11}, {143, 76, 8}}};
constexpr std::array<Joint, 3> coccyx = {{{141, 68, 5}, {134, 54, 5}, {118, 42, 4}}};
constexpr std::array<Joint, 2> lumbar = {{{34, 196, 19}, {18, 262, 19}}};
constexpr std::array<Joint, 5> canal = {{{54, 262, 7}, {66, 205, 7}, {88, 186, 6}, {128, 160, 4}, {152, 128, 3}}};
constexpr std::array<Joint, 4> gluteal = {{{165, 120, 12}, {170, 80, 18}, {160, 30, 20}, {140, -10, 16}}};
constexpr std::array<Joint, 2> sphincter = {{{88, -22, 15}, {66, 4, 14}}};
constexpr std::array<Joint, 3> urethra = {{{10, 18, 7}, {5, -6, 7}, {4, -26, 5}}};
constexpr std::array<Joint, 2> perineal_muscle = {{{-4, -18, 4}, {20, -30, 5}}};

struct Nearest
{
  double depth; ///< mm inside, negative outside
  double along; ///< mm from the chain's first vertex
};

Nearest inside_chain(const Vector2d &point, std::span<const Joint> chain)
{
  Nearest nearest{-1e9, 0};
  double length = 0;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i)
  {
    const Vector2d a(chain[i].y, chain[i].z), b(chain[i + 1].y, chain[i + 1].z), edge = b - a;
    const double t = std::clamp((point - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const double radius = (1 - t) * chain[i].radius + t * chain[i + 1].radius;
    const double depth = radius - (point - a - t * edge).norm();
    if (depth > nearest.depth)
      nearest = {depth, length + t * edge.norm()};
    length += edge.norm();
  }
  return nearest;
}

/// 0 outside, 1 inside, smooth over the border.
double soft_step(double depth)
{
  const double t = std::clamp(0.5 + 0.5 * depth / border_width, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Depth under the skin, mm: abdominal wall in front, back and buttocks behind, perineum below.
double depth_under_skin(const Vector3d &p)
{
  const double x = std::abs(p.x());
  const double front = -78 - 22 * std::clamp((p.z() + 10) / 90, 0.0, 1.0) + 0.003 * x * x;
  const double back = 172 + 22 * std::exp(-std::pow((p.z() - 5) / 55, 2)) * std::min(1.0, 0.3 + x / 40) - 0.002 * x * x;
  const double perineum = -42 - 0.0012 * (p.y() - 40) * (p.y() - 40) - 1.5 * std::max(0.0, x - 18);
  const double from_front = p.y() - front, from_back = back - p.y(), from_below = p.z() - perineum;
  // Smooth minimum: rounded where two of them meet.
  const double k = 14;
  return -k * std::log(std::exp(-from_front / k) + std::exp(-from_back / k) + std::exp(-from_below / k));
}

double with_bone(double &share, double depth, double signal_before, double signal, double cortical)
{
  const double here = soft_step(depth);
  share = std::max(share, here);
  const double marrow = soft_step(depth - 2);
  return (1 - here) * signal_before + here * ((1 - marrow) * cortical + marrow * signal);
}

double mixed(double before, double depth, double signal)
{
  const double share = soft_step(depth);
  return (1 - share) * before + share * signal;
}
/// Loops of wall and content.
double bowel(const Vector3d &material, const TissueSignals &signals)
{
  const double loop = gradient_noise(material, 24, 92);
  if (loop * loop < 0.012)
    return signals.wall;
  return std::max(0.05,
                  signals.bowel * (1 + 0.9 * gradient_noise(material, 30, 93) + 0.3 * tissue_texture(material, 3)));
}
} // namespace

FixedScenery fixed_scenery(const Vector3d &position, const TissueSignals &signals)
{
  const Vector2d p(position.y(), position.z());
  FixedScenery scenery;
  scenery.skin_depth = depth_under_skin(position);
  scenery.inside = soft_step(scenery.skin_depth);
  const double marrow = signals.marrow * (1 + 0.25 * tissue_texture(position, 7));
  const double off_midline = 0.15 * std::max(0.0, std::abs(position.x()) - 12); // bodies narrow to the side
  double signal = 0;
  const Nearest pubis = inside_chain(p, symphysis);
  signal = with_bone(scenery.bone, pubis.depth - off_midline, signal, marrow, signals.cortical_bone);
  const Nearest back = inside_chain(p, sacrum), spine = inside_chain(p, lumbar), tail = inside_chain(p, coccyx);
  // Discs and fused joints between vertebrae: dark lines across.
  const auto between_vertebrae = [&](double along, double height)
  {
    const double off = std::abs(std::remainder(along, height));
    return 1 - 0.6 * std::exp(-off * off / 6);
  };
  signal = with_bone(scenery.bone, back.depth - off_midline, signal, marrow * between_vertebrae(back.along, 30),
                     signals.cortical_bone);
  signal = with_bone(scenery.bone, spine.depth - off_midline, signal, marrow * between_vertebrae(spine.along, 37),
                     signals.cortical_bone);
  signal = with_bone(scenery.bone, tail.depth - off_midline, signal, marrow, signals.cortical_bone);
  const double in_canal = soft_step(inside_chain(p, canal).depth - 0.4 * std::max(0.0, std::abs(position.x()) - 4));
  scenery.bone = std::max(scenery.bone, in_canal);
  scenery.bone_signal = (1 - in_canal) * signal + in_canal * signals.spinal_fluid;
  if (scenery.bone > 0)
    scenery.bone_signal /= scenery.bone; // what was mixed with nothing at the border
  return scenery;
}

double soft_tissue(const Vector3d &material, double skin_depth, const TissueSignals &signals)
{
  const Vector2d p(material.y(), material.z());
  // Fat with thin dark septa and vessels.
  const double septum = gradient_noise(material, 14, 90);
  double signal =
      signals.fat * (1 + 0.22 * tissue_texture(material, 1)) * (1 - 0.4 * std::exp(-septum * septum / 0.004));
  // Textures are costly: only what is seen is made.
  const auto put = [&](double depth, auto &&signal_there)
  {
    if (depth > -border_width)
      signal = mixed(signal, depth, signal_there());
  };
  const auto muscle = [&] { return signals.muscle * (1 + 0.5 * tissue_texture(material, 2)); };
  const double below_bowel = std::min({material.z() - 78, skin_depth - 36, 150 - 0.62 * (material.z() - 70) - p.x()});
  if (below_bowel > -20)
    put(below_bowel - 16 * gradient_noise(material, 40, 91), [&] { return bowel(material, signals); });
  if (p.x() < 0 && p.y() > 12)
    put(5 - std::abs(skin_depth - 30), muscle); // rectus, down to the pubis
  const double beside = std::abs(material.x());
  put(inside_chain(p, gluteal).depth - 0.2 * std::max(0.0, 30 - beside), muscle);
  const double off_midline = 0.5 * std::max(0.0, beside - 8);
  put(inside_chain(p, sphincter).depth - off_midline, muscle);
  put(inside_chain(p, perineal_muscle).depth - off_midline, muscle);
  const double tube = inside_chain(p, urethra).depth - off_midline;
  put(tube, [&] { return signals.wall; });
  put(tube - 3, [&] { return 1.5 * signals.urethra; });
  return mixed(signals.skin, skin_depth - 2.2, signal);
}
} // namespace pelvireg::observation
