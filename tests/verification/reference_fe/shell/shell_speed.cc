// Processor times of one Newton iteration of a thick spherical shell: assembly, factorisation, solve.
// usage: shell_speed [refinements = 4] [threads = 1]
#include "reference_fe/elements/shell_mesh.h"
#include "reference_fe/elements/shell_term.h"
#include "reference_fe/materials/yeoh.h"

#include <deal.II/grid/grid_generator.h>

#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <iostream>

using namespace pelvireg::reference_fe;

namespace
{
template <typename Work> double seconds(const Work &work)
{
  const std::clock_t start = std::clock(); // of this process: other jobs do not count
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}
} // namespace

int main(int argc, char **argv)
{
  const int refinements = argc > 1 ? std::atoi(argv[1]) : 4, n_threads = argc > 2 ? std::atoi(argv[2]) : 1;
  dealii::Triangulation<2, 3> sphere;
  dealii::GridGenerator::hyper_sphere(sphere, dealii::Point<3>(), 40.0);
  sphere.refine_global(refinements);
  const ShellBody body = shell_body(sphere, "sphere", 2, 3.0);

  EquilibriumSystem system(n_threads);
  const int first = add_shell_unknowns(system, body);
  system.add_term(std::make_shared<ShellTerm>(body, std::make_shared<Yeoh>(0.1, 0.05, 0.02, 10.0), first));
  for (int c = 0; c < 3; ++c)
    for (int node = 0; node < 3; ++node)
      system.fix(first + n_shell_unknowns * node + c);

  Eigen::VectorXd solution = Eigen::VectorXd::Zero(system.n_unknowns());
  const double pattern = seconds([&] { system.assemble(solution, true); });
  const double assembly = seconds([&] { system.assemble(solution, true); });
  const double residual = seconds([&] { system.assemble(solution, false); });
  const double first_factor = seconds([&] { system.factorise(); });
  const double factor = seconds([&] { system.factorise(); });
  const Eigen::VectorXd rhs = Eigen::VectorXd::Random(system.n_unknowns());
  const double solve = seconds([&] { system.solve(rhs); });
  std::cout << fmt::format("{} cells, {} unknowns, {} entries, {} threads\n", body.n_cells(), system.n_free(),
                           system.tangent().n_entries(), n_threads)
            << fmt::format("assembly {:.3f} s (first, with pattern {:.3f}), residual only {:.3f} s\n", assembly,
                           pattern, residual)
            << fmt::format(
                   "factorisation {:.3f} s (first, with ordering {:.3f}), solve {:.3f} s, {:.1f} M entries in LU\n",
                   factor, first_factor, solve, system.n_factor_entries() / 1e6);
  return 0;
}
