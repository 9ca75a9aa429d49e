#include "reference_fe/constraints/cavity.h"

#include <utility>

namespace pelvireg::reference_fe
{
namespace
{
double face_volume(const Eigen::Matrix3Xd &x)
{
  double volume = 0;
  for (const FacePoint &q : face_quadrature(static_cast<int>(x.cols())))
    volume += q.weight / 3 * (x * q.value).dot((x * q.d_xi).cross(x * q.d_eta));
  return volume;
}

/// First and second derivative of face_volume with respect to the nodal positions.
void differentiate_volume(const Eigen::Matrix3Xd &x, Eigen::VectorXd &gradient, Eigen::MatrixXd &hessian)
{
  const int n = static_cast<int>(x.cols());
  gradient.setZero(3 * n);
  hessian.setZero(3 * n, 3 * n);
  for (const FacePoint &q : face_quadrature(n))
  {
    const Eigen::Vector3d x0 = x * q.value, g1 = x * q.d_xi, g2 = x * q.d_eta;
    const double weight = q.weight / 3;
    const Eigen::Vector3d by_value = weight * g1.cross(g2), by_xi = weight * g2.cross(x0),
                          by_eta = weight * x0.cross(g1);
    const Eigen::Matrix3d s0 = weight * skew(x0), s1 = weight * skew(g1), s2 = weight * skew(g2);
    for (int i = 0; i < n; ++i)
      gradient.segment<3>(3 * i) += q.value[i] * by_value + q.d_xi[i] * by_xi + q.d_eta[i] * by_eta;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        hessian.block<3, 3>(3 * i, 3 * j) += (q.value[i] * q.d_eta[j] - q.d_eta[i] * q.value[j]) * s1 -
                                             (q.value[i] * q.d_xi[j] - q.d_xi[i] * q.value[j]) * s2 -
                                             (q.d_xi[i] * q.d_eta[j] - q.d_eta[i] * q.d_xi[j]) * s0;
  }
}

constexpr double leak_onset = 1e-5; // MPa

/// r(q) and its slope.
struct Outflow
{
  double value = 0, slope = 0;
};
Outflow outflow(double q)
{
  if (q <= 0)
    return {};
  if (q < leak_onset)
    return {q * q / (2 * leak_onset), q / leak_onset};
  return {q - leak_onset / 2, 1};
}
} // namespace

Cavity::Cavity(std::string name, std::vector<SurfaceFace> faces, int pressure_unknown)
    : name_(std::move(name)), faces_(std::move(faces)), pressure_(pressure_unknown)
{
  for (const SurfaceFace &face : faces_)
  {
    Eigen::Matrix3Xd x(3, face.nodes.size());
    for (std::size_t i = 0; i < face.nodes.size(); ++i)
      x.col(static_cast<Eigen::Index>(i)) = face.nodes[i].rest_position();
    item_rest_volume_.push_back(face_volume(x));
    rest_volume_ += item_rest_volume_.back();
  }
  held_volume_ = rest_volume_;
}

void Cavity::hold_volume(double volume)
{
  control_ = Control::volume;
  held_volume_ = volume;
}

void Cavity::leak(double rate)
{
  control_ = Control::leak;
  rate_ = rate;
}

void Cavity::prescribe_pressure(double rate)
{
  control_ = Control::pressure;
  rate_ = rate;
}

void Cavity::accept_step(const Eigen::VectorXd &solution)
{
  if (control_ == Control::leak)
    held_volume_ += fluid_row(solution[pressure_]).value;
  load_parameter_ = step_end_;
}

Cavity::Row Cavity::fluid_row(double q) const
{
  if (control_ == Control::volume)
    return {};
  if (control_ == Control::pressure)
    return {rest_volume_ * (q - rate_ * step_end_), rest_volume_};
  const double leaked = rate_ * (step_end_ - load_parameter_);
  const Outflow flow = outflow(q);
  return {-leaked * flow.value, -leaked * flow.slope};
}

double Cavity::volume(const Eigen::VectorXd &solution) const
{
  double volume = 0;
  for (const SurfaceFace &face : faces_)
    volume += face_volume(positions(face.nodes, solution));
  return volume;
}

void Cavity::unknowns(int item, std::vector<int> &indices) const
{
  indices.clear();
  append_unknowns(faces_[item].nodes, indices);
  indices.push_back(pressure_);
}

void Cavity::evaluate(int item, const Eigen::VectorXd &solution, LocalSystem &local) const
{
  unknowns(item, local.unknowns);
  const std::vector<SurfaceNode> &nodes = faces_[item].nodes;
  const int n = 3 * static_cast<int>(nodes.size());
  const Eigen::Matrix3Xd x = positions(nodes, solution);
  const double q = solution[pressure_];
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  differentiate_volume(x, gradient, hessian);

  Eigen::VectorXd force = Eigen::VectorXd::Zero(n + 1);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n + 1, n + 1);
  force.head(n) = -q * gradient;
  stiffness.topLeftCorner(n, n) = -q * hessian;
  stiffness.topRightCorner(n, 1) = -gradient;
  if (control_ != Control::pressure)
  {
    force[n] = item_rest_volume_[item] * (held_volume_ / rest_volume_) - face_volume(x); // its share of V0 - V
    stiffness.bottomLeftCorner(1, n) = -gradient.transpose();
  }
  if (item == 0)
  {
    const Row row = fluid_row(q);
    force[n] += row.value;
    stiffness(n, n) = row.slope;
  }
  to_unknowns(nodes, solution, force, stiffness, 1, local);
  local.energy = 0;
}

std::vector<SurfaceFace> rim_caps(const std::vector<SurfaceNode> &rim)
{
  std::vector<SurfaceFace> caps;
  const std::size_t n = rim.size();
  for (std::size_t i = 0; i + 1 < n; i += 2)
    caps.push_back({{rim[0], rim[(i + 2) % n], rim[i + 1], rim[i]}});
  return caps;
}
} // namespace pelvireg::reference_fe
