// Dense and batched inner loops, compiled once for every vector instruction set and chosen when the program starts.
// Plain arrays only. Rows come in groups of `width`, padded with zeros; column-major; pointers marked "aligned" lie on
// 64 bytes and their strides are multiples of `width`.
#pragma once

namespace pelvireg::registration::kernels
{
constexpr int width = 8;

/// The least multiple of `width` that is not below n.
constexpr int padded(int n)
{
  return (n + width - 1) / width * width;
}

/// Consecutive rows of an update matrix that are also consecutive in its parent's front.
struct Run
{
  int first = 0;  ///< row (and column) of the update matrix
  int length = 0; ///< a multiple of 3
  int target = 0; ///< row of the front, padding included
};

/// Columns of one supernode of L, aligned: the diagonal block in the first padded(n_columns) rows, below them the
/// padded(n_below) rows of the rest. Numbers of columns and rows are multiples of 3.
struct SupernodeColumns
{
  double *values = nullptr;
  double *inverse_diagonal = nullptr; ///< n_columns
  int n_columns = 0;
  int n_below = 0;
  const int *rows = nullptr; ///< the unknowns of the n_below rows, ascending
  int stride() const { return padded(n_columns) + padded(n_below); }
  double *below() const { return values + padded(n_columns); }
};

/// Right-hand sides in groups of `width` constraint rows: entry of unknown u and lane l is values[group][u * width +
/// l], aligned.
struct RightSides
{
  double *const *values = nullptr;
  const int *groups = nullptr; ///< those that reach the supernode, ascending
  int n_groups = 0;
};

/// Eight tetrahedra side by side; entry [i][l] belongs to lane l.
struct alignas(64) TetrahedronGroup
{
  double gradients[12][width]; ///< of the shape functions, 1/mm: [3 * node + axis]
  double volume_lambda[width]; ///< volume times Lamé's lambda, N mm
  double volume_mu[width];
  int nodes[4][width];
};

/// What assemble_tetrahedra() gives: forces (gradients of the energy, N) and the ten lower blocks (a >= b) of R K R^T
/// in the order 00, 10, 11, 20, 21, 22, 30 ..., each column-major, N/mm.
struct alignas(64) TetrahedronResult
{
  double forces[12][width];
  double blocks[90][width];
};

using RotationOf = void (*)(const double (&f)[9], double (&q)[9]);

struct Kernels
{
  const char *instruction_set;

  /// Cholesky of the supernode's columns in place: L11 L11^T = A11, L21 = A21 L11^-T. False at a pivot that is not
  /// positive or not finite.
  bool (*factorise_columns)(const SupernodeColumns &columns);
  /// update = -L21 L21^T, lower triangle; aligned; stride padded(n_below). Its padding rows are set to zero.
  void (*update_matrix)(const SupernodeColumns &columns, double *update);
  /// target(run targets - shift) += update(runs), for the columns of runs first_run ... last_run - 1.
  void (*extend_add)(const double *update, int update_stride, const Run *runs, int first_run, int last_run, int n_runs,
                     double *target, int target_stride, int shift);
  /// x <- L^-1 x for one supernode: its own entries, then what they take from the rows below. `scratch`:
  /// padded(n_below) doubles, aligned.
  void (*solve_lower)(const SupernodeColumns &columns, double *own, double *x, double *scratch);
  /// x <- L^-T x for one supernode.
  void (*solve_upper)(const SupernodeColumns &columns, double *own, const double *x, double *scratch);
  /// The same as solve_lower for many right-hand sides. `first` is the supernode's first unknown.
  void (*eliminate)(const SupernodeColumns &columns, int first, const RightSides &sides);
  /// products(i, j) += sum over the supernode's unknowns of (sides of group i) (sides of group j)^T, for i >= j: tile
  /// i (i + 1) / 2 + j of width x width, column-major, aligned.
  void (*accumulate_products)(int first, int n_columns, const RightSides &sides, double *products);
  /// sums[group * width + lane] += sum over the supernode's unknowns of sides times x.
  void (*accumulate_dots)(int first, int n_columns, const RightSides &sides, const double *x, double *sums);
  /// x[unknown] += sum over the groups of sides times factors[group * width + lane], aligned.
  void (*add_combination)(int first, int n_columns, const RightSides &sides, const double *factors, double *x);
  /// Positions n x 3, row-major, mm. `rotation` gives the rotation Q (column-major) of a gradient F that is flat,
  /// inverted or stretched beyond measure.
  void (*assemble_tetrahedra)(const TetrahedronGroup &group, const double *positions, RotationOf rotation,
                              TetrahedronResult &result);
};

/// The fastest kernels that this processor runs. The choice is made once, so a program gives the same bytes on every
/// run on one machine.
const Kernels &best();

/// All that this processor runs, the slowest first; for tests.
int n_available();
const Kernels &available(int index);
} // namespace pelvireg::registration::kernels
