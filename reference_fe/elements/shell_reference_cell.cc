#include "reference_fe/elements/shell_reference_cell.h"

#include "synthetic/dataset/error.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

#include <string>

namespace pelvireg::reference_fe
{
namespace
{
std::vector<double> gauss_points(int n)
{
  const dealii::QGauss<1> rule(n);
  std::vector<double> points;
  for (const auto &point : rule.get_points())
    points.push_back(point[0]);
  return points;
}

/// All pairs (first, second), the first running fastest.
Eigen::Matrix2Xd tensor_points(const std::vector<double> &first, const std::vector<double> &second)
{
  Eigen::Matrix2Xd points(2, first.size() * second.size());
  for (std::size_t j = 0; j < second.size(); ++j)
    for (std::size_t i = 0; i < first.size(); ++i)
      points.col(j * first.size() + i) = Eigen::Vector2d(first[i], second[j]);
  return points;
}

double lagrange(const std::vector<double> &nodes, std::size_t k, double x)
{
  double value = 1;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (i != k)
      value *= (x - nodes[i]) / (nodes[k] - nodes[i]);
  return value;
}

/// Polynomials through the tensor grid `first` x `second` at `points`: n_points x n_grid.
Eigen::MatrixXd tensor_interpolation(const std::vector<double> &first, const std::vector<double> &second,
                                     const Eigen::Matrix2Xd &points)
{
  Eigen::MatrixXd weights(points.cols(), first.size() * second.size());
  for (Eigen::Index q = 0; q < points.cols(); ++q)
    for (std::size_t j = 0; j < second.size(); ++j)
      for (std::size_t i = 0; i < first.size(); ++i)
        weights(q, j * first.size() + i) = lagrange(first, i, points(0, q)) * lagrange(second, j, points(1, q));
  return weights;
}
} // namespace

ShapeTable shape_table(int order, const Eigen::Matrix2Xd &points)
{
  const dealii::FE_Q<2> element(order);
  ShapeTable table;
  table.value.resize(element.n_dofs_per_cell(), points.cols());
  table.d1 = table.d2 = table.value;
  for (Eigen::Index q = 0; q < points.cols(); ++q)
    for (unsigned int node = 0; node < element.n_dofs_per_cell(); ++node)
    {
      const dealii::Point<2> point(points(0, q), points(1, q));
      table.value(node, q) = element.shape_value(node, point);
      const auto gradient = element.shape_grad(node, point);
      table.d1(node, q) = gradient[0];
      table.d2(node, q) = gradient[1];
    }
  return table;
}

ShellReferenceCell::ShellReferenceCell(int order_) : order(order_), n_nodes((order_ + 1) * (order_ + 1))
{
  if (order < 1 || order > 3)
    throw InputError("the order of a shell cell is " + std::to_string(order) + "; allowed are 1, 2 and 3");
  const std::vector<double> fine = gauss_points(order + 1), coarse = gauss_points(order);
  const Eigen::Matrix2Xd points = tensor_points(fine, fine);
  integration = shape_table(order, points);
  const dealii::QGauss<1> rule(order + 1);
  weight.resize(points.cols());
  for (Eigen::Index q = 0; q < points.cols(); ++q)
    weight[q] = rule.weight(q % fine.size()) * rule.weight(q / fine.size());

  const auto sampling = [&](const std::vector<double> &first, const std::vector<double> &second,
                            std::vector<SampledComponent> components, std::vector<int> directions)
  {
    return StrainSampling{shape_table(order, tensor_points(first, second)), tensor_interpolation(first, second, points),
                          std::move(components), std::move(directions)};
  };
  samplings[0] = sampling(coarse, fine, {{0, 0, 0}, {4, 0, 2}}, {0, 2});
  samplings[1] = sampling(fine, coarse, {{1, 1, 1}, {5, 1, 2}}, {1, 2});
  samplings[2] = sampling(coarse, coarse, {{3, 0, 1}}, {0, 1});
  const dealii::FE_Q<2> element(order);
  Eigen::Matrix2Xd nodes(2, n_nodes);
  for (int node = 0; node < n_nodes; ++node)
    nodes.col(node) = Eigen::Vector2d(element.unit_support_point(node)[0], element.unit_support_point(node)[1]);
  samplings[3] = {shape_table(order, nodes), integration.value.transpose(), {{2, 2, 2}}, {2}};

  const dealii::QGauss<1> through_thickness(n_zeta);
  for (int k = 0; k < n_zeta; ++k)
  {
    zeta[k] = 2 * through_thickness.point(k)[0] - 1;
    zeta_weight[k] = 2 * through_thickness.weight(k);
  }
}
} // namespace pelvireg::reference_fe
